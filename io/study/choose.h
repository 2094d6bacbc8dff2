#pragma once

#include <cstddef>
#include <string>

#include "viewer/volume/result.h"

namespace volumen {

struct Study;

/// The series that `--series` means: an id, a UID or its number (from 1) in the study's order; empty: the one
/// with most voxels. An Error where nothing is meant by it.
Result<std::size_t> chooseSeries(const Study& study, const std::string& text);

}  // namespace volumen
