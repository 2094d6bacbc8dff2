#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "ui/data/loaded_series.h"
#include "ui/workspace/segment_map.h"
#include "viewer/segment/bit_mask.h"

namespace volumen {

struct Workspace;

/// What 3D views draw of a series whose tissue is not shown everywhere, or whose table is left out, and what
/// that was made of.
struct MadeTissue {
  LoadedSeriesPtr of;                    ///< the series, without what its mask takes away
  std::vector<ChosenSegments> segments;  ///< of its grid: those that were shown, of all its maps
  TissueShown shown;
  std::shared_ptr<const BitMask> voxels{};  ///< where tissue is left
  LoadedSeriesPtr left{};     ///< with air elsewhere; null: it could not be made; `of`: nothing goes
  bool withoutTable = false;  ///< of CT: the patient alone
  std::shared_ptr<const BitMask> patient{};  ///< where it is, then; null: there is no table

  /// Whether both are made of the same.
  bool isAs(const MadeTissue& other) const {
    return of == other.of && segments == other.segments && shown == other.shown &&
           withoutTable == other.withoutTable;
  }
};

/// Returns the bytes of its masks.
std::size_t bytesBesideVolumes(const MadeTissue& tissue);

/// The segments that are shown, of those of these maps that lie on the grid: an entry a map.
std::vector<ChosenSegments> segmentsShownOf(const std::vector<const SegmentMap*>& maps,
                                            const VoxelGeometry& grid);

/// What is to be made for 3D views of a series with these maps of segments; none: all of it is shown, or all
/// segments lie on another grid.
std::optional<MadeTissue> tissueWanted(const std::vector<const SegmentMap*>& maps,
                                       const LoadedSeriesPtr& series, bool withoutTable = false);

/// Whether the series is in a 3D view on screen, and what is left of it still to be shown alone.
bool isTissueOnScreen(const MadeTissue& tissue, const Workspace& workspace);

/// A scene that says nothing of window and gradientFloor with those of all of a volume, of which only some
/// tissue is drawn: few voxels have other percentiles.
Scene drawnAsTheWhole(Scene scene, const Window& window, double valueSpread, const VoxelGeometry& geometry);

}  // namespace volumen
