#pragma once

#include "io/dicom/header.h"

namespace volumen::dicom {

/// Returns whether a picture may have this size (Rows and Columns, PS3.3 C.7.6.3.1).
bool isPictureSize(int columns, int rows);

/// Returns whether the sizes and counts of a header agree, as inspect(path) guarantees. Used for headers from
/// a worker, which a file may have taken over.
bool isConsistent(const FileHeader& header, const std::string& path);

}  // namespace volumen::dicom
