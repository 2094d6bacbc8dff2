#pragma once

#include <vector>

#include "io/study/unread.h"
#include "io/study/warning.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// The source slices of a drawn slice of a DICOM series, as indices into Series::files. If the two differ,
/// the drawn slice lies between them and is interpolated.
struct SliceOrigin {
  int below = 0, above = 0;
  bool isInterpolated() const { return below != above; }
};

/// A loaded series. `acquired` holds the slices as acquired (what `info --values` describes). `drawn` holds
/// the regular grid, the same pointer if the two do not differ. `warnings` are those of the series and of
/// loading.
struct Loaded {
  VolumePtr acquired, drawn;
  std::vector<Warning> warnings;
  std::vector<Unread> unread = {};        ///< files lost to the series and during loading
  std::vector<SliceOrigin> origins = {};  ///< one for each drawn slice (DICOM)
  /// Position of each acquired slice along k of `drawn`, in slices (DICOM). Empty if all of them are drawn.
  std::vector<double> places = {};

  /// Returns the number of slices of `drawn` that are not as acquired.
  int interpolatedSlices() const;
};

}  // namespace volumen
