#include "io/archive/pdu_reader.h"

#include <QtEndian>
#include <algorithm>
#include <cstring>

#include "io/archive/association_pdu.h"

namespace volumen {

namespace {

constexpr std::uint8_t requestType = 1, acceptanceType = 2, dataType = 4;
// These bytes hold the type, a reserved byte and the length of a PDU and, if it is data, the length of its
// first value. No PDU is shorter.
constexpr std::size_t pduHead = 6, valueHead = 4, lengthPlace = 2;

}  // namespace

ssize_t PduReader::read(void* to, size_t count) {
  if (isBroken_) return -1;
  if (!hasBytes() && passing_ == 0 && !(left_ > 0 ? takeValue() : takeHead())) {
    isBroken_ = true;
    return result_ > 0 ? -1 : result_;
  }
  if (hasBytes()) {
    const std::size_t some = std::min(count, ready_.size() - given_);
    std::memcpy(to, ready_.data() + given_, some);
    given_ += some;
    return ssize_t(some);
  }
  const ssize_t some = receive_(to, std::min(count, passing_));
  if (some > 0) passing_ -= std::size_t(some);
  return some;
}

// Receives the first bytes of a PDU, or the whole PDU if it negotiates an association. Returns false if DCMTK
// must not read it.
bool PduReader::takeHead() {
  ready_.clear();
  given_ = 0;
  if (!take(pduHead + valueHead)) return false;
  const std::size_t length = qFromBigEndian<std::uint32_t>(ready_.data() + lengthPlace);
  if (length < valueHead) return false;
  const std::size_t rest = length - valueHead;
  if (ready_[0] == requestType || ready_[0] == acceptanceType)
    return take(rest) && isWellFormedAssociation(ready_);
  passing_ = rest;
  if (ready_[0] != dataType) return true;
  left_ = length;
  return takeValue();
}

// Makes a PDU of the next value in a PDU of data.
bool PduReader::takeValue() {
  constexpr std::size_t least = 2;  // a context and a control header
  if (!hasBytes()) {
    ready_ = {dataType, 0, 0, 0, 0, 0};
    given_ = 0;
    if (left_ < valueHead || !take(valueHead)) return false;
  }
  passing_ = qFromBigEndian<std::uint32_t>(ready_.data() + pduHead);
  if (passing_ < least || passing_ > left_ - valueHead) return false;
  left_ -= valueHead + passing_;
  qToBigEndian(std::uint32_t(valueHead + passing_), ready_.data() + lengthPlace);
  return true;
}

// Receives `count` bytes and appends them to those that are ready. Returns false if fewer come.
bool PduReader::take(std::size_t count) {
  constexpr std::size_t most = 1 << 16;  // the peer may claim any length
  for (const std::size_t end = ready_.size() + count; ready_.size() < end;) {
    const std::size_t at = ready_.size();
    ready_.resize(std::min(end, at + most));
    result_ = receive_(ready_.data() + at, ready_.size() - at);
    ready_.resize(at + std::size_t(std::max<ssize_t>(result_, 0)));
    if (result_ <= 0) return false;
  }
  return true;
}

}  // namespace volumen
