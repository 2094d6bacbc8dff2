#pragma once

#include "viewer/plan/options.h"

namespace volumen {

/// The accuracy of a picture at rest: a level of quality, and one ray for `edge` x `edge` pixels.
struct PictureLevel {
  Quality quality = Quality::standard;
  int edge = 1;
  bool operator==(const PictureLevel&) const = default;
};

/// The criterion for the level of the picture at rest.
enum class Aim {
  level,  ///< the level itself
  time,   ///< the most accurate level within the requested time
  error   ///< the fastest level within the requested error
};

/// The user's request for the picture at rest, apart from the scene.
struct QualityGoal {
  Aim aim = Aim::level;
  PictureLevel level;     ///< with Aim::level; else while nothing is measured yet
  double frameMs = 150;   ///< with Aim::time
  double errorOf255 = 2;  ///< with Aim::error: 99 % of the pixels within N/255 of the reference
  bool operator==(const QualityGoal&) const = default;
};

}  // namespace volumen
