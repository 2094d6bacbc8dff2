#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "viewer/plan/levels.h"
#include "viewer/volume/gradients.h"

namespace volumen {

/// design.md 3.
enum class Method { planes, blend, preshaded, gpu, reference };
enum class Resampler { cpu, gl };
/// Reflectance map, the 4-index 5-bit table that the paper rejects (figure 3b), or directly (paper 2.2).
enum class Shader { automatic, map, table, phong };
/// How a reflectance map is read; the paper's way is nearest.
enum class MapLookup { nearest, bilinear };

/// What the frame buffer of --method blend keeps of a component.
enum class Blending { floats, bits16, bits8 };

/// What the caller asks of a picture beside the scene. Choices left open are the planner's.
struct RenderOptions {
  glm::ivec2 size{512, 512};
  Quality quality = Quality::standard;
  std::optional<double> step;  ///< voxels: the plain midpoint rule of picture.md 9 instead of a level
  Method method = Method::planes;
  std::optional<Resampler> resampler;  ///< none: gl with Method::gpu, else cpu
  Shader shader = Shader::automatic;
  std::optional<int> precision;  ///< bits of the stored density and gradient components: 8, 16 or 32
  std::optional<int> mapSize;    ///< n of the reflectance map's six n x n faces
  std::optional<MapLookup> mapLookup;
  std::optional<double>
      tolerance;  ///< what a ray may be off by, as a share of white, instead of a level's; 1e-6 .. 1
  std::optional<double> stopAt;            ///< a ray ends below this transmittance, 0 (never) .. 1
  std::optional<double> opacityThreshold;  ///< samples of a smaller interval opacity are passed over, 0 .. 1
  std::optional<int> curveTable;           ///< entries of a classification table; none: the exact curve
  GradientOperator gradient = GradientOperator::sobel;
  std::optional<Blending> blending;
  int threads = 0;    ///< 0: all allowed cores
  bool full = false;  ///< every sound rule off: the same bytes, slower (design.md 5)
  bool operator==(const RenderOptions&) const = default;
};

}  // namespace volumen
