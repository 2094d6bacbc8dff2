#pragma once

#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// Whether a path is a session of the window: a file called "X.volumen".
bool isSessionFile(const std::string& path);

/// The text (JSON) of a session. It is not looked into. The Error names the file.
Result<std::string> sessionText(const std::string& path);

}  // namespace volumen
