#pragma once

#include <array>
#include <cstdint>

#include "viewer/segment/label_map.h"

namespace volumen {

/// A label map, and what became of the labels that were added to it, by their number there.
struct AddedLabels {
  LabelMap labels;
  std::array<std::int64_t, 256> wanted{};  ///< how many voxels they had
  std::array<std::int64_t, 256> lost{};    ///< how many of these had a label already, which stayed
};

/// `map` with the labels of `other`, which is of its grid, where it has none: label n becomes `numbers[n]`; 0
/// leaves it out.
AddedLabels withLabelsAdded(const LabelMap& map, const LabelMap& other,
                            const std::array<std::uint8_t, 256>& numbers);

}  // namespace volumen
