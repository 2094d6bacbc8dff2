#pragma once

#include <cstdint>
#include <span>

namespace volumen {

/// Returns whether the PDU of a request for an association, or of its acceptance (PS3.8 9.3.2, 9.3.3), can be
/// given to DCMTK: its items lie within each other, and none is missing, empty or there twice that must not
/// be. DCMTK keeps the memory of one that it refuses halfway.
bool isWellFormedAssociation(std::span<const std::uint8_t> bytes);

}  // namespace volumen
