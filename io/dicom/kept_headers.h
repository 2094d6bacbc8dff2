#pragma once

#include <memory>
#include <string>

#include "io/dicom/header.h"
#include "io/file_state.h"

namespace volumen::dicom {

/// Keeps a header for reuse, as slices are read when a study is opened and again when a series is loaded.
/// `state` is that of the file before reading. Beyond a limit the oldest headers are dropped. Thread-safe.
void keepHeader(const std::string& path, const FileState& state, const FileHeader& header);

void keepHeader(const std::string& path, const FileState& state, std::shared_ptr<const FileHeader> header);

/// Returns the kept header of a file that has not changed since, or null.
std::shared_ptr<const FileHeader> keptHeader(const std::string& path);

/// While an instance exists, headers of files just written are kept too, and none is dropped. For work that
/// loads many volumes of the same files in turn. Thread-safe.
class HeldHeaders {
 public:
  HeldHeaders();
  ~HeldHeaders();
  HeldHeaders(const HeldHeaders&) = delete;
  HeldHeaders& operator=(const HeldHeaders&) = delete;
};

}  // namespace volumen::dicom
