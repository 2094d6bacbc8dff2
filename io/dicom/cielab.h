#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "io/dicom/data_set.h"

namespace volumen::dicom {

/// A colour in PCS-values (CIELab D50 in words of 16 bits, PS3.3 C.10.7.1.1) as sRGB; nothing where it is
/// absent or incomplete. Colours that sRGB does not hold are cut off.
std::optional<glm::u8vec3> readCieLab(const DataSet& data, std::uint32_t tag, DataSet::Scope scope);

/// The words that stand for a colour in sRGB; read, they are that colour again.
std::array<std::uint16_t, 3> cieLabOf(glm::u8vec3 colour);

}  // namespace volumen::dicom
