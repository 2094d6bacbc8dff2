#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "ui/data/loaded_series.h"
#include "ui/workspace/segment_map.h"
#include "viewer/segment/bit_mask.h"

namespace volumen {

struct Workspace;

/// The volume that 3D views draw of a series if tissue is left out or the table is removed, and its inputs.
struct MadeTissue {
  LoadedSeriesPtr of;                    ///< the series with its mask applied
  std::vector<ChosenSegments> segments;  ///< shown segments on its grid, of all its maps
  TissueShown shown;
  std::shared_ptr<const BitMask> voxels{};  ///< where tissue remains
  LoadedSeriesPtr left{};     ///< with air elsewhere; null: could not be made; `of`: nothing is left out
  bool withoutTable = false;  ///< CT: draws the patient alone
  std::shared_ptr<const BitMask> patient{};  ///< voxels of the patient then; null: there is no table

  /// Returns whether both have the same inputs.
  bool isAs(const MadeTissue& other) const {
    return of == other.of && segments == other.segments && shown == other.shown &&
           withoutTable == other.withoutTable;
  }
};

/// Returns the bytes of its masks.
std::size_t bytesBesideVolumes(const MadeTissue& tissue);

/// Returns the shown segments of those maps that lie on `grid`, one entry per map.
std::vector<ChosenSegments> segmentsShownOf(const std::vector<const SegmentMap*>& maps,
                                            const VoxelGeometry& grid);

/// Returns the inputs of the volume to make for 3D views of a series with these segment maps. Empty if all of
/// it is drawn, or if all segments lie on another grid.
std::optional<MadeTissue> tissueWanted(const std::vector<const SegmentMap*>& maps,
                                       const LoadedSeriesPtr& series, bool withoutTable = false);

/// Returns whether the series is in a 3D view on screen and still has the same kind of tissue left out.
bool isTissueOnScreen(const MadeTissue& tissue, const Workspace& workspace);

/// Returns a scene whose missing window and gradientFloor are those of the whole volume. The percentiles of
/// the few voxels drawn would differ.
Scene drawnAsTheWhole(Scene scene, const Window& window, double valueSpread, const VoxelGeometry& geometry);

}  // namespace volumen
