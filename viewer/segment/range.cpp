#include "viewer/segment/range.h"

#include "viewer/volume/buffer.h"
#include "viewer/volume/parallel.h"

namespace volumen {

DenseLabels labelRange(const Volume& volume, ValueRange range) {
  const std::optional<ValueRange>& padding = volume.attributes().padding;
  DenseLabels map{volume.geometry(), zeros<std::uint8_t>(std::size_t(volume.geometry().voxelCount()))};
  std::visit(
      [&](const auto& stored) {
        parallelFor(std::int64_t(stored.size()), 0, [&](std::int64_t begin, std::int64_t end) {
          for (auto n = std::size_t(begin); n < std::size_t(end); ++n) {
            const double value = double(volume.realValue(double(stored[n])));
            const bool isPadding = padding && padding->low <= value && value <= padding->high;
            map.labels[n] = range.low <= value && value <= range.high && !isPadding;
          }
        });
      },
      volume.stored());
  return map;
}

}  // namespace volumen
