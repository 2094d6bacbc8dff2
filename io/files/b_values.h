#pragma once

#include <string>
#include <vector>

#include "io/study/warning.h"

namespace volumen {

/// Returns the b-values beside a NIfTI file, in s/mm^2, one a volume. They are in NAME.bval beside NAME.nii
/// or NAME.nii.gz, as dcm2niix and FSL write them. Returns an empty list if there is no such file. A file
/// without exactly `count` valid numbers is ignored with a warning.
std::vector<double> bValuesBeside(const std::string& path, std::size_t count, std::vector<Warning>& warnings);

}  // namespace volumen
