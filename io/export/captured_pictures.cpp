#include "io/export/captured_pictures.h"

#include <QCryptographicHash>
#include <algorithm>
#include <cstring>
#include <new>

namespace volumen {

namespace {

// Returns the hash of a text as a PNG of ours holds it: with single spaces.
std::string sha256(const std::string& text) {
  const QByteArray inPng = QString::fromStdString(text).simplified().toUtf8();
  return QCryptographicHash::hash(inPng, QCryptographicHash::Sha256).toHex().toStdString();
}

}  // namespace

std::vector<std::uint8_t> rgbOf(const QImage& image) {
  const QImage opaque = opaqueImage(image);
  const std::size_t row = std::size_t(opaque.width()) * 3;
  std::vector<std::uint8_t> bytes(row * std::size_t(opaque.height()));
  for (int y = 0; y < opaque.height(); ++y)
    std::memcpy(&bytes[row * std::size_t(y)], opaque.constScanLine(y), row);
  return bytes;
}

Status CapturedPictures::take(const QImage& image, const PictureText& text, const CancelToken& cancel) try {
  if (!capture_) {
    tags_.derivation = derivationWords(text, frames_);
    auto begun =
        SecondaryCapture::begin(path_, series_, tags_, {image.width(), image.height()}, frames_, {}, cancel);
    if (!begun) return begun.error();
    capture_.emplace(std::move(*begun));
  }
  return capture_->add(rgbOf(image));
} catch (const std::bad_alloc&) {
  return Error{"Cannot write " + path_ + ": there is not enough memory."};
}

Status CapturedPictures::finish() {
  if (!capture_) return Error{"Cannot write " + path_ + ": it has no pictures."};
  return capture_->finish();
}

PictureText textOfAll(PictureText text, int pictures) {
  static const std::string ofOne[] = {"volumen-error-estimated", "volumen-error-measured",
                                      "volumen-error-pilot"};
  if (pictures > 1)
    std::erase_if(text,
                  [](const auto& entry) { return std::ranges::find(ofOne, entry.first) != std::end(ofOne); });
  return text;
}

std::string derivationWords(const PictureText& text, int pictures) {
  static const std::string own = "volumen-";
  std::string words = pictures > 1 ? std::to_string(pictures) + " pictures" : "";
  for (const auto& [key, value] : textOfAll(text, pictures)) {
    std::string name = key.starts_with(own) ? key.substr(own.size()) : "", told = value;
    std::ranges::replace(name, '-', ' ');
    if (name == "scene") name = "scene SHA-256", told = sha256(value);
    words += (words.empty() ? "" : "; ") + (name.empty() ? "" : name + ": ") + told;
  }
  return words;
}

}  // namespace volumen
