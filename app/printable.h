#pragma once

#include <nlohmann/json_fwd.hpp>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

namespace volumen {

/// Text from files and folders, safe for a terminal: C0, C1, DEL and bidirectional controls become \xNN or
/// \u{NNNN}, bytes that are no UTF-8 \xNN.
std::string printable(std::string_view utf8);

/// JSON text, in which what printable() escapes becomes \uNNNN.
std::string printableJson(std::string_view text);

/// A JSON value as the text that goes to stdout or a file, with its line end: printableJson().
std::string jsonText(const nlohmann::ordered_json& json);

/// A path in JSON, whose texts are UTF-8: itself, or, where it is no UTF-8, its URI ("file:///a/M%FCller").
std::string pathForJson(const std::string& path);

/// The path that an argument means: the one of a URI "file:///..."; any other argument itself.
std::string pathOfArgument(const std::string& argument);

/// Makes all that is written to a stream printable() while this object lives; line ends stay.
class PrintableStream : public std::streambuf {
 public:
  explicit PrintableStream(std::ostream& stream) : stream_(stream), target_(stream.rdbuf(this)) {}
  ~PrintableStream() override { stream_.rdbuf(target_); }
  PrintableStream(const PrintableStream&) = delete;
  PrintableStream& operator=(const PrintableStream&) = delete;

 protected:
  std::streamsize xsputn(const char* text, std::streamsize count) override;
  int_type overflow(int_type character) override;
  int sync() override { return target_->pubsync(); }

 private:
  std::ostream& stream_;
  std::streambuf* target_;
};

}  // namespace volumen
