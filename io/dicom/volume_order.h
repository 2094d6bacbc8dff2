#pragma once

#include "io/dicom/split.h"

namespace volumen::dicom {

/// Sorts volumes that several attributes separate by image number, provided that each attribute's values stay
/// in order. Otherwise leaves them unchanged.
void orderByNumbers(std::vector<Split>& splits);

}  // namespace volumen::dicom
