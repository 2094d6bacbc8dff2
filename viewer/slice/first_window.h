#pragma once

#include "viewer/slice/grey.h"

namespace volumen {

/// The window that a flat view of a volume begins with: the file's first, else P0.1 .. P99.9 without padding
/// (SLICE 2).
Window firstWindow(const Volume& volume);

/// A window of a volume's values: LINEAR for integers that DICOM stored (`fromDicom`), of a width of 1 or
/// more, else LINEAR_EXACT (SLICE 3).
GreyMapping windowGrey(const Volume& volume, bool fromDicom, Window window);

}  // namespace volumen
