#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "io/dicom/data_set.h"

namespace volumen::dicom {

/// Returns a colour in PCS-values (CIELab D50 in 16-bit words, PS3.3 C.10.7.1.1) as sRGB, or nothing if
/// absent or incomplete. Colours outside sRGB are clipped.
std::optional<glm::u8vec3> readCieLab(const DataSet& data, std::uint32_t tag, DataSet::Scope scope);

/// Returns the PCS-values of an sRGB colour. readCieLab() gives the same colour back.
std::array<std::uint16_t, 3> cieLabOf(glm::u8vec3 colour);

}  // namespace volumen::dicom
