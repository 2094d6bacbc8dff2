#pragma once

#include <string>
#include <vector>

#include "io/dicom/entries.h"

namespace volumen::dicom {

/// Drops pictures that occur twice: equal SOPInstanceUID, frame, position, number, rescale and attributes,
/// and equal pixel bytes if both are coded alike. Returns sentences about dropped copies, and about UIDs
/// shared by different pictures, which all stay.
std::vector<std::string> dropCopies(Entries& entries);

}  // namespace volumen::dicom
