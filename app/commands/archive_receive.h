#pragma once

#include <string>

#include "io/archive/archives.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Options of `archive receive`.
struct ReceiveOptions {
  std::string list;    ///< path of the file of archives
  std::string folder;  ///< empty: into the index
  std::string index;   ///< folder of the index; empty: the user's
  bool json = false;   ///< one line an instance, instead of one an association
};

/// Runs `archive receive`: listens until `cancel` is set. What came is in the index when it returns. Returns
/// the exit status.
int receiveFromPeers(const Archives& archives, const ReceiveOptions& options, const CancelToken& cancel);

}  // namespace volumen
