#pragma once

#include <string>

namespace volumen {

/// A concept of a coding scheme (PS3.3 8.8), for example "272673000", "SCT", "Bone". An empty value means no
/// code. UTF-8.
struct Code {
  std::string value{}, scheme{}, meaning{};
  bool operator==(const Code&) const = default;
};

}  // namespace volumen
