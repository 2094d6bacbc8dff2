#pragma once

#include <QImage>
#include <chrono>
#include <optional>

#include "ui/controller/draft.h"
#include "ui/controller/draw.h"
#include "ui/workspace/quality_goal.h"
#include "ui/workspace/view_id.h"

namespace volumen {

/// A request of a view for a picture of `pixels` device pixels.
struct ScreenRequest {
  int number = 0;
  Scene scene;  ///< fitted to the picture if it has no camera
  QSize pixels;
  /// For all but drafts. Drafts leave out segments that the resampler cannot show.
  Resampler resampler = Resampler::cpu;
  PictureLevel level;      ///< at rest
  bool withError = false;  ///< drawn so that the picture estimates its error where it can
};

/// A picture for the screen.
struct ScreenPicture {
  ViewId view = 0;
  VolumePtr volume;
  int number = 0;  ///< of the request
  QImage image;    ///< with the requested number of pixels
  Quality quality = Quality::standard;
  double factor = 1;    ///< one ray per factor x factor pixels (DraftPace, PictureLevel)
  bool atRest = false;  ///< true if no finer picture follows
  /// Wall-clock time until the image. It counts from the start of the request or, at rest, from the end of
  /// the pause and of drafts.
  double ms = 0;
  Scene scene;  ///< as drawn, with its camera
  std::shared_ptr<const Plan> plan;
  RenderStats stats;
  std::vector<Warning> warnings{};  ///< Drawn::warnings
  /// The error bound of each pixel (Rendered::error) and its summary. Null or empty if unknown, as for
  /// enlarged pictures.
  std::shared_ptr<const std::vector<float>> error;
  std::optional<PictureError> estimated;

  bool draft() const { return !atRest; }
};

/// One drawing of a request, with one ray per factor x factor pixels.
struct Pass {
  Quality quality;
  double factor;
  bool operator==(const Pass&) const = default;
};

/// Returns the pass of the picture at rest.
inline Pass restPass(PictureLevel level) { return {level.quality, double(level.edge)}; }

/// A pass that was planned before it is drawn.
struct PlannedPass {
  Result<Planned> planned;
  std::chrono::steady_clock::time_point from;  ///< its time counts from here
};

/// Plans a pass that begins at `from`, or now if that is past.
PlannedPass planPass(const Draw& draw, const Volume& volume, const ScreenRequest& request, Pass pass,
                     std::chrono::steady_clock::time_point from, const CancelToken& cancel);

/// The picture of a pass as drawn, and as the screen shows it (without view and volume).
struct DrawnPass {
  Drawn drawn;
  ScreenPicture shown;
};

/// Draws a pass, which may have been planned ahead.
Result<DrawnPass> drawPass(const Draw& draw, const Volume& volume, const ScreenRequest& request, Pass pass,
                           const CancelToken& cancel, const PlannedPass* ahead = nullptr);

}  // namespace volumen
