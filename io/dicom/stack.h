#pragma once

#include <span>

#include "io/dicom/header.h"
#include "io/study/series.h"

namespace volumen::dicom {

/// A slice of a series, and the file that it is in.
struct PlacedSlice {
  Slice slice;
  std::string path;
  double alongNormal = 0;  ///< mm; where neither position nor orientation is known: its number
};

/// How a stack of slices lies in space, as acquired and as drawn.
struct Stack {
  VoxelGeometry acquired;
  std::optional<Series::Regular> regular;
  /// Where each slice of the regular grid comes from: acquired slices `below` and below + 1, the second with
  /// this weight; 0: a copy.
  struct Source {
    int below = 0;
    double weight = 0;
  };
  std::vector<Source> sources;  ///< one entry a slice of the regular grid; empty without one
  /// Of each acquired slice along k of the regular grid, in its slices; empty where all of them are on it.
  std::vector<double> places;
  std::vector<Warning> warnings;
};

/// Lays slices of one size and orientation, in order, out in space (design.md 7 and 10): the step between
/// slices keeps shear, uneven distances give a regular grid besides. Slices without position, orientation or
/// spacing give an uncalibrated volume.
Stack layOut(std::span<const PlacedSlice> slices, int columns, int rows);

/// Lengths of the steps between neighbouring slices, mm along the line through them.
std::vector<double> stepsMm(std::span<const PlacedSlice> slices);

/// The median; the lower of the two in the middle, so that it is a distance that occurs.
double lowerMedian(std::vector<double> values);

/// "1.5", three decimals at most.
std::string millimetres(double mm);

}  // namespace volumen::dicom
