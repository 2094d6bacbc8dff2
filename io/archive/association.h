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

/// A service to be negotiated: a class and the transfer syntaxes in which its data may come, by preference.
struct WantedService {
  std::string sopClass;
  std::vector<std::string> syntaxes;
  bool isReceived = false;  ///< the archive sends instances of this class (C-GET)
};

/// Returns a service without or with small data, in the plain transfer syntaxes.
WantedService plainService(const std::string& sopClass);

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

  /// Asks for all data sets that match `keys` (C-FIND). `onAnswer` returns whether it wants more. Returns a
  /// sentence on why the archive ended the search early; empty if the answers are complete or not wanted.
  Result<std::string> find(const std::string& model, DcmDataset& keys,
                           const std::function<bool(DcmDataset&)>& onAnswer);

  /// Sends a file (C-STORE), decompressed if the archive takes no other. Returns a sentence on why the
  /// archive does not keep it; empty if it does.
  Result<std::string> store(const dicom::InstanceUids& uids, const std::string& path);

  /// Retrieves all instances that match `keys` over this association (C-GET), each into a file with the bytes
  /// that the archive sends. Returns a sentence on why the archive sent nothing or not all; empty if it sent
  /// all. The Error: the sink's, or the connection's.
  Result<std::string> get(const std::string& model, DcmDataset& keys, InstanceSink& sink);

  /// Has the archive send all instances that match `keys` to the AE title `destination`, over associations
  /// that it makes (C-MOVE). Returns as get() does; "sent all" is what the archive says.
  Result<std::string> move(const std::string& model, DcmDataset& keys, const std::string& destination);

 private:
  struct Private;
  explicit Association(std::unique_ptr<Private> p);
  std::unique_ptr<Private> p_;
};

}  // namespace volumen
