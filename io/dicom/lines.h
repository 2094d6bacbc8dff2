#pragma once

#include <glm/vec3.hpp>

#include "io/dicom/entries.h"

namespace volumen::dicom {

/// How far from the line of its stack a slice may lie, mm: one voxel, or 1 mm where that is more. What is
/// nearer trembles; what is farther belongs to another stack.
double mostOffLineMm(const Slice& slice);

/// The direction in which placed slices, in order, are stacked: a unit vector, and whether all of them agree
/// that it is not their normal (a gantry tilt, a shear).
struct StackDirection {
  glm::dvec3 unit{0, 0, 1};
  bool tilted = false;
};

/// From the first slice to the last where all others lie on that line, within a tenth of what it moves
/// sideways; else the normal, and what is beside it trembles. Two slices cannot tell the two apart: they keep
/// their line, and no tilt is claimed.
StackDirection stackDirection(std::span<const PlacedSlice> slices);

/// Cuts parallel pictures, in order, into stacks, each along one line: two blocks beside each other are two
/// stacks. Pictures without a place are one. `apartMm`: the largest distance across the lines, 0 for one
/// stack.
std::vector<Entries> byLine(const Entries& entries, double& apartMm);

}  // namespace volumen::dicom
