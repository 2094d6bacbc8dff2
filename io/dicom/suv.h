#pragma once

#include <span>
#include <vector>

namespace volumen {
struct Series;
}

namespace volumen::dicom {

struct FileHeader;

/// Fills in Series::suv of the PET volumes that were made of these files. The scan begins with the earliest
/// picture of all that is here of a series, whatever volumes it was split into.
void addSuvFactors(std::span<const FileHeader> files, std::vector<Series>& volumes);

}  // namespace volumen::dicom
