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

/// The same of a header that is shared.
void keepHeader(const std::string& path, const FileState& state, std::shared_ptr<const FileHeader> header);

/// The header of a file that is as it was when that was kept; null: none is.
std::shared_ptr<const FileHeader> keptHeader(const std::string& path);

/// While one lives, headers of files that were just written are kept, too, and none is forgotten: for work
/// that loads many volumes of the same files in turn. For any thread.
class HeldHeaders {
 public:
  HeldHeaders();
  ~HeldHeaders();
  HeldHeaders(const HeldHeaders&) = delete;
  HeldHeaders& operator=(const HeldHeaders&) = delete;
};

}  // namespace volumen::dicom
