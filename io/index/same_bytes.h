#pragma once

#include <optional>
#include <string>

namespace volumen {

/// Whether two files hold the same bytes; none where one of them cannot be read.
std::optional<bool> haveSameBytes(const std::string& a, const std::string& b);

}  // namespace volumen
