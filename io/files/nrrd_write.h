#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/files/sample_type.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Key/value pairs of a NRRD header.
using NrrdKeyValues = std::vector<std::pair<std::string, std::string>>;

/// Returns the header of a NRRD file with gzip samples. Several interleaved volumes of the grid get a first
/// axis of kind "list". It gives a space only for calibrated geometry. Keys must not hold ":=" or line ends.
std::string nrrdHeader(const VoxelGeometry& geometry, SampleType type, const NrrdKeyValues& keyValues,
                       std::size_t volumes = 1);

}  // namespace volumen
