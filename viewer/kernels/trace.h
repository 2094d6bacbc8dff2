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

/// How visible samples are lit (ClassifyAndLight): directly, with one viewer or each ray with its own; by a
/// reflectance map, bilinear or its nearest patch; colour and light together from the 4-index table.
enum class LightModel { phong, localPhong, map, nearestInMap, table };

/// How exact rays that go cell by cell are integrated, in shares of white: a part of a ray is cut while what
/// it is off by is more than its share. A part whose light is a share w of what a ray shows may be off by
/// most * max(w, leastShare).
struct ErrorBudget {
  static constexpr float leastShare = 1.0f / 128;
  float most = 1;  ///< of a whole ray
};

/// How much light there is, whatever the normal: what bounds how much of it a part of a ray may miss between
/// two looks (PartRule).
struct LightStrength {
  float ambient = 0, diffuse = 0, specular = 0, shininess = 1;
};

/// Slices from the back to the front in place of rays from the front to the back (paper 3.2); for kernels
/// that fetch density and gradient together. What lies behind RayInputs::stopTransmittance is left out:
/// rays are first followed from the front, as far as that.
struct Slices {
  bool fromBack = false;
  float levels = 0;  ///< the largest value of a component of the frame buffer, to whose values what a slice
                     ///< leaves is rounded, none above 1; 0: floats
};

/// What all rays of a picture share. Pointers live as long as the inputs.
struct RayInputs {
  glm::ivec3 size{1};  ///< voxels
  const std::int16_t* density16 = nullptr;
  std::uint32_t flip16 = 0;  ///< xor for a pair of 16-bit values: 0x80008000 where they are unsigned
  const float* density32 = nullptr;
  const std::int16_t* voxels16 = nullptr;  ///< Gradients16::xyzd
  const float* gradients32 = nullptr;
  const std::uint8_t* density8 = nullptr;  ///< Density8::bytes
  const std::uint32_t* voxels8 = nullptr;  ///< Voxels8::words
  int densityRow = 1, gradientRow = 1;  ///< voxels from a row along i to the next, of densities alone and of
                                        ///< gradients with or without them
  float gradientMatrix[9] = {};   ///< row-major: stored gradient -> gradientUnit per mm in patient space
  float gradientUnit = 1;         ///< real value
  bool boundedGradients = false;  ///< squares of such gradients neither overflow nor vanish
  float inverseFloor = 0;         ///< 1 / gradientFloor; 0: q = 0 everywhere
  const CurveTable* curve = nullptr;
  float inverseUnitMm = 1;               ///< 1 / unitDistance
  CorrectionSeries intervals;            ///< of whole steps where rays are parallel, else none
  const EmptySpaceMap* skip = nullptr;   ///< null: every packet is looked at
  const VisibleCells* cells = nullptr;   ///< null where the kernel does not ask (KernelKey)
  LightModel light = LightModel::phong;  ///< where the kernel lights (KernelKey)
  const Lighting* lighting = nullptr;
  const ReflectanceMap* map = nullptr;
  const ShadeTable* table = nullptr;
  const TransferFunction* transfer = nullptr;  ///< for its gradientOpacity
  float stopTransmittance = 0;                 ///< early ray termination; 0: none ends before its last sample
  Slices slices;
  /// The largest gradient of gradientOpacity's points (value / mm), and how many of these a stored unit is.
  float factorUnit = 1, factorUnitsAStored = 0;
  LightStrength lightStrength;
  ErrorBudget budget;            ///< where the kernel goes cell by cell (KernelKey)
  LightStrength strongestLight;  ///< the most that a single light has of each
};

/// A plane of rays resampled by another resampler: density[step * stride + ray]; gradients four floats a
/// sample, in the units of gradientMatrix. Null pointers where the picture has none.
struct PlaneBuffer {
  const float* density = nullptr;
  const float* gradients = nullptr;
  int stride = 0;
};

/// What one row of rays came to: premultiplied colour and alpha, one entry a ray (padded as the rays are).
struct TraceRow {
  float *red, *green, *blue, *alpha;
  float* error = nullptr;  ///< where the kernel goes cell by cell: how far colours and alpha may be off, in
                           ///< shares of white
  float* shown = nullptr;  ///< the last step that shows on each ray: rays from the front note it, slices from
                           ///< the back begin with it; null: not asked
};

/// Counted over a row.
struct TraceCounts {
  std::int64_t resampled = 0, composited = 0;
  std::int64_t shadeTicks = 0, allTicks = 0;  ///< of the time stamp counter
  std::int64_t surfacesNs = 0;                ///< finding and lighting surfaces of segments
};

/// Resamples, classifies, shades and composites one row of rays front to back, or slices of them back to
/// front (paper 3.1, 3.2, picture.md 9 and 4 .. 6).
using TraceKernel = void (*)(const RayInputs&, const RayRow&, const PlaneBuffer&, const TraceRow&,
                             TraceCounts&);
TraceKernel chooseTraceKernel(KernelKey key);
// The same for some; a file each, as each holds many kernels. Those of one store do not look at `key.store`.
TraceKernel chooseTraceLevels(KernelKey key);  ///< rays that go cell by cell, over int16 or float32
TraceKernel chooseTraceInt16(KernelKey key);
TraceKernel chooseTraceFloat32(KernelKey key);
TraceKernel chooseTraceBytes(KernelKey key);
TraceKernel chooseTracePlane(KernelKey key);

/// The CPU target that the kernels run on, e.g. "AVX3".
const char* kernelTarget();

}  // namespace volumen
