#pragma once

#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// What a network needs to know of a DICOM file. UIDs are as in the data set; a header that contradicts it
/// does not count. Empty ones are missing.
struct InstanceUids {
  std::string sopClass, sopInstance, study, series;
  std::string transferSyntax;  ///< that the file names
};

/// Reads the UIDs of a file. The Error is the reason, without the file's name: "it holds no DICOM data".
Result<InstanceUids> uidsIn(const std::string& path);

}  // namespace volumen
