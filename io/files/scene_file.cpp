#include "io/files/scene_file.h"

#include <QBuffer>
#include <QImageReader>

#include "io/regular_file.h"

namespace volumen {

namespace {

// A scene is a few kilobytes; in a picture it stands before the pixels.
constexpr std::uint64_t mostSceneBytes = 16 << 20;

// Empty: not a kind of picture that we write.
QByteArray pictureFormat(const QByteArray& bytes) {
  if (bytes.startsWith("\x89PNG\r\n\x1a\n")) return "png";
  if (bytes.startsWith("\xff\xd8\xff")) return "jpeg";
  return {};
}

}  // namespace

Result<std::string> sceneText(const std::string& path) {
  const auto file = RegularFile::open(path);
  if (!file) return Error{"Cannot read the scene " + path + ": " + file.message() + "."};
  std::vector<std::uint8_t> content;
  if (Status s = file->readUpTo(content, mostSceneBytes); !s)
    return Error{"Cannot read the scene " + path + ": " + s.message() + "."};
  QByteArray bytes(reinterpret_cast<const char*>(content.data()), qsizetype(content.size()));
  const QByteArray format = pictureFormat(bytes);
  if (format.isEmpty()) {
    if (file->size() > mostSceneBytes) return Error{path + " is no scene: it is larger than 16 MB."};
    return bytes.toStdString();
  }
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::ReadOnly);
  const QString scene = QImageReader(&buffer, format).text(QStringLiteral("volumen-scene"));
  if (scene.isEmpty()) return Error{path + " holds no scene."};
  return scene.toStdString();
}

}  // namespace volumen
