#pragma once

#include <memory>
#include <span>
#include <utility>

#include "io/dicom/header.h"
#include "io/study/series.h"

namespace volumen::dicom {

/// A slice that all copies share: one that outlasts them, or an own one.
class SharedSlice {
 public:
  SharedSlice() : SharedSlice(Slice()) {}
  explicit SharedSlice(Slice own) : slice_(std::make_shared<const Slice>(std::move(own))) {}
  static SharedSlice of(const Slice& lasting) {
    return SharedSlice(std::shared_ptr<const Slice>(std::shared_ptr<void>(), &lasting));
  }
  static SharedSlice of(Slice&&) = delete;

  operator const Slice&() const { return *slice_; }
  const Slice* operator->() const { return slice_.get(); }

 private:
  explicit SharedSlice(std::shared_ptr<const Slice> slice) : slice_(std::move(slice)) {}

  std::shared_ptr<const Slice> slice_;
};

/// A slice of a series and its file.
struct PlacedSlice {
  SharedSlice slice;
  std::string path;
  double alongNormal = 0;  ///< mm; its number if position or orientation is unknown
};

/// The geometry of a stack of slices, as acquired and as drawn.
struct Stack {
  VoxelGeometry acquired;
  std::optional<Series::Regular> regular;
  /// The source of a slice of the regular grid: acquired slices `below` and below + 1. `weight` is that of
  /// the second; 0 makes a copy.
  struct Source {
    int below = 0;
    double weight = 0;
  };
  std::vector<Source> sources;  ///< one for each slice of the regular grid; empty without one
  /// Position of each acquired slice along k of the regular grid, in slices; empty if all are on it.
  std::vector<double> places;
  std::vector<Warning> warnings;
};

/// Computes the geometry of ordered slices of one size and orientation (design.md 7 and 10). The step between
/// slices keeps shear; uneven distances add a regular grid. Slices without position, orientation or spacing
/// make an uncalibrated volume.
Stack layOut(std::span<const PlacedSlice> slices, int columns, int rows);

/// Returns the distances between neighbouring slices, mm along the line through them.
std::vector<double> stepsMm(std::span<const PlacedSlice> slices);

/// Returns the median, the lower of two middle values, so that it is a distance that occurs.
double lowerMedian(std::vector<double> values);

/// Returns "1.5", with at most three decimals.
std::string millimetres(double mm);

}  // namespace volumen::dicom
