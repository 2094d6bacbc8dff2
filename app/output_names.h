#pragma once

#include <span>
#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// The Error: a file to be written is also another one, or one that is read, even by another spelling or a
/// link.
Status checkApart(std::span<const std::string> written, std::span<const std::string> read);

}  // namespace volumen
