#pragma once

#include <optional>

#include "viewer/render/curve_table.h"
#include "viewer/render/gl/gl_state.h"
#include "viewer/render/render.h"
#include "viewer/render/shading/reflectance_map.h"
#include "viewer/render/skip_map.h"
#include "viewer/render/visible_cells.h"
#include "viewer/volume/buffer.h"
#include "viewer/volume/bytes.h"
#include "viewer/volume/gradients.h"

namespace volumen {

/// Densities in 16 bits as the kernels read them: the volume's own samples where they serve, else a copy.
struct Density16 {
  const std::int16_t* data = nullptr;
  std::uint32_t flip = 0;  ///< TraceFrame::flip16
  DensityScale scale;
  Buffer<std::int16_t> copy;
};

/// Densities as floats: real values in their units (FloatUnits).
struct Density32 {
  const float* data = nullptr;
  DensityScale scale;
  Buffer<float> copy;
};

struct RenderCaches::Impl {
  VolumePtr volume;
  std::optional<VolumeFacts> facts;
  std::optional<Density16> density16;
  std::optional<Density32> density32;
  std::optional<Density8> density8;
  template <class Gradients>
  struct ByOperator {
    GradientOperator by;
    Gradients gradients;
  };
  std::optional<ByOperator<Gradients16>> gradients16;
  std::optional<ByOperator<Gradients32>> gradients32;
  std::optional<ByOperator<Voxels8>> voxels8;

  /// What is asked of blocks and cells.
  struct SkipWish {
    std::vector<CurvePoint> points;
    int reachBlocks = 1;        ///< SkipMap::reach
    double rounding = 0;        ///< how far stored values may be off the volume's, real units
    StoredDensities densities;  ///< cells are told apart by; that are looked at
    bool cells = false;         ///< Skip::cells is looked at
    bool operator==(const SkipWish&) const = default;
  };
  struct Skip {
    SkipWish made;    ///< for the last reach
    SkipMap maps[2];  ///< for the last two reaches, the last first: a picture's and its pilot's
    VisibleCells cells;

    const SkipMap& map() const { return maps[0]; }
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

  GlContextFactory glFactory = makeEglContext;
  std::unique_ptr<GlState> gl;

  const VolumeFacts& factsOfVolume();
  const Density16& densities16();  ///< only for integers with a positive slope
  const Density32& densities32();
  const Density8& densitiesIn8();
  const Gradients16& gradientsIn16(GradientOperator by);
  const Gradients32& gradientsIn32(GradientOperator by);
  const Voxels8& voxelsIn8(GradientOperator by);
  /// The last one made is kept. `table`: the curve over the densities that are looked at.
  const Skip& skipOf(const TransferFunction& curve, const CurveTable& table, const SkipWish& wish);
  /// The last one made is kept. `n`: nodes along an edge of a face.
  const ReflectanceMap& reflectanceMap(const Lighting& lighting, int n, MapLookup lookup);
  Result<GlState*> glState();  ///< made when first asked for; its context is not current
};

}  // namespace volumen
