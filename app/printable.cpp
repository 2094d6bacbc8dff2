#include "app/printable.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace volumen {

namespace {
bool isUnsafe(char32_t c) {
  return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x061c || (c >= 0x200e && c <= 0x200f) ||
         (c >= 0x2028 && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069);
}

// The first character of UTF-8 and its length; length 0: invalid.
struct Character {
  char32_t code = 0;
  std::size_t length = 0;
};

Character firstOf(std::string_view utf8) {
  const unsigned char lead = utf8[0];
  const std::size_t length = lead < 0x80    ? 1
                             : lead >= 0xf8 ? 0
                             : lead >= 0xf0 ? 4
                             : lead >= 0xe0 ? 3
                             : lead >= 0xc0 ? 2
                                            : 0;
  if (length == 0 || length > utf8.size()) return {};
  char32_t code = length == 1 ? lead : lead & (0xff >> (length + 1));
  for (std::size_t n = 1; n < length; ++n) {
    if ((utf8[n] & 0xc0) != 0x80) return {};
    code = (code << 6) | (utf8[n] & 0x3f);
  }
  constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  if (code < least[length] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return {};
  return {code, length};
}

template <class... Values>
std::string formatted(const char* format, Values... values) {
  char text[16];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

}  // namespace

std::string printable(std::string_view utf8) {
  std::string out;
  for (std::size_t n = 0; n < utf8.size();) {
    const auto [code, length] = firstOf(utf8.substr(n));
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

std::string printableJson(std::string_view text) {
  std::string out;
  for (std::size_t n = 0; n < text.size();) {
    const auto [code, length] = firstOf(text.substr(n));
    if (isUnsafe(code) && code != '\n')
      out += formatted("\\u%04x", unsigned(code));
    else
      out.append(text, n, length);
    n += std::max<std::size_t>(1, length);
  }
  return out;
}

std::string jsonText(const nlohmann::ordered_json& json) {
  return printableJson(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n');
}

namespace {

constexpr std::string_view uriStart = "file://", linkStart = "volumen:";

std::string percentDecoded(const std::string& text) {
  std::string out;
  for (std::size_t n = 0; n < text.size(); ++n) {
    unsigned value = 0;
    const std::string digits = text.substr(n + 1, 2);
    const bool isEscape =
        text[n] == '%' && digits.size() == 2 &&
        std::from_chars(digits.data(), digits.data() + 2, value, 16).ptr == digits.data() + 2;
    out += isEscape ? char(value) : text[n];
    if (isEscape) n += 2;
  }
  return out;
}

bool isUtf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = firstOf(text).length;
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

// Characters that a URI keeps (RFC 3986, unreserved), and the slashes of a path.
bool isPlainInUri(unsigned char c) {
  return std::isalnum(c) || std::string_view("-._~/").find(char(c)) != std::string_view::npos;
}

}  // namespace

std::string pathForJson(const std::string& path) {
  if (isUtf8(path)) return path;
  std::error_code failed;
  const std::filesystem::path whole = std::filesystem::absolute(path, failed);
  std::string uri(uriStart);
  for (const unsigned char c : failed ? path : whole.string())
    uri += isPlainInUri(c) ? std::string(1, char(c)) : formatted("%%%02X", unsigned(c));
  return uri;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

std::string pathOfArgument(const std::string& argument) {
  const bool isLink = argument.starts_with(linkStart);
  if (!isLink && !argument.starts_with(std::string(uriStart) + "/")) return argument;
  const std::string path = percentDecoded(argument.substr(isLink ? linkStart.size() : uriStart.size()));
  // Links come from anywhere: they name studies, and no files.
  if (isLink && !path.starts_with("archive:") && !path.starts_with("index:")) return argument;
  return path.find('\0') == std::string::npos ? path : argument;
}

std::streamsize PrintableStream::xsputn(const char* text, std::streamsize count) {
  std::string_view rest(text, std::size_t(count));
  std::string out;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    out += printable(rest.substr(0, end));
    if (end < rest.size()) out += '\n';
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return target_->sputn(out.data(), std::streamsize(out.size())) == std::streamsize(out.size()) ? count : 0;
}

PrintableStream::int_type PrintableStream::overflow(int_type character) {
  if (traits_type::eq_int_type(character, traits_type::eof())) return traits_type::not_eof(character);
  const char c = traits_type::to_char_type(character);
  return xsputn(&c, 1) == 1 ? character : traits_type::eof();
}

}  // namespace volumen
