#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/archive/archives.h"
#include "io/archive/instance_sink.h"
#include "io/dicom/instance_uids.h"
#include "viewer/volume/cancel.h"

class DcmDataset;

namespace volumen {

/// An instance as an archive lists it.
struct ListedInstance {
  std::string uid;
  std::string sopClass;  ///< empty if the archive does not tell
};

/// Instances of one series.
struct WantedInstances {
  std::string studyUid, seriesUid, modality;
  std::vector<ListedInstance> instances;
  bool isWhole = true;  ///< these are all of the series
};

/// A file to be sent.
struct SentInstance {
  std::string path;
  dicom::InstanceUids uids;
};

/// How a search ended.
struct SearchEnd {
  std::string early;     ///< why the archive ended it early, a sentence; empty if it did not
  bool isLimit = false;  ///< it may only have reached its own limit of answers
};

using OnSent = std::function<void(std::size_t instance, const std::string& refusal)>;

/// The protocol that an archive speaks. It connects when it needs to. Errors are sentences that name the
/// archive and what to do; "cancelled" after a cancellation. Used by one thread at a time.
class ArchiveProtocol {
 public:
  virtual ~ArchiveProtocol() = default;

  /// Verifies that the archive answers.
  virtual Status test() = 0;

  /// Asks for all data sets that match `keys` at their Query/Retrieve Level (keysAt()). `onAnswer` returns
  /// whether it wants more.
  virtual Result<SearchEnd> find(DcmDataset& keys, const std::function<bool(DcmDataset&)>& onAnswer) = 0;

  /// Sends instances. `onSent` gets the number of each, and why the archive does not keep it: a sentence,
  /// empty if it does. It may be called from several threads, one at a time. The Error: why the rest was not
  /// sent.
  virtual Status send(const std::vector<SentInstance>& instances, const OnSent& onSent) = 0;

  /// Retrieves instances with the bytes that the archive holds. The sink has them afterwards, or not. The
  /// Error: why some did not come, if that is known.
  virtual Status retrieve(const WantedInstances& wanted, InstanceSink& sink) = 0;
};

/// Returns a refusal as an Error, too.
Status ended(const Result<std::string>& refusal);

/// Returns the protocol of an archive.
std::unique_ptr<ArchiveProtocol> protocolOf(const Archive& archive, const CancelToken& cancel);

std::unique_ptr<ArchiveProtocol> makeDimseProtocol(const Archive& archive, const CancelToken& cancel);
std::unique_ptr<ArchiveProtocol> makeWebProtocol(const Archive& archive, const CancelToken& cancel);

}  // namespace volumen
