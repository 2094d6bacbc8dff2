#pragma once

#include <QMimeData>
#include <memory>

#include "ui/exports/picture_maker.h"

class QTemporaryDir;

namespace volumen {

/// Pictures that are dragged out of the window. Their files are in a private folder that is deleted with this
/// object, because other programs may read them long after a drop.
class DraggedPictures {
 public:
  DraggedPictures();
  ~DraggedPictures();

  /// Writes a picture to a new PNG file with this name and returns what its drag carries: the file, its bytes
  /// as image/png, and draggedPictureType. Returns an Error if the file cannot be written.
  Result<std::unique_ptr<QMimeData>> carry(const MadePicture& picture, const QString& name);

 private:
  std::unique_ptr<QTemporaryDir> folder_;  // null before the first picture
};

}  // namespace volumen
