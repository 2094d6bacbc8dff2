#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmnet/assoc.h>
#include <dcmtk/dcmnet/dimse.h>
#include <dcmtk/dcmtls/tlslayer.h>

#include <cstring>
#include <map>
#include <utility>

#include "io/archive/association.h"
#include "io/archive/network_use.h"
#include "io/archive/watched_transport.h"

namespace volumen {

/// Most bytes of a command, or of an answer that is no instance. DCMTK reads nested sequences recursively:
/// more than some 8,000 of them, of 16 bytes each, would overflow the stack.
inline constexpr std::uint64_t mostBytesOfCommand = 100'000;

/// What the files of Association share.
struct Association::Private {
  Private(Archive to, const CancelToken& cancel);
  ~Private();

  Status prepare();
  /// Returns a connection's failure as a sentence. The association is broken from then on.
  Error failure(const OFCondition& why, T_ASC_Parameters* parameters = nullptr);
  /// Returns "The archive "X" PREDICATE.".
  Error says(const std::string& predicate) const;
  T_ASC_PresentationContextID contextOf(const std::string& sopClass) const;
  /// Returns the context for a class in a transfer syntax; 0 if the archive takes none.
  T_ASC_PresentationContextID contextOf(const std::string& sopClass, const std::string& syntax) const;
  /// Sends a data set and returns what Association::store() does.
  Result<std::string> store(const dicom::InstanceUids& uids, T_ASC_PresentationContextID context,
                            DcmDataset& data);
  /// Sends a request of this id with its keys, and returns what Association::get() does. Without a sink no
  /// instances come over this association (C-MOVE).
  Result<std::string> retrieve(T_ASC_PresentationContextID context, T_DIMSE_Message& message, DIC_US id,
                               DcmDataset& keys, InstanceSink* sink);
  /// Fills a request that a data set follows.
  template <class Request>
  void fill(Request& request, const std::string& sopClass) {
    request.MessageID = association->nextMsgID++;
    std::strncpy(request.AffectedSOPClassUID, sopClass.c_str(), sizeof request.AffectedSOPClassUID - 1);
    request.DataSetType = DIMSE_DATASET_PRESENT;
    request.Priority = DIMSE_PRIORITY_MEDIUM;
  }
  /// Fills `contexts` with the presentation contexts that the archive accepted. DCMTK then sees Explicit VR
  /// Little Endian in place of transfer syntaxes that it does not know, as it would refuse commands in them.
  void noteContexts();

  const Archive archive;
  Watch watch;
  DcmTransportLayer plain;
  std::unique_ptr<DcmTLSTransportLayer> tls;
  std::unique_ptr<WatchedTransport> transport;
  T_ASC_Network* network = nullptr;
  T_ASC_Association* association = nullptr;
  std::map<std::pair<std::string, std::string>, T_ASC_PresentationContextID> contexts;  // by class and syntax
  bool associated = false, broken = false;
  const NetworkUse use;
};

/// Returns a status as PS3.7 writes it: "A701".
std::string statusText(unsigned status);

}  // namespace volumen
