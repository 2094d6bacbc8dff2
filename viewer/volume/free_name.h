#pragma once

#include <functional>
#include <string>

namespace volumen {

/// Whether a name says nothing: it is empty, or of spaces and control characters alone.
bool isBlank(const std::string& name);

/// `wanted`, or with a number behind it where that is taken: "Bone (2)", and of that "Bone (3)".
std::string freeName(const std::string& wanted, const std::function<bool(const std::string&)>& isTaken);

}  // namespace volumen
