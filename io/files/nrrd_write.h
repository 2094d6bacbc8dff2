#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/files/sample_type.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Key/value pairs of a NRRD header.
using NrrdKeyValues = std::vector<std::pair<std::string, std::string>>;

/// All before the samples of a NRRD file, which are gzip. Of several volumes of the grid, that alternate
/// sample by sample, an axis of kind "list" comes first. Space only where the geometry is calibrated. Keys
/// hold no ":=" and no line end.
std::string nrrdHeader(const VoxelGeometry& geometry, SampleType type, const NrrdKeyValues& keyValues,
                       std::size_t volumes = 1);

}  // namespace volumen
