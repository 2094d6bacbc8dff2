#pragma once

#include "io/dicom/entries.h"

namespace volumen::dicom {

/// Pictures of files that each hold a stack, where these lie in each other: a stack a file (or
/// concatenation), in the order of numbers and names. Empty where files are slices or parts of one stack.
std::vector<Entries> stacksOfFiles(const Entries& entries);

/// The same by folder; each holds a picture of several places, and none of them two of one place.
std::vector<Entries> stacksOfFolders(const Entries& entries);

}  // namespace volumen::dicom
