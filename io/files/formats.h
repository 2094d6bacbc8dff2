#pragma once

#include <vector>

#include "io/files/other_formats.h"

namespace volumen {

/// A format of image files that is read: what claims to be of it, and how its headers are read.
struct FileFormat {
  const char* name;
  bool (*claims)(const FileClaim& file);
  Result<ImageHeader> (*read)(const std::string& path);
};

/// All of them, in the order in which they are asked; bytes come before names, so that a wrong name does no
/// harm.
const std::vector<FileFormat>& fileFormats();

}  // namespace volumen
