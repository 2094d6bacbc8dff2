#pragma once

#include <array>
#include <bitset>
#include <cstdint>

#include "viewer/segment/label_map.h"

namespace volumen {

/// The labels of `other`, which is of the grid of `map`, that have a voxel where that has a label, too.
std::bitset<256> labelsOverlapping(const LabelMap& map, const LabelMap& other);

/// `map` with the labels of `other`, which is of its grid, where it has none: label n becomes `numbers[n]`; 0
/// leaves it out.
LabelMap withLabelsAdded(const LabelMap& map, const LabelMap& other,
                         const std::array<std::uint8_t, 256>& numbers);

}  // namespace volumen
