#pragma once

namespace volumen {

struct Plan;

/// Storage of density and gradients for CPU kernels: 16-bit integers with 4 x 16-bit gradients, floats with 4
/// x float gradients, one byte per voxel without gradients, or four with them. `plane` is a plane of rays
/// filled by another resampler (GL): floats, one row per step.
enum class Store { int16, float32, byte1, byte4, plane };

/// Samples of a ray that a kernel takes.
enum class Sampling {
  dense,         ///< Plain steps, density and gradient at each
  visibleCells,  ///< Plain steps, only in cells that can show something; the same bytes
  nested,        ///< The same, compared with every other step; only for int16 and float32
  passages       ///< Cell by cell: integrated to an ErrorBudget, or exactly in a projection
};

/// The properties that CPU kernels of planes or slices are compiled for, chosen once per frame. Kernels check
/// all other properties of the frame at run time, once per vector of samples.
struct KernelKey {
  Store store = Store::int16;
  Sampling sampling = Sampling::dense;
  bool lit = false;  ///< True if samples are lit (RayInputs::light)
  bool gradientOpacity = false;
};

/// Returns the kernel that draws a plan; only later effect lines may be missing.
KernelKey kernelKey(const Plan& plan);

}  // namespace volumen
