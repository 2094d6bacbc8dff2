#include "io/files/scene_file.h"

#include <QBuffer>
#include <QFile>
#include <QFileInfo>
#include <QImageReader>

namespace volumen {

Result<std::string> readSceneText(const std::string& path) {
  constexpr qsizetype most = 256 << 20;
  QFile file(QFile::decodeName(QByteArray::fromStdString(path)));
  const QFileInfo facts(file);
  if (!facts.exists()) return Error{"Cannot read the scene " + path + ": no such file."};
  if (facts.isDir()) return Error{"Cannot read the scene " + path + ": it is a folder."};
  if (!file.open(QIODevice::ReadOnly))
    return Error{"Cannot read the scene " + path + ": " + file.errorString().toStdString() + "."};
  QByteArray bytes;
  for (QByteArray part; !(part = file.read(1 << 20)).isEmpty();) {
    bytes += part;
    if (bytes.size() > most) return Error{path + " is too large to be a scene."};
  }
  if (!bytes.startsWith("\x89PNG")) return bytes.toStdString();
  QBuffer png(&bytes);
  const QString text = QImageReader(&png, "png").text(QStringLiteral("volumen-scene"));
  if (text.isEmpty()) return Error{path + " holds no scene."};
  return text.toStdString();
}

}  // namespace volumen
