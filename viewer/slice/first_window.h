#pragma once

#include "viewer/slice/grey.h"

namespace volumen {

/// The window that planes through a volume begin with: the file's first, else 40 / 400 of HU (`unit` of the
/// values), else P0.1 .. P99.9 without padding, or 0 .. P99 of what is no background of 0 (slices.md 1).
Window firstWindow(const Volume& volume, const std::string& unit);

/// A window of a volume's values: LINEAR for integers that DICOM stored (`fromDicom`), of a width of 1 or
/// more, else LINEAR_EXACT (slices.md 3).
GreyMapping windowGrey(const Volume& volume, bool fromDicom, Window window);

}  // namespace volumen
