#pragma once

#include <string>

#include "viewer/segment/lesion.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Use of a connected component: one of the range is added to the segment; one of the segment is kept alone
/// or removed.
enum class PartUse { add, keep, remove };

/// Position of painted voxels relative to another segment.
enum class PaintBeside { anywhere, inside, outside };

/// The region to grow in: the box of the seeds with a margin, or everything.
enum class GrowthRegion { aboutSeeds, everywhere };

/// What is chosen for tools that edit segments. Not kept from one start to the next. The brush is kept, in
/// the Preferences.
struct SegmentOptions {
  ValueRange range{};          ///< the range in hand, in stored values
  bool erases = false;         ///< strokes erase without Ctrl
  bool paintsInRange = false;  ///< strokes change only values of `range`
  PaintBeside beside = PaintBeside::anywhere;
  int other = 0;           ///< number of that segment, if there is one with it (otherSegmentShown())
  double cutWithinMm = 0;  ///< depth of a cut on either side of a slice; 0 is through all slices
  PartUse partUse = PartUse::add;
  double leakGuardMm = 0;             ///< of connected components (PartWanted)
  std::string neighbours = "faces";   ///< of connected components (PartWanted)
  LesionThreshold lesionThreshold{};  ///< an absolute value is in SUVbw
  GrowthRegion growthRegion = GrowthRegion::aboutSeeds;
  bool previewsGrowth = false;  ///< slices show what would grow from the seeds
  bool operator==(const SegmentOptions&) const = default;
};

}  // namespace volumen
