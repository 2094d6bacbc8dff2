#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "viewer/segment/code.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// One of the spans of values that a curve of opacity shows.
struct CurveSpan {
  int number = 0;  ///< from 0, ascending
  int of = 1;      ///< how many there are
  bool operator==(const CurveSpan&) const = default;
};

/// One segment of a segmentation (PS3.3 C.8.20.4); its voxels are in a LabelMap, or in Segmentation::bits.
/// Texts are UTF-8.
struct Segment {
  int number = 0;                       ///< from 1: as its file counts; of a label map its label
  std::string label{}, description{};   ///< its name, and what is said of it
  Code category{}, type{}, modifier{};  ///< "Tissue", "Bone", "Left"
  std::string algorithm{}, trackingId{};
  std::optional<glm::u8vec3> colour{};  ///< recommended, sRGB
  std::optional<ValueRange> range{};    ///< the values that it was made of; none: it was not made so
  std::optional<CurveSpan> span{};      ///< that `range` follows when the curve is pulled; none: it does not
  bool visible = true;
  bool locked = false;  ///< nothing takes voxels from it or gives it some
  double opacity = 1;   ///< where it is drawn, 0..1
  bool operator==(const Segment&) const = default;
};

}  // namespace volumen
