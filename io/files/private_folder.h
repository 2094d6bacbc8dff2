#pragma once

#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// Makes `folder`, for its owner alone, where it is not there; those above it, too. The Error says where it
/// cannot be made or written.
Status makePrivateFolder(const std::string& folder);

}  // namespace volumen
