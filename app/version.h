#pragma once

#include <string>

namespace volumen {

/// The revision (12 hex digits) that the program is built from, "-dirty" behind it if files were changed;
/// "unknown" if it was built without git.
extern const char* const revision;

/// Returns what --version prints: version, revision and the instructions that kernels use on this CPU.
std::string versionText();

}  // namespace volumen
