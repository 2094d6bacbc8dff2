#include "io/files/picture_text.h"

#include <zlib.h>

#include <QString>
#include <algorithm>
#include <string_view>

namespace volumen {

namespace {

constexpr std::string_view pngStart = "\x89PNG\r\n\x1a\n", jpegStart = "\xff\xd8\xff";

std::string_view textOf(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::uint32_t number(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char c : bytes) value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

// Removes and returns the part of `text` before the first zero byte, or all of it; also removes the zero.
std::string_view cutToZero(std::string_view& text) {
  const std::string_view first = text.substr(0, text.find('\0'));
  text.remove_prefix(std::min(first.size() + 1, text.size()));
  return first;
}

// Returns an empty string if `packed` is damaged or longer than `most` bytes when decompressed.
std::string inflated(std::string_view packed, std::size_t most) {
  std::string text(most, '\0');
  uLongf length = uLongf(most);
  const int code = uncompress(reinterpret_cast<Bytef*>(text.data()), &length,
                              reinterpret_cast<const Bytef*>(packed.data()), uLong(packed.size()));
  text.resize(code == Z_OK ? length : 0);
  return text;
}

std::string fromLatin1(std::string_view text) {
  return QString::fromLatin1(text.data(), qsizetype(text.size())).toStdString();
}

// Returns the text after the key of a tEXt, zTXt or iTXt chunk (ISO 15948, 11.3.4).
std::string textOfChunk(std::string_view type, std::string_view data, std::size_t most) {
  if (type == "tEXt") return fromLatin1(data);
  if (data.empty()) return {};
  if (type == "zTXt") return fromLatin1(inflated(data.substr(1), most));
  if (data.size() < 2) return {};
  const bool isPacked = data[0] == 1;
  data.remove_prefix(2);
  cutToZero(data);  // language tag
  cutToZero(data);  // translated key
  return isPacked ? inflated(data, most) : std::string(data);
}

std::string textInPng(std::string_view png, const std::string& key, std::size_t most) {
  constexpr std::size_t lengthAndType = 8, checksumBytes = 4;
  png.remove_prefix(pngStart.size());
  while (png.size() >= lengthAndType + checksumBytes) {
    const std::size_t length = number(png.substr(0, 4));
    if (length > png.size() - lengthAndType - checksumBytes) return {};
    const std::string_view checked = png.substr(4, 4 + length), type = checked.substr(0, 4);
    std::string_view data = checked.substr(4);
    const bool isText = type == "tEXt" || type == "zTXt" || type == "iTXt";
    if (isText && cutToZero(data) == key &&
        crc32_z(0, reinterpret_cast<const Bytef*>(checked.data()), checked.size()) ==
            number(png.substr(lengthAndType + length, checksumBytes)))
      return textOfChunk(type, data, most);
    png.remove_prefix(lengthAndType + length + checksumBytes);
  }
  return {};
}

// Returns the text of a comment "KEY: TEXT".
std::string textInJpeg(std::string_view jpeg, const std::string& key) {
  constexpr unsigned comment = 0xfffe, scan = 0xffda;
  jpeg.remove_prefix(2);
  while (jpeg.size() >= 4) {
    const unsigned marker = number(jpeg.substr(0, 2));
    const std::size_t length = number(jpeg.substr(2, 2));
    if (marker < 0xff01 || marker == scan || length < 2 || length > jpeg.size() - 2) return {};
    const std::string_view text = jpeg.substr(4, length - 2);
    if (marker == comment && text.starts_with(key + ": ")) return std::string(text.substr(key.size() + 2));
    jpeg.remove_prefix(2 + length);
  }
  return {};
}

}  // namespace

bool isPicture(std::span<const std::uint8_t> bytes) {
  return textOf(bytes).starts_with(pngStart) || textOf(bytes).starts_with(jpegStart);
}

std::string textInPicture(std::span<const std::uint8_t> picture, const std::string& key,
                          std::size_t mostBytes) {
  const std::string_view bytes = textOf(picture);
  if (bytes.starts_with(pngStart)) return textInPng(bytes, key, mostBytes);
  return bytes.starts_with(jpegStart) ? textInJpeg(bytes, key) : std::string();
}

}  // namespace volumen
