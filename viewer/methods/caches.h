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

  std::shared_ptr<StoredVoxels> voxels;  ///< maybe of others, too

  /// What is asked of blocks and cells.
  struct SkipRequest {
    std::vector<CurvePoint> points;
    int reachBlocks = 1;        ///< EmptySpaceMap::reach
    double rounding = 0;        ///< how far stored values may be off the volume's, real units
    StoredDensities densities;  ///< cells are told apart by; that are looked at
    bool cells = false;         ///< Skip::cells is looked at
    bool operator==(const SkipRequest&) const = default;
  };
  struct Skip {
    SkipRequest made;       ///< for the last reach
    EmptySpaceMap maps[2];  ///< for the last two reaches, the last first: a picture's and its pilot's
    VisibleCells cells;

    const EmptySpaceMap& map() const { return maps[0]; }
    std::size_t bytes() const { return maps[0].bytes() + maps[1].bytes() + cells.bytes(); }
  };
  /// One each for the last two kinds of stored densities, the last first: a picture that moves may look at
  /// other bits than the one that stands.
  Skip skips[2];

  struct Map {
    Lighting inputs;  ///< mapInputs of what the map was made for
    MapLookup lookup = MapLookup::bilinear;
    ReflectanceMap map;
  };
  std::optional<Map> map;

  /// Of the segments that were last drawn.
  std::vector<std::shared_ptr<const SegmentCells>> segmentCells;

  GlContextFactory glFactory = makeEglContext;
  std::unique_ptr<GlState> gl;

  /// The last one made is kept. `table`: the curve over the densities that are looked at.
  const Skip& skipOf(const TransferFunction& curve, const CurveTable& table, const SkipRequest& request);
  /// The last one made is kept. `n`: nodes along an edge of a face.
  const ReflectanceMap& reflectanceMap(const Lighting& lighting, int n, MapLookup lookup);
  /// Of each of the segments; these alone are kept.
  const std::vector<std::shared_ptr<const SegmentCells>>& segmentCellsOf(
      const std::vector<const SegmentSurface*>& segments);
  Result<GlState*> glState();  ///< made when first asked for; its context is not current
};

}  // namespace volumen
