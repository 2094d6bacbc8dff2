#pragma once

#include <nlohmann/json_fwd.hpp>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

namespace volumen {

/// Returns text from files and folders, safe for a terminal. C0, C1, DEL and bidirectional controls become
/// \xNN or \u{NNNN}; bytes that are not UTF-8 become \xNN.
std::string printable(std::string_view utf8);

/// Returns JSON text in which the characters that printable() escapes are \uNNNN.
std::string printableJson(std::string_view text);

/// Returns a JSON value as text for stdout or a file, with a line end: printableJson().
std::string jsonText(const nlohmann::ordered_json& json);

/// Returns a path for JSON, whose texts are UTF-8: itself, or its URI ("file:///a/M%FCller") if it is not
/// UTF-8.
std::string pathForJson(const std::string& path);

/// Returns a text with `to` in place of each `from`, which is not empty.
std::string replaced(std::string text, const std::string& from, const std::string& to);

/// Returns the path of an argument: for a URI "file:///..." its path, for a link "volumen:archive:..." or
/// "volumen:index:..." the study that it names, else the argument itself.
std::string pathOfArgument(const std::string& argument);

/// Makes all output of a stream printable() while this object lives; line ends stay.
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
