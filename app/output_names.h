#pragma once

#include <span>
#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// Returns a name under which a file is known however it is spelled, whether it is there or not.
std::string placeOfFile(const std::string& path);

/// Returns "head-007.png" for "head.png" and 7.
std::string numberedName(const std::string& path, int n);

/// The Error: a file to be written is also another one, or one that is read, even by another spelling or a
/// link.
Status checkApart(std::span<const std::string> written, std::span<const std::string> read);

}  // namespace volumen
