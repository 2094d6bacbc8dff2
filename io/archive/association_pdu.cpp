#include "io/archive/association_pdu.h"

#include <bitset>
#include <functional>
#include <utility>

namespace volumen {

namespace {

using PduBytes = std::span<const std::uint8_t>;

// Types of PDUs, of items and of their parts (PS3.8 9.3, PS3.7 D.3.3).
namespace pdu {
constexpr std::uint8_t acceptance = 0x02, applicationContext = 0x10, proposedContext = 0x20,
                       acceptedContext = 0x21, abstractSyntax = 0x30, transferSyntax = 0x40,
                       userInformation = 0x50, maximumLength = 0x51, classUid = 0x52, role = 0x54,
                       versionName = 0x55, extendedNegotiation = 0x56, identity = 0x58, identityAnswer = 0x59;
}
constexpr std::size_t mostOfUid = 64;

std::size_t twoBytes(PduBytes bytes, std::size_t at) { return std::size_t(bytes[at]) << 8 | bytes[at + 1]; }

// Calls `isGood(type, value)` for each item of a list. Returns whether all items are good and fill the list
// exactly.
bool allItems(PduBytes list, const std::function<bool(std::uint8_t, PduBytes)>& isGood) {
  constexpr std::size_t head = 4;
  while (!list.empty()) {
    if (list.size() < head || list.size() - head < twoBytes(list, 2)) return false;
    const std::size_t length = twoBytes(list, 2);
    if (!isGood(list[0], list.subspan(head, length))) return false;
    list = list.subspan(head + length);
  }
  return true;
}

// Returns whether a value holds at `at` a length of two bytes, then that many bytes, then `more` bytes.
bool holdsText(PduBytes value, std::size_t at, std::size_t more) {
  return value.size() >= at + 2 && value.size() - at - 2 >= twoBytes(value, at) + more;
}

// Returns whether an AE title is empty. It is padded with spaces, or ends at a zero.
bool isBlank(PduBytes title) {
  for (const std::uint8_t c : title)
    if (c != ' ') return c == 0;
  return true;
}

// Returns whether the identity of a user (PS3.7 D.3.3.7), or the answer to it, has its fields and no more.
// DCMTK reads the second field of user identities only if they are names; it takes other second fields for
// further items.
bool isIdentity(PduBytes value, bool isAnswer) {
  constexpr std::size_t primary = 2, userName = 2;
  if (isAnswer) return holdsText(value, 0, 0) && value.size() == 2 + twoBytes(value, 0);
  if (!holdsText(value, primary, 2)) return false;
  const std::size_t secondary = primary + 2 + twoBytes(value, primary);
  return holdsText(value, secondary, 0) && value.size() == secondary + 2 + twoBytes(value, secondary) &&
         (value[0] == userName || twoBytes(value, secondary) == 0);
}

class AssociationPdu {
 public:
  explicit AssociationPdu(bool isAcceptance) : isAcceptance_(isAcceptance) {}

  bool isWellFormed(PduBytes items) {
    const bool fit = allItems(items, [this](std::uint8_t type, PduBytes value) {
      if (type == pdu::applicationContext) return isName(value);
      if (type == pdu::proposedContext || type == pdu::acceptedContext) return isContext(type, value);
      if (type != pdu::userInformation) return true;
      return !std::exchange(hasUserInformation_, true) &&
             allItems(value, [this](std::uint8_t part, PduBytes of) { return isUserPart(part, of); });
    });
    return fit && (isAcceptance_ || hasName_);
  }

 private:
  bool isName(PduBytes value) {
    hasName_ = true;
    return !value.empty() && value.size() <= mostOfUid && value[0] != 0;
  }

  bool isContext(std::uint8_t type, PduBytes value) {
    constexpr std::size_t head = 4, result = 2;
    if (value.size() < head || (type == pdu::acceptedContext) != isAcceptance_ || known_[value[0]])
      return false;
    known_.set(value[0]);
    if (isAcceptance_ && value[result] != 0) return true;
    std::size_t syntaxes = 0;
    const bool fits = allItems(value.subspan(head), [&](std::uint8_t part, PduBytes of) {
      syntaxes += part == pdu::transferSyntax;
      return (part != pdu::abstractSyntax && part != pdu::transferSyntax) || of.size() <= mostOfUid;
    });
    return fits && (isAcceptance_ ? syntaxes == 1 : syntaxes > 0);
  }

  bool isUserPart(std::uint8_t part, PduBytes value) {
    switch (part) {
      case pdu::maximumLength:
        return value.size() == 4;
      case pdu::classUid:
      case pdu::versionName:
        return value.size() <= mostOfUid;
      case pdu::role:
        return holdsText(value, 0, 2) && twoBytes(value, 0) <= mostOfUid;
      case pdu::extendedNegotiation:
        return holdsText(value, 0, 0);
      case pdu::identity:
      case pdu::identityAnswer:
        return !std::exchange(hasIdentity_, true) && isIdentity(value, isAcceptance_);
      default:
        return true;
    }
  }

  const bool isAcceptance_;
  bool hasName_ = false, hasUserInformation_ = false, hasIdentity_ = false;
  std::bitset<256> known_;  // identifiers of contexts
};

}  // namespace

bool isWellFormedAssociation(PduBytes bytes) {
  constexpr std::size_t head = 6 + 68;  // of any PDU, and version, titles and reserved bytes
  constexpr std::size_t version = 7;    // one bit a version; the first is the only one
  constexpr std::size_t calledTitle = 10, callingTitle = 26, titleLength = 16;
  if (bytes.size() < head || (bytes[version] & 1) == 0) return false;
  if (isBlank(bytes.subspan(calledTitle, titleLength)) || isBlank(bytes.subspan(callingTitle, titleLength)))
    return false;
  return AssociationPdu(bytes[0] == pdu::acceptance).isWellFormed(bytes.subspan(head));
}

}  // namespace volumen
