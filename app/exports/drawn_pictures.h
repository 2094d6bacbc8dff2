#pragma once

#include <functional>

#include "app/exports/exports.h"
#include "io/files/picture_file.h"

class QImage;

namespace volumen {

/// Takes the pictures of an export in order.
struct PictureTaker {
  /// Prepares for `count` pictures of a series.
  std::function<Status(const Series& series, int count)> begin;
  std::function<Status(const QImage& picture, const PictureText& text)> take;
};

/// The slices of a plane that are drawn.
enum class SlicesDrawn {
  one,        ///< where the options of the plane say
  all,        ///< those through the whole volume
  timePoints  ///< the same one in each time point, in the window of the chosen one
};

/// Draws the slices of a job. The Error is a sentence for the user.
Result<Exported> drawSlices(const ExportJob& job, SlicesDrawn which, const PictureTaker& taker,
                            const CancelToken& cancel);
/// Draws all frames of a series as acquired, as `volumen slice --plane frame` does, in a shared window where
/// files have none. The Error is a sentence for the user.
Result<Exported> drawFrames(const ExportJob& job, const PictureTaker& taker, const CancelToken& cancel);
/// Draws the 3D picture of a job, or a full turn in several. The Error is a sentence for the user.
Result<Exported> drawTurn(const ExportJob& job, int pictures, const PictureTaker& taker,
                          const CancelToken& cancel);
/// Draws each time point of a job's series in 3D, with camera and window of the chosen one. The Error is a
/// sentence for the user.
Result<Exported> drawTimePoints(const ExportJob& job, const PictureTaker& taker, const CancelToken& cancel);

}  // namespace volumen
