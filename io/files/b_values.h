#pragma once

#include <string>
#include <vector>

#include "io/study/warning.h"

namespace volumen {

/// The diffusion weights that stand beside a NIfTI file (NAME.bval beside NAME.nii or NAME.nii.gz: numbers in
/// s/mm^2, one a volume, as dcm2niix and FSL write them); empty where there is no such file. One that holds
/// other than `count` such numbers is left out with a sentence in `warnings`.
std::vector<double> bValuesBeside(const std::string& path, std::size_t count, std::vector<Warning>& warnings);

}  // namespace volumen
