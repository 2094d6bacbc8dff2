#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "viewer/acceleration/empty_space_map.h"
#include "viewer/acceleration/visible_cells.h"
#include "viewer/kernels/ray_row.h"
#include "viewer/plan/kernel_key.h"
#include "viewer/scene/scene.h"
#include "viewer/tables/curve_table.h"
#include "viewer/tables/lighting.h"
#include "viewer/tables/opacity_correction.h"
#include "viewer/tables/reflectance_map.h"
#include "viewer/tables/shade_table.h"

namespace volumen {

/// How visible samples are lit (ClassifyAndLight). `phong`: directly, with one viewer. `localPhong`:
/// directly, with one viewer per ray. `map`: by a reflectance map, bilinear. `nearestInMap`: by its nearest
/// patch. `table`: colour and light together, from the 4-index table.
enum class LightModel { phong, localPhong, map, nearestInMap, table };

/// Accuracy of rays that go cell by cell, in shares of white. A part of a ray is cut while its error exceeds
/// its share. A part that contributes a share w of the ray's light may be off by most * max(w, leastShare).
struct ErrorBudget {
  static constexpr float leastShare = 1.0f / 128;
  float most = 1;  ///< Budget of a whole ray.
};

/// Total strength of the light, whatever the normal. It bounds how much light a part of a ray may miss
/// between two samples (PartRule).
struct LightStrength {
  float ambient = 0, diffuse = 0, specular = 0, shininess = 1;
};

/// Blends slices back to front instead of compositing rays front to back (paper 3.2). Only for kernels that
/// fetch density and gradient together. Slices hidden at RayInputs::stopTransmittance are left out: rays are
/// first followed from the front to that point.
struct Slices {
  bool fromBack = false;
  /// Largest value of a frame buffer component, 0 for floats. Results of each slice are rounded to such
  /// values and limited to 1.
  float levels = 0;
};

/// Data shared by all rays of a picture. The pointers live as long as the inputs.
struct RayInputs {
  glm::ivec3 size{1};  ///< Size in voxels.
  const std::int16_t* density16 = nullptr;
  std::uint32_t flip16 = 0;  ///< Xor mask for a pair of 16-bit values: 0x80008000 if they are unsigned.
  const float* density32 = nullptr;
  const std::int16_t* voxels16 = nullptr;  ///< Gradients16::xyzd, or bricks of GradientBricks16.
  const std::int32_t* bricks = nullptr;    ///< GradientBricks16::first; null if all gradients are there.
  const float* gradients32 = nullptr;
  const std::uint8_t* density8 = nullptr;  ///< Density8::bytes.
  const std::uint32_t* voxels8 = nullptr;  ///< Voxels8::words.
  /// Distance of rows along i, in voxels: for densities alone, and for gradients with or without densities.
  int densityRow = 1, gradientRow = 1;
  float gradientMatrix[9] = {};   ///< Row-major: stored gradient to gradientUnit per mm in patient space.
  float gradientUnit = 1;         ///< Unit of transformed gradients, as a real value per mm.
  bool boundedGradients = false;  ///< True if squares of such gradients neither overflow nor vanish.
  float inverseFloor = 0;         ///< 1 / gradientFloor; 0: q = 0 everywhere.
  const CurveTable* curve = nullptr;
  float inverseUnitMm = 1;     ///< 1 / unitDistance.
  CorrectionSeries intervals;  ///< Opacity correction of whole steps of parallel rays; empty for others.
  const EmptySpaceMap* skip = nullptr;   ///< Null: every packet is sampled everywhere.
  const VisibleCells* cells = nullptr;   ///< Null if the kernel does not test cells (KernelKey).
  LightModel light = LightModel::phong;  ///< Used if the kernel lights (KernelKey).
  const Lighting* lighting = nullptr;
  const ReflectanceMap* map = nullptr;
  const ShadeTable* table = nullptr;
  const TransferFunction* transfer = nullptr;  ///< Source of gradientOpacity.
  float stopTransmittance = 0;  ///< Early ray termination; 0: no ray ends before its last sample.
  Slices slices;
  /// The largest gradient of gradientOpacity's points (value / mm), and the number of these per stored unit.
  float factorUnit = 1, factorUnitsAStored = 0;
  LightStrength lightStrength;
  ErrorBudget budget;            ///< Used if the kernel goes cell by cell (KernelKey).
  LightStrength strongestLight;  ///< The maximum of each strength over single lights.
};

/// A plane of rays that another resampler has filled: density[step * stride + ray], and four gradient floats
/// per sample in the units of gradientMatrix. Null pointers stand for data that the picture does not need.
struct PlaneBuffer {
  const float* density = nullptr;
  const float* gradients = nullptr;
  int stride = 0;
};

/// Results of one row of rays: premultiplied colour and alpha, one entry per ray (padded as the rays are).
struct TraceRow {
  float *red, *green, *blue, *alpha;
  /// In shares of white: a bound on the error of colours and alpha by kernels that go cell by cell, the
  /// change from steps of twice the length by nested ones. Others leave it as it is.
  float* error = nullptr;
  /// Last visible step of each ray. Rays from the front write it, slices from the back start at it. Null:
  /// unused.
  float* shown = nullptr;
};

/// Counts over a row.
struct TraceCounts {
  std::int64_t resampled = 0, composited = 0;
  std::int64_t shadeTicks = 0, allTicks = 0;  ///< Ticks of the time stamp counter.
  std::int64_t surfacesNs = 0;                ///< Time for finding and lighting surfaces of segments.
};

/// Resamples, classifies, shades and composites one row of rays front to back, or slices back to front (paper
/// 3.1, 3.2; picture.md 4 to 6 and 9).
using TraceKernel = void (*)(const RayInputs&, const RayRow&, const PlaneBuffer&, const TraceRow&,
                             TraceCounts&);
TraceKernel chooseTraceKernel(KernelKey key);
// Kernels of one store, or of the levels. Each has its own file, as each holds many kernels. Those of one
// store ignore `key.store`.
TraceKernel chooseTraceLevels(KernelKey key);  ///< For rays that go cell by cell, over int16 or float32.
TraceKernel chooseTraceInt16(KernelKey key);
TraceKernel chooseTraceFloat32(KernelKey key);
TraceKernel chooseTraceBytes(KernelKey key);
TraceKernel chooseTracePlane(KernelKey key);

/// Returns the CPU target that the kernels run on, e.g. "AVX3".
const char* kernelTarget();

}  // namespace volumen
