#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "viewer/volume/volume.h"

namespace volumen {

/// Returns the UID of a UUID: 2.25 and its 128 bits as one decimal number (PS3.5 B.2).
std::string uidOfUuid(std::array<std::uint8_t, 16> uuid);

/// Returns a UID that no other call returns, of a random UUID.
std::string randomUid();

/// UIDs of objects made from a volume or from other bytes: 2.25 and a name-based UUID (PS3.5 B.2, RFC 4122
/// version 5). The same contents and `salt` give the same UIDs on every machine.
class DicomUids {
 public:
  DicomUids(const Volume& volume, const std::string& salt);
  DicomUids(std::span<const std::uint8_t> contents, const std::string& salt);
  /// Returns the UID of `what` ("study", or the number of a slice).
  std::string of(const std::string& what) const;

 private:
  std::array<std::uint8_t, 16> contents_;
};

}  // namespace volumen
