#pragma once

#include <string>

#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Runs a command of the user's in a shell and returns what it prints, without the line end: a password, a
/// token. It may take 30 s. The Error is the end of a sentence; it never holds what was printed.
Result<std::string> outputOf(const std::string& command, const CancelToken& cancel);

}  // namespace volumen
