#pragma once

#include "viewer/slice/grey.h"

namespace volumen {

/// Of HU where files have none.
inline constexpr Window softTissueWindow{.centre = 40, .width = 400};

/// The window that planes through a volume begin with: the file's first, else softTissueWindow of HU (`unit`
/// of the values), else P0.1 .. P99.9 without padding, or 0 .. P99 of what is no background of 0 (slices.md
/// 1).
Window firstWindow(const Volume& volume, const std::string& unit);

/// A window of a volume's values: LINEAR for integers that DICOM stored (`fromDicom`), of a width of 1 or
/// more, else LINEAR_EXACT (slices.md 3).
GreyMapping windowGrey(const Volume& volume, bool fromDicom, Window window);

}  // namespace volumen
