#include "app/command.h"

#include <cstdio>
#include <iostream>
#include <sstream>

namespace volumen {

namespace {
bool isUnsafe(char32_t c) {
  return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x061c || (c >= 0x200e && c <= 0x200f) ||
         (c >= 0x2028 && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069);
}
}  // namespace

std::string printable(const std::string& utf8) {
  std::string out;
  for (std::size_t n = 0; n < utf8.size();) {
    const unsigned char lead = utf8[n];
    const std::size_t length = lead < 0x80 ? 1 : lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc0 ? 2 : 0;
    char32_t c = length == 1 ? lead : lead & (0xff >> (length + 1));
    bool whole = length > 0 && n + length <= utf8.size();
    for (std::size_t m = 1; whole && m < length; ++m) {
      whole = (utf8[n + m] & 0xc0) == 0x80;
      c = (c << 6) | (utf8[n + m] & 0x3f);
    }
    char text[16];
    if (!whole) {
      std::snprintf(text, sizeof text, "\\x%02x", lead);
      out += text;
      ++n;
      continue;
    }
    if (isUnsafe(c)) {
      std::snprintf(text, sizeof text, c < 0x100 ? "\\x%02x" : "\\u{%04x}", unsigned(c));
      out += text;
    } else {
      out.append(utf8, n, length);
    }
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
