#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "io/dicom/instance_uids.h"
#include "io/files/output_file.h"

namespace volumen {

/// What became of an instance that a peer sent.
struct Filed {
  unsigned status = 0;  ///< answer to the peer (PS3.4 B.2.3, PS3.7 C): 0: it is on disk
  std::string problem;  ///< why it is not, as the end of a sentence, without full stop
  std::string path;
  dicom::InstanceUids uids;
  std::uint64_t bytes = 0;   ///< size of its file
  bool alreadyHere = false;  ///< the same bytes were there before
};

/// Statuses of C-STORE: nothing can be written; the data set lacks what it must have, or cannot be read;
/// another instance has its UID; nobody asked for it.
inline constexpr unsigned outOfResources = 0xa700, lacksUids = 0xa900, notUnderstood = 0xc000,
                          isDuplicate = 0x0111, notAuthorized = 0x0124;

/// A folder in which instances are filed as STUDY/SERIES/INSTANCE.dcm, each whole or not at all. The names
/// are made of their UIDs (nameForUid()). Several threads may use it at once.
class ReceivedFiles {
 public:
  /// `folder` must exist.
  ReceivedFiles(std::string folder, std::function<bool(const dicom::InstanceUids&)> wants)
      : folder_(std::move(folder)), wants_(std::move(wants)) {}

  /// Creates a file for the next instance, which has no place yet.
  Result<OutputFile> begin() const { return OutputFile::create(folder_ + "/instance.dcm"); }
  /// Files a complete one by the UIDs in its data set, whatever its sender calls it. The instance is on disk
  /// afterwards, or refused. Never replaces an instance that has other bytes.
  Filed file(OutputFile& instance);

 private:
  static Filed keep(OutputFile& instance, Filed filed);

  const std::string folder_;
  const std::function<bool(const dicom::InstanceUids&)> wants_;  // see ReceiveEvents
};

}  // namespace volumen
