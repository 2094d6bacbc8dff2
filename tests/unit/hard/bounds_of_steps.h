#pragma once

#include <string>

#include "tests/unit/promises/promises.h"

namespace volumen::tests {

/// Bounds of levelsKeepTheirPromises for blend and OpenGL in rows where they cannot keep a level's promise.
/// Both take plain steps, halved where the curve is sharp, and miss narrower peaks, jumps and plates. Values
/// are measured errors (OpenGL by llvmpipe) plus 5 %. The CPU's planes integrate instead and keep the promise
/// in every row.
struct BoundOfSteps {
  const char* row;
  Promise bound;
};
inline constexpr BoundOfSteps boundsOfSteps[] = {
    {"256 points in a zigzag, over a ramp", {"standard", Quality::standard, 37.8, 4.57, 4.57}},
    {"256 points in a zigzag, over a ramp", {"high", Quality::high, 43.0, 2.97, 2.97}},
    {"256 points in a zigzag, over a ramp, perspective", {"standard", Quality::standard, 26.3, 49.2, 49.2}},
    {"256 points in a zigzag, over a ramp, perspective", {"high", Quality::high, 38.0, 14.8, 14.8}},
    {"256 points in a zigzag, over a ramp, perspective", {"exact", Quality::exact, 59.8, 1.61, 1.61}},
    {"256 points in a zigzag, over waves", {"standard", Quality::standard, 37.0, 15, 15.4}},
    {"256 points in a zigzag, over waves", {"high", Quality::high, 44.0, 8.32, 8.95}},
    {"256 points in a zigzag, over waves, perspective", {"standard", Quality::standard, 35.8, 18.7, 26.9}},
    {"256 points in a zigzag, over waves, perspective", {"high", Quality::high, 44.5, 7.11, 7.52}},
    {"floats of 1e-20, curve with steps, perspective", {"high", Quality::high, 56.7, 2.83, 3.51}},
    {"floats with NaN, infinities and 1e30, curve with steps", {"high", Quality::high, 51.1, 4.36, 9.13}},
    {"left-handed grid, curve with steps, perspective", {"exact", Quality::exact, 65.0, 0.26, 1.96}},
    {"negative slope, curve with steps", {"standard", Quality::standard, 45.5, 11.9, 12.4}},
    {"negative slope, curve with steps", {"exact", Quality::exact, 66.9, 0.41, 1.4}},
    {"negative slope, curve with steps, perspective", {"high", Quality::high, 55.8, 2.66, 2.92}},
    {"one slice of 16 bits, curve with steps", {"exact", Quality::exact, 66.5, 0.93, 1.43}},
    {"one slice of 16 bits, curve with steps, perspective", {"high", Quality::high, 54.2, 3.61, 5.25}},
    {"one slice of 16 bits, curve with steps, perspective", {"exact", Quality::exact, 66.6, 0.69, 1.5}},
    {"one slice, curve with steps", {"high", Quality::high, 53.9, 3.16, 5.71}},
    {"one slice, curve with steps", {"exact", Quality::exact, 64.3, 0.93, 1.81}},
    {"one slice, curve with steps, perspective", {"high", Quality::high, 53.7, 3.72, 6.03}},
    {"peak of a tenth of a voxel, opacity 0.30, unlit", {"standard", Quality::standard, 37.2, 4.46, 4.46}},
    {"peak of a tenth of a voxel, opacity 0.6, over a ramp",
     {"standard", Quality::standard, 29.7, 11.2, 11.2}},
    {"peak of a tenth of a voxel, opacity 0.6, over a ramp", {"high", Quality::high, 44.7, 2.01, 2.01}},
    {"peak of a tenth of a voxel, opacity 0.6, over a ramp, perspective",
     {"standard", Quality::standard, 30.6, 16.7, 16.7}},
    {"peak of a tenth of a voxel, opacity 0.6, over a ramp, perspective",
     {"high", Quality::high, 45.1, 4.74, 4.74}},
    {"peak of a tenth of a voxel, opacity 0.6, over waves",
     {"standard", Quality::standard, 41.7, 12.2, 12.3}},
    {"peak of a tenth of a voxel, opacity 0.6, over waves", {"high", Quality::high, 53.4, 3.74, 4.74}},
    {"peak of a tenth of a voxel, opacity 0.6, over waves, perspective",
     {"standard", Quality::standard, 41.2, 13.6, 14.3}},
    {"peak of a tenth of a voxel, opacity 0.6, over waves, perspective",
     {"high", Quality::high, 52.7, 3.6, 4.43}},
    {"peak of a tenth of a voxel, opacity 0.95, unlit", {"standard", Quality::standard, 23.5, 21.6, 21.6}},
    {"peak of a tenth of a voxel, opacity 0.95, unlit", {"high", Quality::high, 32.9, 7.29, 7.29}},
    {"peak of a tenth of a voxel, opacity 0.95, unlit", {"exact", Quality::exact, 49.4, 1.1, 1.1}},
    {"peak of a tenth of a voxel, opacity 1, over a ramp", {"standard", Quality::standard, 21.8, 28, 28}},
    {"peak of a tenth of a voxel, opacity 1, over a ramp", {"high", Quality::high, 29.7, 11.2, 11.2}},
    {"peak of a tenth of a voxel, opacity 1, over a ramp", {"exact", Quality::exact, 41.7, 2.84, 2.84}},
    {"peak of a tenth of a voxel, opacity 1, over a ramp, perspective",
     {"standard", Quality::standard, 22.1, 52.4, 52.4}},
    {"peak of a tenth of a voxel, opacity 1, over a ramp, perspective",
     {"high", Quality::high, 27.0, 54.1, 54.1}},
    {"peak of a tenth of a voxel, opacity 1, over a ramp, perspective",
     {"exact", Quality::exact, 35.8, 13, 13}},
    {"peak of a tenth of a voxel, opacity 1, over waves", {"standard", Quality::standard, 32.3, 32.8, 40.4}},
    {"peak of a tenth of a voxel, opacity 1, over waves", {"high", Quality::high, 35.9, 26.8, 38.5}},
    {"peak of a tenth of a voxel, opacity 1, over waves", {"exact", Quality::exact, 48.7, 5.71, 6.05}},
    {"peak of a tenth of a voxel, opacity 1, over waves, perspective",
     {"standard", Quality::standard, 29.8, 63.6, 66.9}},
    {"peak of a tenth of a voxel, opacity 1, over waves, perspective",
     {"high", Quality::high, 37.5, 21.7, 26.7}},
    {"peak of a tenth of a voxel, opacity 1, over waves, perspective",
     {"exact", Quality::exact, 51.0, 3.93, 5.45}},
    {"plate of one voxel, 2 degrees off", {"standard", Quality::standard, 35.8, 4.3, 4.3}},
    {"plate of one voxel, 2 degrees off", {"high", Quality::high, 36.1, 4.08, 4.08}},
    {"plate of one voxel, 2 degrees off, perspective", {"standard", Quality::standard, 33.6, 12.5, 13.1}},
    {"plate of one voxel, 2 degrees off, perspective", {"high", Quality::high, 39.7, 4.48, 4.89}},
    {"plate of one voxel, face-on", {"standard", Quality::standard, 35.8, 4.33, 4.33}},
    {"plate of one voxel, face-on", {"high", Quality::high, 34.5, 4.93, 4.93}},
    {"plate of one voxel, face-on, perspective", {"standard", Quality::standard, 32.7, 12.6, 12.6}},
    {"plate of one voxel, face-on, perspective", {"high", Quality::high, 39.0, 4.68, 4.68}},
    {"plate of one voxel, face-on, strong highlight", {"standard", Quality::standard, 27.5, 10.9, 10.9}},
    {"plate of one voxel, face-on, strong highlight", {"high", Quality::high, 26.8, 11.8, 11.8}},
    {"plate of one voxel, face-on, strong highlight, perspective",
     {"standard", Quality::standard, 24.7, 31.2, 31.2}},
    {"plate of one voxel, face-on, strong highlight, perspective", {"high", Quality::high, 31.3, 11.2, 11.2}},
    {"plate of two voxels, face-on", {"high", Quality::high, 43.1, 1.84, 1.84}},
    {"plate of two voxels, face-on, perspective", {"standard", Quality::standard, 37.3, 10.6, 10.6}},
    {"plate of two voxels, face-on, perspective", {"high", Quality::high, 41.1, 4.6, 4.6}},
    {"signed 16-bit full range, curve with steps", {"high", Quality::high, 55.7, 3.02, 3.16}},
    {"slope 0.01, curve with steps", {"high", Quality::high, 55.7, 3.02, 3.16}},
    {"spacing 0.3 x 0.3 x 5, curve with steps, perspective", {"exact", Quality::exact, 70.0, 0.33, 1.06}},
    {"two slices, curve with steps", {"high", Quality::high, 59.0, 2.66, 3.32}},
    {"two slices, curve with steps, perspective", {"high", Quality::high, 52.0, 5.07, 7.25}},
    {"two slices, curve with steps, perspective", {"exact", Quality::exact, 67.1, 0.98, 1.13}},
    {"unsigned 16-bit full range, curve with steps", {"high", Quality::high, 55.7, 3.02, 3.16}},
};

/// Returns the bound of `row` for plain steps, or `promise` if the row has none.
inline const Promise& boundOfSteps(const std::string& row, const Promise& promise) {
  for (const BoundOfSteps& b : boundsOfSteps)
    if (row == b.row && promise.quality == b.bound.quality) return b.bound;
  return promise;
}

}  // namespace volumen::tests
