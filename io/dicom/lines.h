#pragma once

#include <glm/vec3.hpp>

#include "io/dicom/entries.h"

namespace volumen::dicom {

/// Returns the largest distance of a slice from the line of its stack, mm: one voxel, but at least 1 mm.
/// Smaller distances are jitter; slices farther away belong to another stack.
double mostOffLineMm(const Slice& slice);

/// The direction in which ordered slices are stacked: a unit vector. `tilted` is true if all slices agree
/// that it is not their normal (gantry tilt, shear).
struct StackDirection {
  glm::dvec3 unit{0, 0, 1};
  bool tilted = false;
};

/// Returns the direction from the first slice to the last if all slices lie on that line within a tenth of
/// its sideways shift. Else returns the normal, as sideways shifts are jitter. Two slices keep their line,
/// but cannot prove a tilt.
StackDirection stackDirection(std::span<const PlacedSlice> slices);

/// Splits ordered parallel pictures into stacks, each along one line: two blocks side by side are two stacks.
/// Pictures without position form one. `apartMm` is set to the largest distance across the lines, 0 for one
/// stack.
std::vector<Entries> byLine(const Entries& entries, double& apartMm);

}  // namespace volumen::dicom
