#pragma once

#include <span>
#include <vector>

namespace volumen {
struct Series;
}

namespace volumen::dicom {

struct FileHeader;

/// Sets Series::suv of the PET volumes made from `files`. The scan begins with the earliest picture of a
/// series, whichever volumes it was split into.
void addSuvFactors(std::span<const FileHeader> files, std::vector<Series>& volumes);

}  // namespace volumen::dicom
