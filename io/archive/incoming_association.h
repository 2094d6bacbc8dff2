#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "io/archive/receive_archive.h"
#include "io/archive/received_files.h"

class DcmTLSTransportLayer;

namespace volumen {

/// What the connections of one listener share.
struct Reception {
  const Listening& listening;
  const CancelToken cancel;
  const std::function<void(const Received&)> onStored;  ///< may be called by several threads at once
  ReceivedFiles files;
  DcmTLSTransportLayer* tls = nullptr;  ///< if peers must encrypt
  std::atomic<int> associations{0};     ///< open ones
};

/// Serves one connection to its end: receives the request for an association, accepts or rejects it, and
/// answers C-STORE and C-ECHO. Takes over `socket`, which is connected to `address`. Requires SIGPIPE to be
/// ignored. Several threads may call it at once. Returns what came; nothing if the peer neither asked for an
/// association nor failed to agree on TLS.
std::optional<ReceivedAssociation> serveConnection(Reception& reception, int socket,
                                                   const std::string& address);

}  // namespace volumen
