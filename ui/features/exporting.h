#pragma once

#include "ui/exports/exports.h"
#include "ui/exports/scene_pictures.h"
#include "ui/features/feature.h"
#include "ui/widgets/path_dialog.h"

namespace volumen {

/// A feature that exports pictures. It reports how each export ended.
class ExportFeature : public Feature {
 public:
  /// `unsaved` describes what closing the window would lose while its exports are under way.
  explicit ExportFeature(Workbench& bench, const QString& unsaved = tr("pictures that are being written"));

  QString unsavedText() const override { return exports_.isWriting() ? unsaved_ : QString(); }

 protected:
  void run(const Export& order) { exports_.run(order); }
  /// Calls `then` with the path that the user chooses, at first in the folder of pictures.
  void askForPath(PathQuestion question, const std::function<void(const QString& path)>& then);
  /// Calls `then` with the printer that the user sets up. The dialog also contains `option`, if it is not
  /// null.
  void askForPrinter(const char* dialog, QWidget* option,
                     const std::function<void(const std::shared_ptr<QPrinter>& printer)>& then);

  /// Returns what the 3D view shows now; its series must be loaded.
  SnapshotSeen sceneNow(bool namesHidden) const;
  /// Makes the pictures of a snapshot or turn.
  PictureMakerPtr picturesOf(const SnapshotRequest& request) const;

  /// Filters of PNG and JPEG files.
  static QString pictureFilters();
  /// Returns a file name without extension for pictures of a series.
  static QString fileName(const Series& series);

 private:
  Exports exports_;
  const QString unsaved_;
};

}  // namespace volumen
