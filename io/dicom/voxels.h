#pragma once

#include <span>

#include "io/dicom/decode.h"
#include "io/dicom/series.h"

namespace volumen::dicom {

/// What is padding in a volume. Slices say it each for itself, in stored values (PS3.3 C.7.5.1.1.2): where
/// they agree it is that range, else one value, the lowest of theirs, which all padded voxels are given.
struct Padding {
  ValueRange values;          ///< real values, as the voxels have them
  std::optional<double> one;  ///< the stored value that stands for all; empty: slices agree
};

/// Of slices in one volume; nothing where none has padding.
std::optional<Padding> paddingOf(std::span<const PlacedSlice> slices);

/// What was noticed where samples became voxels.
struct Stored {
  bool inexact = false;     ///< a sample is wider than float32 holds exactly
  bool doesNotFit = false;  ///< a sample is none of the volume's type
};

/// Writes the samples of a slice into `volume`, from `offset` on, as `plan` says.
Stored storeSamples(const Samples& samples, const Slice& slice, const ValuePlan& plan,
                    const std::optional<Padding>& padding, std::size_t offset, VoxelValues& volume);

}  // namespace volumen::dicom
