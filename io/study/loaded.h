#pragma once

#include <vector>

#include "io/study/unread.h"
#include "io/study/warning.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// What a drawn slice of a DICOM series was made of: entries of Series::files. Two that differ: it lies
/// between them and is interpolated.
struct SliceOrigin {
  int below = 0, above = 0;
  bool isInterpolated() const { return below != above; }
};

/// A loaded series. `acquired` holds the slices as acquired (what `info --values` describes); `drawn` the
/// regular grid (the same pointer where they do not differ). `warnings`: the series' and those of loading.
struct Loaded {
  VolumePtr acquired, drawn;
  std::vector<Warning> warnings;
  std::vector<Unread> unread = {};        ///< the series' and those of loading
  std::vector<SliceOrigin> origins = {};  ///< DICOM: of each drawn slice
  /// DICOM: where each acquired slice lies along k of `drawn`, in slices; none where all of them are drawn.
  std::vector<double> places = {};

  /// How many slices of `drawn` are not as acquired.
  int interpolatedSlices() const;
};

}  // namespace volumen
