#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace volumen {

/// What tells one volume of a file from the others.
struct VolumeName {
  std::string timePoint, bValue, label;  ///< as Series has them
};

/// An axis of a file that counts volumes.
struct OuterAxis {
  enum class Kind { time, component, direction, other } kind = Kind::other;
  std::uint64_t size = 1;
};

/// The names of all volumes of a file, the first axis changing fastest: "time point 3", "component x".
std::vector<VolumeName> volumeNames(const std::vector<OuterAxis>& axes);

}  // namespace volumen
