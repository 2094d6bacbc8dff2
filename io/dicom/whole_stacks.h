#pragma once

#include "io/dicom/entries.h"

namespace volumen::dicom {

/// Pictures of files that each hold a stack: a stack a file (or concatenation), in the order of numbers and
/// names. Empty where files are slices, or may be parts of one stack as they do not all reach over one place
/// (`reachOverOne`).
std::vector<Entries> stacksOfFiles(const Entries& entries, bool reachOverOne = true);

/// The same by folder; each holds a picture of several places, and none of them two of one place.
std::vector<Entries> stacksOfFolders(const Entries& entries);

}  // namespace volumen::dicom
