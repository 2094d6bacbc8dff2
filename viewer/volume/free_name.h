#pragma once

#include <functional>
#include <string>

namespace volumen {

/// Returns whether a name is empty or consists only of spaces and control characters.
bool isBlank(const std::string& name);

/// Returns `wanted`, or a numbered name if it is taken: "Bone (2)", after that "Bone (3)".
std::string freeName(const std::string& wanted, const std::function<bool(const std::string&)>& isTaken);

}  // namespace volumen
