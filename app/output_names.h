#pragma once

#include <span>
#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// An Error where one of the files that are to be written is another one of them, or one that is read: by
/// another spelling of its name, or a link to it, too.
Status checkApart(std::span<const std::string> written, std::span<const std::string> read);

}  // namespace volumen
