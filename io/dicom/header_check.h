#pragma once

#include "io/dicom/header.h"

namespace volumen::dicom {

/// Whether a picture may have this size (Rows and Columns, PS3.3 C.7.6.3.1).
bool isPictureSize(int columns, int rows);

/// Whether the sizes and counts of a header agree, as in each that inspect(path) gives. Asked of headers that
/// come from a worker, which a file may have taken over.
bool isConsistent(const FileHeader& header, const std::string& path);

}  // namespace volumen::dicom
