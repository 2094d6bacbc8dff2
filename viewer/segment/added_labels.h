#pragma once

#include <array>
#include <bitset>
#include <cstdint>

#include "viewer/segment/label_map.h"

namespace volumen {

/// Returns the labels of `other` that share a voxel with any label of `map`. Both have the same grid.
std::bitset<256> labelsOverlapping(const LabelMap& map, const LabelMap& other);

/// Returns `map` with the labels of `other` (same grid) added where `map` is background. Label n becomes
/// `numbers[n]`; 0 leaves it out.
LabelMap withLabelsAdded(const LabelMap& map, const LabelMap& other,
                         const std::array<std::uint8_t, 256>& numbers);

}  // namespace volumen
