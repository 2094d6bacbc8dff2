#pragma once

#include <string>

namespace volumen {

/// Returns a file name for a UID, which may be any text if another program made it: 32 hexadecimal digits.
std::string nameForUid(const std::string& uid);

}  // namespace volumen
