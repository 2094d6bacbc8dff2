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

/// How a segment was made (PS3.3 C.8.20.4): by a program alone, by one that a person helps, or by hand.
enum class SegmentAlgorithm { unsaid, manual, semiautomatic, automatic };

/// One segment of a segmentation (PS3.3 C.8.20.4); its voxels are in a LabelMap, or in Segmentation::bits.
/// Texts are UTF-8.
struct Segment {
  int number = 0;                       ///< from 1: as its file counts; of a label map its label
  std::string label{}, description{};   ///< its name, and what is said of it
  Code category{}, type{}, modifier{};  ///< "Tissue", "Bone", "Left"
  Code region{}, regionModifier{};      ///< the part of the body that it lies in: "Lung", "Left"
  SegmentAlgorithm algorithmType = SegmentAlgorithm::unsaid;
  std::string algorithm{};                  ///< the name of what made it
  std::string trackingId{}, trackingUid{};  ///< of what it shows, wherever else that is found again
  std::optional<glm::u8vec3> colour{};      ///< recommended, sRGB
  std::optional<ValueRange> range{};        ///< the values that it was made of; none: it was not made so
  std::optional<CurveSpan> span{};  ///< that `range` follows when the curve is pulled; none: it does not
  bool visible = true;
  bool locked = false;  ///< nothing takes voxels from it or gives it some
  double opacity = 1;   ///< where it is drawn, 0..1
  bool operator==(const Segment&) const = default;
};

/// Says of a segment that its voxels were changed here: what a program made alone is so no more, and the name
/// of what made it says that it was edited. What was made by hand, or by nothing that is known, stays so.
void markEdited(Segment& segment);

}  // namespace volumen
