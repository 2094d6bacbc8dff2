#pragma once

namespace volumen {

/// What DCMTK's network needs. As long as one exists, a connection that the peer has closed does not end the
/// program (SIGPIPE). DCMTK itself writes no messages: each failure becomes a sentence of ours.
class NetworkUse {
 public:
  NetworkUse();
  ~NetworkUse();
  NetworkUse(const NetworkUse&) = delete;
  NetworkUse& operator=(const NetworkUse&) = delete;
};

}  // namespace volumen
