#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace volumen {

/// Reads the PDUs of a peer (PS3.8 9.3) in a form that DCMTK can be given. Requests for associations and
/// their acceptances come whole, and only if they are well-formed. Data come with one value (PDV) in each
/// PDU: in one with three or more, DCMTK reads the third from a wrong place, behind its buffer too.
class PduReader {
 public:
  /// As recv(): returns a number of bytes, 0 at the end, -1 after an error.
  using Receive = std::function<ssize_t(void* to, size_t count)>;
  explicit PduReader(Receive receive) : receive_(std::move(receive)) {}

  /// Returns as `Receive` does; -1 if a PDU is malformed.
  ssize_t read(void* to, size_t count);
  /// Returns whether read() can return bytes that were received before.
  bool hasBytes() const { return !isBroken_ && given_ < ready_.size(); }

 private:
  bool takeHead();
  bool takeValue();
  bool take(std::size_t count);

  const Receive receive_;
  std::vector<std::uint8_t> ready_;  // bytes that were received and checked
  std::size_t given_ = 0;            // of them, read
  std::size_t passing_ = 0;          // bytes that follow as they are
  std::size_t left_ = 0;             // bytes that follow behind them in a PDU of data
  ssize_t result_ = 0;               // the last one of receive_
  bool isBroken_ = false;
};

}  // namespace volumen
