#pragma once

#include <span>

#include "io/dicom/decode.h"
#include "io/dicom/series.h"

namespace volumen::dicom {

/// The padding of a volume. Each slice has its own, in stored values (PS3.3 C.7.5.1.1.2). If they agree, it
/// is that range. Else it is one value, the lowest of theirs, which all padded voxels get.
struct Padding {
  ValueRange values;          ///< real values, as in the voxels
  std::optional<double> one;  ///< the stored value for all padded voxels; empty if slices agree
};

/// Returns the padding of the slices of one volume, or nothing if none has padding.
std::optional<Padding> paddingOf(std::span<const PlacedSlice> slices);

/// Problems found when storing samples as voxels.
struct Stored {
  bool inexact = false;     ///< a sample is wider than float32 holds exactly
  bool doesNotFit = false;  ///< a sample does not fit the volume's type
};

/// Writes the samples of a slice to `volume` from `offset` on, as `plan` says.
Stored storeSamples(const Samples& samples, const Slice& slice, const ValuePlan& plan,
                    const std::optional<Padding>& padding, std::size_t offset, VoxelValues& volume);

}  // namespace volumen::dicom
