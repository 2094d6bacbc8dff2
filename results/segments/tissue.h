#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "results/segments/segment_map.h"
#include "results/series/loaded_series.h"
#include "viewer/segment/bit_mask.h"

namespace volumen {

/// Inputs of the volume that 3D views draw of a series if tissue is left out or the table is removed.
struct TissueKey {
  LoadedSeriesPtr of;                    ///< the series with its mask applied
  std::vector<ChosenSegments> segments;  ///< shown segments on its grid, of all its maps
  TissueShown shown;
  bool withoutTable = false;  ///< CT: draws the patient alone

  bool operator==(const TissueKey&) const = default;
};

/// That volume.
struct TissueVolume {
  std::shared_ptr<const BitMask> voxels{};  ///< where tissue remains; null: everywhere
  std::shared_ptr<const BitMask>
      patient{};           ///< voxels of the patient; null: there is no table, or it is shown
  LoadedSeriesPtr left{};  ///< with air elsewhere; `of` if nothing is left out
};

/// Returns the bytes of its masks.
std::size_t bytesBesideVolumes(const TissueVolume& tissue);

/// Returns the shown segments of those maps that lie on `grid`, one entry per map.
std::vector<ChosenSegments> segmentsShownOf(const std::vector<const SegmentMap*>& maps,
                                            const VoxelGeometry& grid);

/// Returns the inputs of the volume for 3D views of a series with these segment maps. Returns nothing if the
/// whole series is drawn or all segments lie on another grid.
std::optional<TissueKey> tissueWanted(const std::vector<const SegmentMap*>& maps,
                                      const LoadedSeriesPtr& series, bool withoutTable = false);

/// Returns a scene whose missing window and gradientFloor are those of the whole volume. The percentiles of
/// the few voxels drawn would differ.
Scene drawnAsTheWhole(Scene scene, const Window& window, double valueSpread, const VoxelGeometry& geometry);

}  // namespace volumen
