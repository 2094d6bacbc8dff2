#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/study/unread.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// What `volumen export --as` writes: PATH, the file, and the values of the options of formats.
struct ExportJob {
  std::string path, output;
  std::string series, shapes, images, title, segments;
};

/// What was written.
struct Exported {
  std::vector<std::string> notes{};  ///< sentences for the user
  std::vector<Unread> unread{};      ///< files that could not be read
};

/// A format of `volumen export --as`.
struct ExportFormat {
  using Value = std::string ExportJob::*;

  const char* name;          ///< "sr"
  const char* text;          ///< what it is: "measurements as a DICOM structured report"
  Value needs;               ///< the option that it cannot do without
  std::vector<Value> takes;  ///< other options
  Result<Exported> (*write)(const ExportJob& job, const CancelToken& cancel);
};

/// Returns all formats.
std::span<const ExportFormat> exportFormats();

}  // namespace volumen
