#pragma once

#include <string>

#include "io/dicom/instance_uids.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Where instances go that come from a network, one after the other.
class InstanceSink {
 public:
  virtual ~InstanceSink() = default;
  /// Returns whether it keeps this instance already.
  virtual bool has(const std::string& sopInstanceUid) const = 0;
  /// Returns the path of an empty file, into which the next instance is to be written.
  virtual Result<std::string> begin() = 0;
  /// Keeps that file, which is complete, unless it is of another series, or here already. `uids` are those of
  /// its data set.
  virtual Status end(const dicom::InstanceUids& uids) = 0;
  /// Deletes that file: it is not complete.
  virtual void drop() = 0;
};

/// Returns the Error for a file of begin() that could not be written. It names the folder, as the file is
/// gone.
inline Error cannotWriteInto(const std::string& path) {
  return {"Images cannot be written to " + path.substr(0, path.find_last_of('/')) + ": is the disk full?"};
}

}  // namespace volumen
