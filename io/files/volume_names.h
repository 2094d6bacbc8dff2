#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace volumen {

/// Attributes that distinguish one volume of a file from the others.
struct VolumeName {
  std::string timePoint, bValue, label;  ///< same as in Series
};

/// An axis of a file that counts volumes.
struct OuterAxis {
  enum class Kind { time, component, direction, other } kind = Kind::other;
  std::uint64_t size = 1;
};

/// Returns the names of all volumes of a file, the first axis changing fastest: "time point 3", "component
/// x".
std::vector<VolumeName> volumeNames(const std::vector<OuterAxis>& axes);

}  // namespace volumen
