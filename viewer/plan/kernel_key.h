#pragma once

namespace volumen {

struct Plan;

/// How the CPU's kernels read density (and gradients): 16-bit integers with 4 x 16-bit gradients, floats with
/// 4 x float gradients, a byte a voxel without gradients, four bytes a voxel with them, or a plane of rays
/// that another resampler (GL) has filled: floats, one row a step.
enum class Store { int16, float32, byte1, byte4, plane };

/// Which samples of a ray a kernel takes.
enum class Sampling {
  dense,         ///< plain steps, density and gradient at each
  visibleCells,  ///< plain steps, those in cells that can show something; the same bytes
  passages       ///< from cell to cell, each integrated to an ErrorBudget, or exactly in a projection
};

/// What a kernel of planes or slices on the CPU is compiled for; chosen once a frame. Whatever else a frame
/// asks for, its kernel asks of the frame, a vector of samples at a time.
struct KernelKey {
  Store store = Store::int16;
  Sampling sampling = Sampling::dense;
  bool lit = false;  ///< by RayInputs::light
  bool gradientOpacity = false;
};

/// The kernel that draws a plan; of one that is complete but for its later lines, too.
KernelKey kernelKey(const Plan& plan);

}  // namespace volumen
