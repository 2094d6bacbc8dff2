#pragma once

#include <memory>
#include <string>

#include "io/dicom/header.h"
#include "io/file_state.h"

namespace volumen::dicom {

/// Headers that were read, for whoever needs them again: slices are looked at as a study is opened, and again
/// as their series is loaded. `state`: of the file before it was read. Where there are many, those that were
/// kept first are forgotten. For any thread.
void keepHeader(const std::string& path, const FileState& state, const FileHeader& header);

/// The header of a file that is as it was when that was kept; null: none is.
std::shared_ptr<const FileHeader> keptHeader(const std::string& path);

}  // namespace volumen::dicom
