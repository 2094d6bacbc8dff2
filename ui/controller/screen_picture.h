#pragma once

#include <QImage>
#include <chrono>
#include <optional>

#include "ui/controller/draft.h"
#include "ui/controller/draw.h"
#include "ui/workspace/quality_goal.h"
#include "ui/workspace/view_id.h"

namespace volumen {

/// A picture of so many device pixels that a view asks for.
struct ScreenRequest {
  int number = 0;
  Scene scene;  ///< without a camera: fitted to the picture
  QSize pixels;
  Resampler resampler = Resampler::cpu;  ///< of all but drafts; those show no segments where it shows none
  PictureLevel level;                    ///< at rest
  bool withError = false;                ///< drawn cell by cell where it can be, which estimates its error
};

/// A picture for the screen.
struct ScreenPicture {
  ViewId view = 0;
  VolumePtr volume;
  int number = 0;  ///< of the request
  QImage image;    ///< as many pixels as were asked for
  Quality quality = Quality::standard;
  double factor = 1;             ///< one ray for factor x factor pixels (DraftPace, PictureLevel)
  std::optional<double> step{};  ///< of a first picture: its plain steps, voxels
  bool atRest = false;           ///< no finer picture follows
  double ms = 0;  ///< wall clock up to the image, from the request taken or, at rest, from the moment that
                  ///< nothing new had been asked for long enough and drafts were done
  Scene scene;    ///< as drawn: with its camera
  std::shared_ptr<const Plan> plan;
  RenderStats stats;
  /// How far each pixel may be off (Rendered::error), and what that comes to; nothing where that is not
  /// known, as where the picture was enlarged.
  std::shared_ptr<const std::vector<float>> error;
  std::optional<PictureError> estimated;

  bool draft() const { return !atRest; }
};

/// One drawing of what is asked for, by one ray for factor x factor pixels: at a level, or where `step` is
/// given by plain steps of so many voxels.
struct Pass {
  Quality quality;
  double factor;
  std::optional<double> step{};
  bool operator==(const Pass&) const = default;
};

/// That of the picture at rest.
inline Pass restPass(PictureLevel level) { return {level.quality, double(level.edge)}; }
/// That of a first picture, where the one at rest takes long: the steps that most programs take.
inline Pass firstPicturePass(PictureLevel level, double factor) { return {level.quality, factor, 1.0}; }

/// A pass that was planned before it is to be drawn.
struct PlannedPass {
  Result<Planned> planned;
  std::chrono::steady_clock::time_point from;  ///< from when on its time counts
};

/// Plans a pass that begins at `from`, or now where that is over.
PlannedPass planPass(const Draw& draw, const Volume& volume, const ScreenRequest& request, Pass pass,
                     std::chrono::steady_clock::time_point from, const CancelToken& cancel);

/// A pass's picture as it was drawn, and as the screen shows it (without view and volume).
struct DrawnPass {
  Drawn drawn;
  ScreenPicture shown;
};

/// Draws a pass, which may have been planned before.
Result<DrawnPass> drawPass(const Draw& draw, const Volume& volume, const ScreenRequest& request, Pass pass,
                           const CancelToken& cancel, const PlannedPass* ahead = nullptr);

}  // namespace volumen
