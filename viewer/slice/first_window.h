#pragma once

#include "viewer/slice/grey.h"

namespace volumen {

/// The window of HU if the file has none.
inline constexpr Window softTissueWindow{.centre = 40, .width = 400};

/// Returns the initial window for slices: the file's first. Otherwise softTissueWindow for HU (`unit` of the
/// values), else P0.1 .. P99.9 without padding, or 0 .. P99 above a background of 0 (slices.md 1).
Window firstWindow(const Volume& volume, const std::string& unit);

/// Returns the mapping for a window: LINEAR for integers stored by DICOM (`fromDicom`) and widths of at least
/// 1, else LINEAR_EXACT (slices.md 3).
GreyMapping windowGrey(const Volume& volume, bool fromDicom, Window window);

}  // namespace volumen
