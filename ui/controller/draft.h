#pragma once

#include <QImage>
#include <QSize>
#include <glm/vec4.hpp>
#include <optional>

#include "viewer/scene/scene.h"
#include "viewer/volume/picture.h"

namespace volumen {

/// Chooses the resolution of drafts so that the measured frame time stays within a budget. A factor of 4
/// means one ray per 4 x 4 screen pixels.
class DraftPace {
 public:
  explicit DraftPace(double budgetMs = 40) : budgetMs_(budgetMs) {}

  double factor() const;
  /// Records the time of a draft with the current factor.
  void measured(double ms);
  double budgetMs() const { return budgetMs_; }

 private:
  double budgetMs_;
  int step_ = 4;
};

/// Predicts the time of the picture at rest from that of a draft of the same scene and earlier ratios of such
/// times.
class RestCost {
 public:
  /// Records the time of a draft.
  void draftTook(double ms, double factor) { draftMs_ = ms * factor * factor; }
  /// Records the time of the picture at rest after that draft, with one ray per edge x edge pixels.
  void restTook(double ms, int edge) {
    if (draftMs_ > 0) timesDraft_ = ms * edge * edge / draftMs_;
  }
  /// Returns the expected time of the picture at rest, ms.
  double expected(int edge) const { return timesDraft_ * draftMs_ / (edge * edge); }
  /// Returns the factor of a second, finer draft before the picture at rest: the finest that takes at most a
  /// third as long. Returns nothing if the picture at rest comes soon anyway or the draft was about as fine.
  std::optional<double> factorOfFiner(double draft, int edge) const;

 private:
  double draftMs_ = 0;  // time of the last draft, scaled to full resolution
  // Time of a ray at rest relative to one of a draft; initially as measured on chest and head.
  double timesDraft_ = 3;
};

/// The size and camera of a smaller picture with the same content. The size is rounded up, and the camera
/// sees more by as much. So nothing jumps when the full picture replaces it.
struct DraftView {
  QSize size;
  Camera camera;
};
DraftView draftView(const Camera& camera, QSize full, double factor);

/// Returns the central part of a picture, enlarged bilinearly (on premultiplied colour) by `factor` to `full`
/// pixels.
QImage enlarged(const Picture& picture, double factor, QSize full);

/// Returns one pixel of the enlarged picture before rounding, RGBA.
glm::vec4 enlargedPixel(const Picture& picture, double factor, QSize full, glm::ivec2 pixel);

/// Returns the picture for the screen: RGB32, or ARGB32_Premultiplied for a transparent background.
QImage toImage(const Picture& picture);

}  // namespace volumen
