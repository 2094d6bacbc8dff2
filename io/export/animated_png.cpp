// Animated PNG (PNG specification, third edition): the chunks of one PNG file a picture, which Qt encodes. Qt
// cannot write animations.
#include <zlib.h>

#include <QImage>
#include <QtEndian>

#include "io/export/film_formats.h"

namespace volumen {

namespace {

constexpr qsizetype signatureBytes = 8;

struct PngChunk {
  QByteArrayView type, data;
};

// Returns the chunks of a PNG file that Qt wrote.
std::vector<PngChunk> chunksOf(const QByteArray& png) {
  constexpr qsizetype aroundData = 12;  // length, type, checksum
  std::vector<PngChunk> chunks;
  for (qsizetype at = signatureBytes; at + aroundData <= png.size();) {
    const auto length = qsizetype(qFromBigEndian<quint32>(png.constData() + at));
    const QByteArrayView all(png);
    chunks.push_back({all.sliced(at + 4, 4), all.sliced(at + 8, length)});
    at += aroundData + length;
  }
  return chunks;
}

// Returns the compressed pixels of a PNG file.
QByteArray packedPixels(const QByteArray& png) {
  QByteArray pixels;
  for (const PngChunk& chunk : chunksOf(png))
    if (chunk.type == "IDAT") pixels.append(chunk.data);
  return pixels;
}

template <class Number>
void appendNumber(QByteArray& bytes, Number number) {
  const Number big = qToBigEndian(number);
  bytes.append(reinterpret_cast<const char*>(&big), sizeof big);
}

class AnimatedPng : public FilmFile {
 public:
  AnimatedPng(OutputFile out, const std::string& path, int pictures, int perSecond)
      : FilmFile(std::move(out), path, pictures, perSecond) {}

 private:
  Status writeFirst(const QImage& picture, const PictureText& text, const CancelToken&) override {
    const auto png = pngBytes(picture, text);
    if (!png) return fail(png.message());
    if (Status s = out().write(png->constData(), signatureBytes); !s) return s;
    for (const PngChunk& chunk : chunksOf(*png)) {
      if (chunk.type == "IDAT") break;
      if (Status s = write(chunk.type, chunk.data); !s) return s;
    }
    QByteArray control;
    appendNumber(control, quint32(pictures()));
    appendNumber(control, quint32(0));  // loops without end
    if (Status s = write("acTL", control); !s) return s;
    if (Status s = writeControl(picture); !s) return s;
    return write("IDAT", packedPixels(*png));
  }

  Status writeNext(const QImage& picture, const CancelToken&) override {
    const auto png = pngBytes(picture, {});
    if (!png) return fail(png.message());
    if (Status s = writeControl(picture); !s) return s;
    QByteArray data;
    appendNumber(data, number_++);
    return write("fdAT", data + packedPixels(*png));
  }

  Status writeEnd(const CancelToken&) override { return write("IEND", {}); }

  // The whole picture replaces the one before.
  Status writeControl(const QImage& picture) {
    QByteArray control;
    appendNumber(control, number_++);
    for (const int value : {picture.width(), picture.height(), 0, 0}) appendNumber(control, quint32(value));
    appendNumber(control, quint16(1));
    appendNumber(control, quint16(perSecond()));
    constexpr char disposeNone = 0, blendSource = 0;
    control.append(disposeNone).append(blendSource);
    return write("fcTL", control);
  }

  Status write(QByteArrayView type, QByteArrayView data) {
    QByteArray length, checksum;
    appendNumber(length, quint32(data.size()));
    uLong sum = crc32(0, reinterpret_cast<const Bytef*>(type.data()), uInt(type.size()));
    if (!data.empty()) sum = crc32(sum, reinterpret_cast<const Bytef*>(data.data()), uInt(data.size()));
    appendNumber(checksum, quint32(sum));
    for (const QByteArrayView part : {QByteArrayView(length), type, data, QByteArrayView(checksum)})
      if (Status s = out().write(part.data(), std::size_t(part.size())); !s) return s;
    return {};
  }

  quint32 number_ = 0;  // of the next fcTL or fdAT
};

}  // namespace

Result<std::unique_ptr<FilmFile>> beginAnimatedPng(const std::string& path, int pictures, int perSecond) {
  auto out = OutputFile::create(path);
  if (!out) return out.error();
  return std::unique_ptr<FilmFile>(new AnimatedPng(*std::move(out), path, pictures, perSecond));
}

}  // namespace volumen
