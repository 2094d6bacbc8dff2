#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "viewer/plan/levels.h"
#include "viewer/volume/gradients.h"

namespace volumen {

/// Rendering methods (design.md 3).
enum class Method { planes, blend, preshaded, gpu, reference };
enum class Resampler { cpu, gl };
/// Light from a reflectance map, from the 4-index 5-bit table that the paper rejects (figure 3b), or directly
/// (paper 2.2).
enum class Shader { automatic, map, table, phong };
/// Look-up in a reflectance map; the paper uses nearest.
enum class MapLookup { nearest, bilinear };

/// Precision of each frame buffer component for --method blend.
enum class Blending { floats, bits16, bits8 };

/// Options for a picture beside the scene. The planner makes the choices left open.
struct RenderOptions {
  glm::ivec2 size{512, 512};
  Quality quality = Quality::standard;
  std::optional<double> step;  ///< Step in voxels: the midpoint rule of picture.md 9 instead of a level
  Method method = Method::planes;
  std::optional<Resampler> resampler;  ///< If empty: gl with Method::gpu, else cpu
  Shader shader = Shader::automatic;
  std::optional<int> precision;  ///< Bits of stored density and gradient components: 8, 16 or 32
  std::optional<int> mapSize;    ///< n of the reflectance map's six n x n faces
  std::optional<MapLookup> mapLookup;
  std::optional<double> tolerance;  ///< Error of a ray as a fraction of white, not a level's; 1e-6 .. 1
  std::optional<double> stopAt;     ///< A ray ends below this transmittance, 0 (never) .. 1
  std::optional<double> opacityThreshold;  ///< Samples below this interval opacity are skipped, 0 .. 1
  std::optional<int> curveTable;           ///< Entries of a classification table; if empty, the exact curve
  GradientOperator gradient = GradientOperator::sobel;
  std::optional<Blending> blending;
  bool withError = false;  ///< Steps that do not tell the error of each pixel are not taken at a level
  int threads = 0;         ///< 0 means all allowed cores
  bool full = false;       ///< Turns off every sound rule: same bytes, slower (design.md 5)
  bool operator==(const RenderOptions&) const = default;
};

}  // namespace volumen
