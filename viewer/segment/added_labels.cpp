#include "viewer/segment/added_labels.h"

#include <vector>

namespace volumen {

std::bitset<256> labelsOverlapping(const LabelMap& map, const LabelMap& other) {
  std::bitset<256> overlapping;
  const glm::ivec3 size = map.geometry().size;
  std::vector<std::uint8_t> row(std::size_t(size.x)), otherRow(row);
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j) {
      map.readRow(j, k, row.data());
      other.readRow(j, k, otherRow.data());
      for (std::size_t i = 0; i < row.size(); ++i)
        if (row[i] != 0 && otherRow[i] != 0) overlapping.set(otherRow[i]);
    }
  return overlapping;
}

LabelMap withLabelsAdded(const LabelMap& map, const LabelMap& other,
                         const std::array<std::uint8_t, 256>& numbers) {
  LabelEdit edit(map);
  const glm::ivec3 size = map.geometry().size;
  std::vector<std::uint8_t> row(std::size_t(size.x));
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j) {
      other.readRow(j, k, row.data());
      for (int i = 0; i < size.x; ++i)
        if (const std::uint8_t number = numbers[row[std::size_t(i)]]; number != 0 && edit.at({i, j, k}) == 0)
          edit.set({i, j, k}, number);
    }
  return edit.done();
}

}  // namespace volumen
