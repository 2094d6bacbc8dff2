#include "app/command.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

namespace volumen {

namespace {
bool isUnsafe(char32_t c) {
  return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x061c || (c >= 0x200e && c <= 0x200f) ||
         (c >= 0x2028 && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069);
}

/// The character at the beginning of UTF-8 and its length; length 0: it is none.
struct Character {
  char32_t code = 0;
  std::size_t length = 0;
};

Character firstOf(std::string_view utf8) {
  const unsigned char lead = utf8[0];
  const std::size_t length = lead < 0x80 ? 1 : lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc0 ? 2 : 0;
  if (length == 0 || length > utf8.size()) return {};
  char32_t code = length == 1 ? lead : lead & (0xff >> (length + 1));
  for (std::size_t n = 1; n < length; ++n) {
    if ((utf8[n] & 0xc0) != 0x80) return {};
    code = (code << 6) | (utf8[n] & 0x3f);
  }
  return {code, length};
}

template <class... Values>
std::string formatted(const char* format, Values... values) {
  char text[16];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

}  // namespace

std::string printable(const std::string& utf8) {
  std::string out;
  for (std::size_t n = 0; n < utf8.size();) {
    const auto [code, length] = firstOf(std::string_view(utf8).substr(n));
    if (length == 0)
      out += formatted("\\x%02x", unsigned(static_cast<unsigned char>(utf8[n])));
    else if (isUnsafe(code))
      out += formatted(code < 0x100 ? "\\x%02x" : "\\u{%04x}", unsigned(code));
    else
      out.append(utf8, n, length);
    n += std::max<std::size_t>(1, length);
  }
  return out;
}

std::string jsonText(const nlohmann::ordered_json& json) {
  const std::string text = json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
  std::string out;
  for (std::size_t n = 0; n < text.size();) {
    const auto [code, length] = firstOf(std::string_view(text).substr(n));
    if (isUnsafe(code) && code != '\n')
      out += formatted("\\u%04x", unsigned(code));
    else
      out.append(text, n, length);
    n += length;
  }
  return out;
}

namespace {
// Every line by itself: a list stays a list.
void tell(const std::string& sentence) {
  std::istringstream lines(sentence);
  const char* before = "volumen: ";
  for (std::string line; std::getline(lines, line); before = "")
    std::cerr << before << printable(line) << '\n';
}
}  // namespace

int fail(const std::string& sentence) {
  tell(sentence);
  return exitFailed;
}

int fail(const std::string& sentence, const CancelToken& cancel) {
  return fail(cancel.cancelled() ? "Interrupted; nothing was written." : sentence);
}

int failUsage(const std::string& sentence) {
  tell(sentence);
  return exitUsage;
}

}  // namespace volumen
