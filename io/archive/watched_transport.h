#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmnet/dcmlayer.h>
#include <dcmtk/dcmnet/dcmtrans.h>

#include <chrono>
#include <cstdint>
#include <limits>
#include <string>

#include "viewer/volume/cancel.h"

namespace volumen {

/// What ends waiting for a peer. Reading and writing fail when `cancel` is set, when the peer has been silent
/// for `silence`, or when it has sent more than was allowed. A watch must outlive its connections.
struct Watch {
  using Clock = std::chrono::steady_clock;

  CancelToken cancel;
  std::chrono::seconds silence{30};
  std::string pin;  ///< SHA-256 of the peer's certificate, hexadecimal; empty: any that TLS accepts

  /// Allows the peer so many more bytes, and so much time for them.
  void allow(std::uint64_t bytes, std::chrono::seconds time) {
    bytesLeft = bytes;
    end = Clock::now() + time;
  }
  std::uint64_t bytesLeft = std::numeric_limits<std::uint64_t>::max();
  Clock::time_point end = Clock::time_point::max();

  // Why a connection was ended here.
  bool wasCancelled = false, wasSilent = false, sentTooMuch = false;
  std::string otherCertificate;  ///< SHA-256 of one that differs from the pin
};

/// Makes connections of `inner` that obey a watch, that check what DCMTK reads (PduReader), and that
/// send each message at once (no Nagle algorithm: with it every instance takes 45 ms).
class WatchedTransport : public DcmTransportLayer {
 public:
  /// `inner` and `watch` must outlive the object.
  WatchedTransport(DcmTransportLayer& inner, Watch& watch) : inner_(inner), watch_(watch) {}
  DcmTransportConnection* createConnection(DcmNativeSocketType socket, OFBool secure) override;

 private:
  DcmTransportLayer& inner_;
  Watch& watch_;
};

}  // namespace volumen
