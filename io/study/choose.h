#pragma once

#include <cstddef>
#include <string>

#include "viewer/volume/result.h"

namespace volumen {

struct Study;

/// Returns the index of the series that `--series` names: an id, a UID or its number (from 1) in the study's
/// order. An empty `text` means the series with most voxels. Returns an Error if no series matches.
Result<std::size_t> chooseSeries(const Study& study, const std::string& text);

}  // namespace volumen
