#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/archive/archives.h"
#include "viewer/volume/cancel.h"

class DcmDataset;

namespace volumen {

/// A service to be negotiated: a class and the transfer syntaxes in which its data may come, by preference.
struct WantedService {
  std::string sopClass;
  std::vector<std::string> syntaxes;
  bool isReceived = false;  ///< the archive sends instances of this class (C-GET)
};

/// Returns a service without or with small data, in the plain transfer syntaxes.
WantedService plainService(const std::string& sopClass);

/// What a search ended with.
struct FindEnd {
  bool stopped = false;  ///< `onAnswer` wanted no more
  std::string refusal;   ///< why the archive ended it early, the end of a sentence; empty: it is complete
};

/// What a retrieval ended with.
struct GetEnd {
  int failed = 0;       ///< number of instances that the archive could not send, as far as it tells
  std::string refusal;  ///< why it sent nothing or not all, the end of a sentence; empty: it sent all
};

/// Where the instances of a retrieval go.
class InstanceSink {
 public:
  virtual ~InstanceSink() = default;
  /// Returns the path of a file to be written for an instance.
  virtual Result<std::string> begin(const std::string& sopInstanceUid) = 0;
  /// The file is complete.
  virtual Status end(const std::string& sopInstanceUid, const std::string& path) = 0;
  /// The file is not complete, and is of no use.
  virtual void drop(const std::string& path) = 0;
};

/// An association with an archive by DIMSE (PS3.7, PS3.8). Waits 5 s for the connection, 10 s for the
/// association, 30 s for each answer. Errors are sentences that name the archive and what to do. Used by one
/// thread at a time.
class Association {
 public:
  /// The Error says why there is none: unknown host, refused, rejected, silent, no DICOM, TLS, cancelled.
  static Result<Association> open(const Archive& archive, const std::vector<WantedService>& services,
                                  const CancelToken& cancel);
  Association(Association&&) noexcept;
  /// Releases the association, or aborts it after an error.
  ~Association();

  /// Returns whether the archive offers a service.
  bool offers(const std::string& sopClass) const;

  /// Verifies that the archive answers (C-ECHO).
  Status echo();

  /// Asks for all data sets that match `keys` (C-FIND). `onAnswer` returns whether it wants more.
  Result<FindEnd> find(const std::string& model, DcmDataset& keys,
                       const std::function<bool(DcmDataset&)>& onAnswer);

  /// Retrieves all instances that match `keys` over this association (C-GET), each into a file with the bytes
  /// that the archive sends. The Error: the sink's, or the connection's.
  Result<GetEnd> get(const std::string& model, DcmDataset& keys, InstanceSink& sink);

 private:
  struct Private;
  explicit Association(std::unique_ptr<Private> p);
  std::unique_ptr<Private> p_;
};

}  // namespace volumen
