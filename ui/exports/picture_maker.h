#pragma once

#include <QImage>
#include <functional>
#include <memory>
#include <optional>

#include "io/files/picture_file.h"
#include "results/pictures/overlays.h"
#include "ui/document/job_lane.h"
#include "ui/overlays/page_tables.h"
#include "ui/workspace/picture_look.h"

namespace volumen {

/// A finished picture with all that is stated about it.
struct MadePicture {
  QImage image;
  PictureText text;  ///< entries of its file
  PictureLabel label = {};
  Overlays overlays = {};                 ///< texts of a flat view, drawn over the picture or not
  std::optional<double> mmPerPixel = {};  ///< of the image; empty if it is not calibrated
  std::vector<PageTable> tables = {};     ///< of pages, in place of the image
};

/// Makes the pictures of one export. It holds everything they show as it was when the export was requested,
/// so that neither the views nor the document matter later.
class PictureMaker {
 public:
  using Done = std::function<void(const Result<MadePicture>&)>;

  virtual ~PictureMaker() = default;

  virtual std::size_t count() const { return 1; }
  /// Makes picture `n`, from 0 in order, and calls `done` once, at once or later. Slow work runs on `lane`.
  virtual void make(std::size_t n, JobLane& lane, const Done& done) = 0;
  /// Cancels the picture in progress. Its `done` is no longer needed.
  virtual void giveUp() {}
  /// Reports the progress of a job with `made` finished pictures.
  virtual void tellProgress(const Job& job, std::size_t made) const;
  /// Returns the sentence for a cancelled export.
  virtual QString cancelledText() const;
  /// Returns whether exports of this kind are made one after another.
  virtual bool isOneAtATime() const { return false; }
};

using PictureMakerPtr = std::shared_ptr<PictureMaker>;

/// Returns the file entries of a picture with these warnings.
PictureText plainPictureText(const QStringList& warnings);

}  // namespace volumen
