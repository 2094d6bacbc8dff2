#pragma once

#include <QImage>
#include <QSize>
#include <glm/vec4.hpp>
#include <optional>

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

/// What a first picture by plain steps and the picture at rest are expected to take, by what a draft of the
/// same scene took and by what those before took beside theirs.
class RestCost {
 public:
  /// A draft took so long.
  void draftTook(double ms, double factor) { draftMs_ = ms * factor * factor; }
  /// The picture at rest, of one ray for edge x edge pixels, that followed took so long.
  void restTook(double ms, int edge) {
    if (draftMs_ > 0) timesDraft_ = ms * edge * edge / draftMs_;
  }
  /// A first picture by plain steps, of one ray for factor x factor pixels, that followed took so long.
  void firstTook(double ms, double factor) {
    if (draftMs_ > 0) timesFirst_ = ms * factor * factor / draftMs_;
  }
  /// Of the picture at rest, in ms.
  double expected(int edge) const { return timesDraft_ * draftMs_ / (edge * edge); }
  /// The factor of a first picture: none where the picture at rest comes soon anyway, or where the draft was
  /// about as fine. The finest that takes at most a third of the picture at rest.
  std::optional<double> factorOfFirst(double draft, int edge) const;

 private:
  double draftMs_ = 0;  // the last draft, were it as fine as the screen
  // How much longer a ray takes; at first as measured on chest and head.
  double timesDraft_ = 2;    // at rest
  double timesFirst_ = 0.5;  // by plain steps
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
