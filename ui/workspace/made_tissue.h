#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "ui/data/loaded_series.h"
#include "ui/workspace/segment_map.h"
#include "viewer/segment/bit_mask.h"

namespace volumen {

struct Workspace;

/// What 3D views draw of a series whose tissue is not shown everywhere, and what that was made of.
struct MadeTissue {
  LoadedSeriesPtr of;                      ///< the series, without what its mask takes away
  std::shared_ptr<const LabelMap> labels;  ///< of its grid
  std::vector<int> segments;               ///< the numbers of those that were shown
  TissueShown shown;
  std::shared_ptr<const BitMask> voxels{};  ///< where tissue is left
  LoadedSeriesPtr left{};                   ///< with air elsewhere; null: it could not be made

  /// Whether both are made of the same.
  bool isAs(const MadeTissue& other) const {
    return of == other.of && labels == other.labels && segments == other.segments && shown == other.shown;
  }
};

/// The numbers of the segments of a map that are shown.
std::vector<int> numbersShown(const SegmentMap& map);

/// What is to be made for 3D views of a series with these segments (null: it has none); none: its tissue is
/// shown everywhere, or the segments lie on another grid.
std::optional<MadeTissue> tissueWanted(const SegmentMap* map, const LoadedSeriesPtr& series);

/// Whether the series is in a 3D view on screen, and its tissue not to be shown everywhere.
bool isTissueOnScreen(const MadeTissue& tissue, const Workspace& workspace);

/// A scene that says nothing of window and gradientFloor with those of all of a volume, of which only some
/// tissue is drawn: few voxels have other percentiles.
Scene drawnAsTheWhole(Scene scene, const Window& window, double valueSpread, const VoxelGeometry& geometry);

}  // namespace volumen
