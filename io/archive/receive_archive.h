#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "io/archive/archives.h"
#include "io/dicom/instance_uids.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// An instance that a peer sent and that is on disk.
struct Received {
  std::string path, studyFolder;
  std::string studyUid, seriesUid, sopInstanceUid;  ///< as in the data set, which may hold anything
  std::string callingAe;                            ///< AE title of the peer
  std::uint64_t bytes = 0;                          ///< size of the file
  bool alreadyHere = false;                         ///< the same instance was there before
};

/// An association of a peer that has ended.
struct ReceivedAssociation {
  std::string callingAe, address;                ///< AE title and IP address of the peer
  int stored = 0, alreadyHere = 0, refused = 0;  ///< numbers of instances
  bool isVerified = false;                       ///< the peer verified that we answer (C-ECHO)
  /// Why the association was rejected or broken, or an instance refused, as the end of a sentence without
  /// full stop; empty if all went well.
  std::string problem;
};

/// Functions that are called while volumen listens, one at a time, by threads of the listener. They may be
/// empty.
struct ReceiveEvents {
  std::function<void()> onListening;  ///< peers can connect from now on
  std::function<void(const Received&)> onStored;
  std::function<void(const ReceivedAssociation&)> onEnded;
  /// Returns whether an instance is wanted; others are refused. Called before the instance gets its place, by
  /// several threads at once. If empty, all are wanted.
  std::function<bool(const dicom::InstanceUids&)> wants;
};

/// What came while volumen listened.
struct ReceiveReport {
  int associations = 0;
  int stored = 0, alreadyHere = 0, refused = 0;  ///< numbers of instances
};

/// Listens for peers until `cancel` is set, and files what they send (Storage SCP, PS3.4 B) in `folder` as
/// STUDY/SERIES/INSTANCE.dcm, each with the bytes that its peer sends. A peer is told that an instance is
/// stored when it is on disk under its name. Also answers C-ECHO (Verification SCP, PS3.4 A). Associations
/// are independent of each other. Connections that are not associated within 3 s and associations that are
/// silent for 30 s are ended. The Error: the port or the folder cannot be used.
Result<ReceiveReport> receiveInstances(const Listening& listening, const std::string& folder,
                                       const ReceiveEvents& events, const CancelToken& cancel);

}  // namespace volumen
