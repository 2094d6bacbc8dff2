#pragma once

#include <string>

namespace volumen {

/// A concept of a coding scheme (PS3.3 8.8): "272673000", "SCT", "Bone". Empty: none. UTF-8.
struct Code {
  std::string value{}, scheme{}, meaning{};
  bool operator==(const Code&) const = default;
};

}  // namespace volumen
