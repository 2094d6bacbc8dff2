#pragma once

#include "viewer/plan/options.h"

namespace volumen {

/// How accurate a picture at rest is: a level of quality, and one ray for `edge` x `edge` pixels.
struct PictureLevel {
  Quality quality = Quality::standard;
  int edge = 1;
  bool operator==(const PictureLevel&) const = default;
};

/// What decides the level of the picture at rest.
enum class Aim {
  level,  ///< the level itself
  time,   ///< the most accurate one that is as fast as asked
  error   ///< the fastest one that is as accurate as asked
};

/// What the user asks of the picture at rest beside the scene.
struct QualityGoal {
  Aim aim = Aim::level;
  PictureLevel level;     ///< with Aim::level; else while nothing is measured
  double frameMs = 150;   ///< with Aim::time
  double errorOf255 = 2;  ///< with Aim::error: 99 % of the pixels within so many 1/255 of the reference
  bool operator==(const QualityGoal&) const = default;
};

}  // namespace volumen
