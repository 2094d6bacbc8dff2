#pragma once

#include "io/dicom/entries.h"

namespace volumen::dicom {

/// Returns one stack for each file (or concatenation), in order of numbers and names. Returns nothing if
/// files are slices. With `reachOverOne` it also returns nothing if the stacks share no position, as they may
/// be parts of one stack (mosaics excepted).
std::vector<Entries> stacksOfFiles(const Entries& entries, bool reachOverOne = true);

/// Returns one stack for each folder, or nothing unless each has several positions with one picture each.
std::vector<Entries> stacksOfFolders(const Entries& entries);

}  // namespace volumen::dicom
