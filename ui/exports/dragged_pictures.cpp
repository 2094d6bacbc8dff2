#include "ui/exports/dragged_pictures.h"

#include <QDir>
#include <QTemporaryDir>
#include <QUrl>

#include "results/text/text.h"
#include "ui/exports/picture_sink.h"
#include "ui/workspace/dropped_files.h"
#include "viewer/volume/free_name.h"

namespace volumen {

DraggedPictures::DraggedPictures() = default;
DraggedPictures::~DraggedPictures() = default;

Result<std::unique_ptr<QMimeData>> DraggedPictures::carry(const MadePicture& picture, const QString& name) {
  if (!folder_ || !folder_->isValid()) folder_ = std::make_unique<QTemporaryDir>();
  if (!folder_->isValid())
    return Error{tr("Cannot write into %1: free some space there.").arg(QDir::tempPath()).toStdString()};
  const auto pathOf = [this](const std::string& one) {
    return folder_->filePath(QString::fromStdString(one) + QStringLiteral(".png"));
  };
  const QString path = pathOf(
      freeName(name.toStdString(), [&](const std::string& one) { return QFile::exists(pathOf(one)); }));
  const PictureSink sink = pictureFile(path);
  if (Status taken = sink.take(0, picture); !taken) return taken.error();
  if (const auto written = sink.finish(1); !written) return written.error();
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly))
    return Error{tr("Cannot read %1: drag the picture again.").arg(path).toStdString()};
  auto carried = std::make_unique<QMimeData>();
  carried->setUrls({QUrl::fromLocalFile(path)});
  carried->setData(QStringLiteral("image/png"), file.readAll());
  carried->setData(draggedPictureType, {});
  return carried;
}

}  // namespace volumen
