#pragma once

#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// True if a path is a session of the window: a file named "X.volumen".
bool isSessionFile(const std::string& path);

/// Returns the text (JSON) of a session without parsing it. The Error names the file.
Result<std::string> sessionText(const std::string& path);

}  // namespace volumen
