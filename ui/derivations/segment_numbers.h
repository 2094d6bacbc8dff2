#pragma once

#include <array>
#include <memory>

#include "ui/document/derivation.h"
#include "ui/workspace/session.h"
#include "viewer/segment/label_map.h"
#include "viewer/segment/numbers.h"

namespace volumen {

class SegmentPainter;

/// Inputs of the numbers of all segments of a label map, or of the values of one.
struct SegmentNumbersKey {
  std::shared_ptr<const LabelMap> labels;
  int number = 0;      ///< segment whose values are measured; 0: the voxels of all segments are counted
  VolumePtr volume{};  ///< contains the values; null if voxels are counted
  bool operator==(const SegmentNumbersKey&) const = default;
};

struct SegmentNumbersMade {
  std::array<std::int64_t, 256> voxels{};  ///< by segment number
  SegmentValues values{};                  ///< of one segment
};

using SegmentNumbers = Derivation<SegmentNumbersKey, SegmentNumbersMade>;

/// Returns the inputs of the values of the current segment in the Segments panel. Values are those of the
/// whole volume, as tissue cut away later still belongs to the segment. Requires segmentShown().
SegmentNumbersKey currentValuesKey(const Session& session);

/// Returns the rule for the numbers in the Segments panel: voxels of the current map, values of the current
/// segment, then voxels of the other maps. Strokes are included once they end.
SegmentNumbers::Rule segmentNumbersRule(const Session& session, const SegmentPainter& painter);

}  // namespace volumen
