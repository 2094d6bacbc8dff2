#pragma once

#include <optional>

#include "viewer/acceleration/empty_space_map.h"
#include "viewer/acceleration/segment_cells.h"
#include "viewer/acceleration/stored_voxels.h"
#include "viewer/acceleration/visible_cells.h"
#include "viewer/gl/gl_state.h"
#include "viewer/methods/render_caches.h"
#include "viewer/tables/curve_table.h"
#include "viewer/tables/reflectance_map.h"

namespace volumen {

struct RenderCaches::Impl {
  explicit Impl(std::shared_ptr<StoredVoxels> shared) : voxels(std::move(shared)) {}

  std::shared_ptr<StoredVoxels> voxels;  ///< May be shared with other caches.

  /// The inputs of block and cell skipping.
  struct SkipRequest {
    std::vector<CurvePoint> points;
    int reachBlocks = 1;        ///< Same as EmptySpaceMap::reach.
    double rounding = 0;        ///< Bound on the difference of stored values from the volume's, real units.
    StoredDensities densities;  ///< The densities the kernels read, by which cells are classified.
    bool cells = false;         ///< True if Skip::cells is used.
    bool operator==(const SkipRequest&) const = default;
  };
  struct Skip {
    SkipRequest made;       ///< The request with the last reach.
    EmptySpaceMap maps[2];  ///< Maps of the last two reaches, latest first (a picture and its pilot).
    VisibleCells cells;

    const EmptySpaceMap& map() const { return maps[0]; }
    std::size_t bytes() const { return maps[0].bytes() + maps[1].bytes() + cells.bytes(); }
  };
  /// Skipping for the last two kinds of stored densities, the latest first: a moving picture may read other
  /// bits than a still one.
  Skip skips[2];

  struct Map {
    Lighting inputs;  ///< The mapInputs() for which the map was made.
    MapLookup lookup = MapLookup::bilinear;
    ReflectanceMap map;
  };
  std::optional<Map> map;

  /// Cells of the segments drawn last.
  std::vector<std::shared_ptr<const SegmentCells>> segmentCells;

  GlContextFactory glFactory = makeEglContext;
  std::unique_ptr<GlState> gl;

  /// Returns blocks and cells for the request and keeps the last ones. `table`: the curve over the stored
  /// densities.
  const Skip& skipOf(const TransferFunction& curve, const CurveTable& table, const SkipRequest& request);
  /// Returns the reflectance map and keeps the last one. `n`: nodes along an edge of a face.
  const ReflectanceMap& reflectanceMap(const Lighting& lighting, int n, MapLookup lookup);
  /// Returns the cells of each of the segments and keeps only these.
  const std::vector<std::shared_ptr<const SegmentCells>>& segmentCellsOf(
      const std::vector<const SegmentSurface*>& segments);
  Result<GlState*> glState();  ///< Made on first use. Its context is not current.
};

}  // namespace volumen
