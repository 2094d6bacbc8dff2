#pragma once

#include <QImage>
#include <QSize>
#include <glm/vec4.hpp>

#include "viewer/scene/scene.h"
#include "viewer/volume/picture.h"

namespace volumen {

/// How coarse a draft is drawn, so that the measured frame time stays within what is asked for. A factor of 4
/// means: one ray for 4 x 4 pixels of the screen.
class DraftPace {
 public:
  explicit DraftPace(double budgetMs = 40) : budgetMs_(budgetMs) {}

  double factor() const;
  /// A draft of the present factor took so long.
  void measured(double ms);
  double budgetMs() const { return budgetMs_; }

 private:
  double budgetMs_;
  int step_ = 4;
};

/// A picture of a factor less pixels that shows the same: its size, rounded up, and its camera, which sees as
/// much more as the rounding adds, so that nothing jumps when the full picture takes its place.
struct DraftView {
  QSize size;
  Camera camera;
};
DraftView draftView(const Camera& camera, QSize full, double factor);

/// The middle part of a picture, enlarged smoothly (bilinear, on premultiplied colour) by the factor to
/// `full` pixels.
QImage enlarged(const Picture& picture, double factor, QSize full);

/// One pixel of the enlarged picture, before it is rounded: RGBA.
glm::vec4 enlargedPixel(const Picture& picture, double factor, QSize full, glm::ivec2 pixel);

/// The picture for the screen: RGB32, or ARGB32_Premultiplied where the background is transparent.
QImage toImage(const Picture& picture);

}  // namespace volumen
