#pragma once

#include <optional>
#include <string>

namespace volumen {

/// True if two files hold the same bytes; empty if one of them cannot be read.
std::optional<bool> haveSameBytes(const std::string& a, const std::string& b);

}  // namespace volumen
