#include "io/files/text_source.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "io/files/header_text.h"
#include "io/files/isolated_source.h"
#include "io/worker/worker.h"

namespace volumen {

namespace {

bool isSeparator(char c) { return c == ' ' || c == ',' || (c >= '\t' && c <= '\r'); }

// Returns true if all of `word` is a number that T can hold.
template <class T>
bool parse(const std::string& word, T& sample) {
  double value = 0;
  const char* const begin = word.data() + (word[0] == '+');
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || stop != end) return false;
  if constexpr (std::is_integral_v<T>) {
    const double limit = std::ldexp(1.0, std::numeric_limits<T>::digits);  // first value beyond T
    if (value != std::floor(value) || value < double(std::numeric_limits<T>::min()) || value >= limit)
      return false;
  }
  sample = T(value);
  return true;
}

class TextSource : public ByteSource {
 public:
  TextSource(DataFile file, std::uint64_t offset, const TextSamples& samples)
      : path_(file.path()),
        encoded_(decode(std::move(file), offset, Encoding::raw)),
        type_(samples.type),
        left_(samples.count) {}

  Result<std::size_t> read(void* to, std::size_t count) override {
    return withSampleType(type_, [&](auto sample) -> Result<std::size_t> {
      for (std::size_t done = 0; done + sizeof sample <= count; done += sizeof sample, --left_) {
        if (left_ == 0) return done;
        auto word = nextWord();
        if (!word) return word.error();
        if (word->empty()) return done;
        if (!parse(*word, sample))
          return Error{path_ + " holds '" + fieldText(*word) +
                       "' among its samples, which is no number of their type."};
        std::memcpy(static_cast<char*>(to) + done, &sample, sizeof sample);
      }
      return count;
    });
  }

 private:
  // Returns the next word; empty at the end. No number needs more than `longest` characters.
  Result<std::string> nextWord() {
    constexpr std::size_t longest = 400;
    std::string word;
    for (;;) {
      if (at_ == filled_) {
        auto got = encoded_->read(buffer_, sizeof buffer_);
        if (!got) return got.error();
        if (*got == 0) return word;
        at_ = 0;
        filled_ = *got;
      }
      const char c = buffer_[at_++];
      if (!isSeparator(c) && word.size() < longest)
        word += c;
      else if (!word.empty())
        return word;
    }
  }

  std::string path_;
  std::unique_ptr<ByteSource> encoded_;
  SampleType type_;
  std::uint64_t left_;
  char buffer_[1 << 16];
  std::size_t at_ = 0, filled_ = 0;
};

}  // namespace

std::unique_ptr<ByteSource> decodeText(DataFile file, std::uint64_t offset, const TextSamples& samples,
                                       const CancelToken& cancel) {
  if (worker::isolating()) return decodeIsolated(file.path(), offset, Encoding::raw, samples, cancel);
  return std::make_unique<TextSource>(std::move(file), offset, samples);
}

}  // namespace volumen
