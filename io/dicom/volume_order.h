#pragma once

#include "io/dicom/split.h"

namespace volumen::dicom {

/// Puts volumes that several attributes tell apart into the order of their image numbers, where that is an
/// order of the values of each attribute, too; else they stay.
void orderByNumbers(std::vector<Split>& splits);

}  // namespace volumen::dicom
