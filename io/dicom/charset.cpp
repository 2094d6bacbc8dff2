#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcspchrs.h>

#include <algorithm>
#include <cstdint>

#include "io/dicom/data_set.h"

namespace volumen::dicom {
namespace {

/// The length of the valid UTF-8 character at `at`, 0 where there is none.
std::size_t utf8Length(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t n) { return at + n < text.size() ? std::uint8_t(text[at + n]) : 0u; };
  const auto follows = [&](std::size_t n) { return (byte(n) & 0xc0u) == 0x80u; };
  if (byte(0) < 0x80) return 1;
  if (byte(0) >= 0xc2 && byte(0) < 0xe0 && follows(1)) return 2;
  const unsigned two = byte(0) << 8 | byte(1);
  const bool shortest = two >= 0xe0a0 && !(two >= 0xeda0 && two < 0xee00);  // no overlong ones, no surrogates
  if (byte(0) >= 0xe0 && byte(0) < 0xf0 && shortest && follows(1) && follows(2)) return 3;
  if (two >= 0xf090 && two < 0xf490 && follows(1) && follows(2) && follows(3)) return 4;
  return 0;
}

std::string validUtf8(const std::string& text) {
  std::string valid;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8Length(text, at);
    valid += length ? text.substr(at, length) : std::string("\xef\xbf\xbd");
    at += length ? length : 1;
  }
  return valid;
}

}  // namespace

std::string toUtf8(const std::string& text, const std::string& specificCharacterSet) {
  const bool plain = text.find_first_of("\x1b") == std::string::npos &&
                     std::all_of(text.begin(), text.end(), [](char c) { return std::uint8_t(c) < 0x80; });
  if (plain) return text;
  DcmSpecificCharacterSet converter;
  OFString converted;
  const bool known = !specificCharacterSet.empty() &&
                     converter.selectCharacterSet(OFString(specificCharacterSet.c_str())).good();
  const bool done =
      known && converter.convertString(OFString(text.data(), text.size()), converted, "\\^=").good();
  return validUtf8(done ? std::string(converted.data(), converted.size()) : text);
}

}  // namespace volumen::dicom
