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

/// Takes what stands in front of the first byte 0 from `text`, and the 0; all of it where there is none.
std::string_view cutToZero(std::string_view& text) {
  const std::string_view first = text.substr(0, text.find('\0'));
  text.remove_prefix(std::min(first.size() + 1, text.size()));
  return first;
}

/// Empty where it is damaged or longer than `most` bytes.
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

/// The text of a chunk: tEXt, zTXt or iTXt (ISO 15948, 11.3.4), behind its key.
std::string textOfChunk(std::string_view type, std::string_view data, std::size_t most) {
  if (type == "tEXt") return fromLatin1(data);
  if (data.empty()) return {};
  if (type == "zTXt") return fromLatin1(inflated(data.substr(1), most));
  if (data.size() < 2) return {};
  const bool isPacked = data[0] == 1;
  data.remove_prefix(2);
  cutToZero(data);  // the language
  cutToZero(data);  // the key in that language
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

/// Of a comment "KEY: TEXT".
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
