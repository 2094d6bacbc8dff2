#pragma once

#include <string>

#include "viewer/volume/result.h"

namespace volumen::dicom {

/// The UIDs in a data set of its study, its series, itself and its class (PS3.3 C.7.2.1, C.7.3.1, C.12.1),
/// and the transfer syntax that its file names; without padding. Peers may send anything in them. Empty:
/// missing.
struct InstanceUids {
  std::string study, series, instance, sopClass, transferSyntax;
};

/// Returns the UIDs of a file, read in a worker if there are any (io/worker). The Error, without the file's
/// name and full stop: it cannot be read far enough (see worker::isReasonOfMachine()).
Result<InstanceUids> instanceUids(const std::string& path);

}  // namespace volumen::dicom
