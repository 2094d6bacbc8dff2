#pragma once

#include "io/dicom/header.h"

namespace volumen::dicom {

/// Whether the sizes and counts of a header agree, as in each that inspect(path) gives. Asked of headers that
/// come from a worker, which a file may have taken over.
bool isConsistent(const FileHeader& header, const std::string& path);

}  // namespace volumen::dicom
