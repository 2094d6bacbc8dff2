#pragma once

#include <string>
#include <vector>

#include "io/dicom/entries.h"

namespace volumen::dicom {

/// Drops pictures that are in the study twice: of one SOPInstanceUID and frame, and the same in place,
/// number, rescale, attributes and, where they are written alike, in pixels. Sentences say so, and where one
/// UID is that of several pictures, which all stay.
std::vector<std::string> dropCopies(Entries& entries);

}  // namespace volumen::dicom
