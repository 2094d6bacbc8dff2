#pragma once

#include <vector>

#include "io/files/other_formats.h"

namespace volumen {

/// A format of image files that can be read: its test for files and its header reader.
struct FileFormat {
  const char* name;
  bool (*claims)(const FileClaim& file);
  Result<ImageHeader> (*read)(const std::string& path);
};

/// Returns all formats in the order in which they are tested. Tests of bytes come before those of names, so
/// that a wrong name does no harm.
const std::vector<FileFormat>& fileFormats();

}  // namespace volumen
