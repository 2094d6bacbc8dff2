#include "viewer/segment/added_labels.h"

#include <vector>

namespace volumen {

AddedLabels withLabelsAdded(const LabelMap& map, const LabelMap& other,
                            const std::array<std::uint8_t, 256>& numbers) {
  AddedLabels added{map};
  LabelEdit edit(map);
  const glm::ivec3 size = map.geometry().size;
  std::vector<std::uint8_t> row(std::size_t(size.x));
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j) {
      other.readRow(j, k, row.data());
      for (int i = 0; i < size.x; ++i) {
        const std::uint8_t label = row[std::size_t(i)];
        if (numbers[label] == 0) continue;
        ++added.wanted[label];
        if (edit.at({i, j, k}) != 0)
          ++added.lost[label];
        else
          edit.set({i, j, k}, numbers[label]);
      }
    }
  added.labels = edit.done();
  return added;
}

}  // namespace volumen
