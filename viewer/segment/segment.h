#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "viewer/segment/code.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// One of the value ranges that an opacity curve shows.
struct CurveSpan {
  int number = 0;  ///< Index from 0, ascending
  int of = 1;      ///< Number of ranges
  bool operator==(const CurveSpan&) const = default;
};

/// How a segment was made (PS3.3 C.8.20.4): automatically, semi-automatically, or by hand.
enum class SegmentAlgorithm { unsaid, manual, semiautomatic, automatic };

/// An anatomic structure and its modifier, for example "Lung", "Left".
struct AnatomicStructure {
  Code code{}, modifier{};
  bool operator==(const AnatomicStructure&) const = default;
};

/// The algorithm of a segment as its file identifies it (PS3.3 10.16).
struct AlgorithmIdentity {
  Code family{}, nameCode{};
  std::string name{}, version{}, parameters{}, source{};
  bool operator==(const AlgorithmIdentity&) const = default;
};

/// One segment of a segmentation (PS3.3 C.8.20.4). Its voxels are in a LabelMap or in Segmentation::bits.
/// Texts are UTF-8.
struct Segment {
  int number = 0;  ///< Number from 1: segment number of its file, or its label in a label map
  std::string label{}, description{};           ///< Name and description
  Code category{}, type{}, modifier{};          ///< For example "Tissue", "Bone", "Left"
  Code region{}, regionModifier{};              ///< Anatomic region, for example "Lung", "Left"
  std::vector<AnatomicStructure> structures{};  ///< Primary anatomic structures
  SegmentAlgorithm algorithmType = SegmentAlgorithm::unsaid;
  std::string algorithm{};                      ///< Name of the algorithm
  std::vector<AlgorithmIdentity> algorithms{};  ///< Algorithms as its file identifies them; empty once edited
  std::string trackingId{}, trackingUid{};      ///< Identify the tracked object across segmentations
  std::optional<glm::u8vec3> colour{};          ///< Recommended display colour, sRGB
  std::optional<ValueRange> range{};            ///< Value range it was made from; empty if made otherwise
  /// Span of the curve that `range` follows when the curve is edited; empty if it does not follow.
  std::optional<CurveSpan> span{};
  bool visible = true;
  bool locked = false;  ///< True if no tool may change its voxels
  double opacity = 1;   ///< Opacity of its drawing, 0..1
  bool operator==(const Segment&) const = default;
};

/// Records a manual edit: an automatic segment becomes semi-automatic, its algorithm name notes the edit, and
/// `algorithms` is cleared. The type and name of segments made by hand or of unknown origin stay.
void markEdited(Segment& segment);

}  // namespace volumen
