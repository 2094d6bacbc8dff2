#include "viewer/slice/pyramid.h"

#include <algorithm>
#include <numeric>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr int step = 4;  // factor between the block edges of successive copies

constexpr std::int64_t fewest = 1 << 16;  // pixels of a copy

template <class T>
using Sum = std::conditional_t<std::is_same_v<T, float>, double, std::int64_t>;

// Adds a row of pixels to the sums of its blocks.
template <class T>
void addRow(const T* row, int columns, int edge, std::vector<Sum<T>>& sums) {
  for (std::size_t block = 0; block < sums.size(); ++block) {
    const int first = int(block) * edge, last = std::min(columns, first + edge);
    Sum<T> sum = 0;
    for (int x = first; x < last; ++x) sum += Sum<T>(row[x]);
    sums[block] += sum;
  }
}

glm::ivec2 blocksOf(glm::ivec2 size, int edge) { return (size + edge - 1) / edge; }

// Writes the means of the rows of blocks from `begin` up to, not including, `end`.
template <class T>
void takeMeans(const std::vector<T>& stored, glm::ivec2 size, int edge, std::int64_t begin, std::int64_t end,
               std::vector<float>& means) {
  const auto across = std::size_t(blocksOf(size, edge).x);
  std::vector<Sum<T>> sums(across);
  for (std::int64_t y = begin; y < end; ++y) {
    std::ranges::fill(sums, Sum<T>(0));
    const std::int64_t first = y * edge, last = std::min<std::int64_t>(size.y, first + edge);
    for (std::int64_t row = first; row < last; ++row)
      addRow(stored.data() + row * size.x, size.x, edge, sums);
    float* const out = means.data() + std::size_t(y) * across;
    for (std::size_t x = 0; x < across; ++x) {
      const int columns = std::min(edge, size.x - int(x) * edge);
      out[x] = float(double(sums[x]) / double(columns * (last - first)));
    }
  }
}

std::vector<float> roomForMeans(glm::ivec2 size, int edge) {
  const glm::ivec2 blocks = blocksOf(size, edge);
  return std::vector<float>(std::size_t(blocks.x) * std::size_t(blocks.y));
}

std::vector<float> meansOnAllCores(const VoxelValues& stored, glm::ivec2 size, int edge) {
  std::vector<float> means = roomForMeans(size, edge);
  parallelFor(blocksOf(size, edge).y, 0, [&](std::int64_t begin, std::int64_t end) {
    std::visit([&](const auto& values) { takeMeans(values, size, edge, begin, end, means); }, stored);
  });
  return means;
}

// Null where no copy can be made.
VolumePtr reduced(const Volume& whole, int edge) {
  VolumeParts parts;
  parts.geometry = whole.geometry();
  const glm::ivec2 size(whole.size());
  parts.geometry.size = {blocksOf(size, edge), 1};
  parts.geometry.origin = whole.geometry().patientFromVoxel({(edge - 1) / 2.0, (edge - 1) / 2.0, 0});
  parts.geometry.patientFromVoxelStep *= edge;  // the thickness too: the smallest step sets the sub-samples
  parts.values = meansOnAllCores(whole.stored(), size, edge);
  parts.slope = whole.slope();
  parts.intercept = whole.intercept();
  std::vector<std::string> warnings;  // unused: the whole volume has reported its own
  const Result<VolumePtr> made = Volume::make(std::move(parts), warnings);
  return made ? *made : nullptr;
}

}  // namespace

std::vector<float> blockMeans(const VoxelValues& stored, glm::ivec2 size, int edge) {
  std::vector<float> means = roomForMeans(size, edge);
  std::visit([&](const auto& values) { takeMeans(values, size, edge, 0, blocksOf(size, edge).y, means); },
             stored);
  return means;
}

std::optional<SmallPicture> smallPicture(const VoxelValues& stored, glm::ivec2 size, int edge) {
  constexpr int pixelsForEach = 4;
  const int block = std::max(size.x, size.y) / (pixelsForEach * edge);
  if (block < 2) return {};
  return SmallPicture{blocksOf(size, block), block, blockMeans(stored, size, block)};
}

Pyramid::Pyramid(VolumePtr whole) : whole_(std::move(whole)) {
  const std::int64_t pixels = whole_->geometry().voxelCount();
  if (pixels < leastPixels) return;
  for (int edge = step; pixels / edge / edge >= fewest; edge *= step)
    if (VolumePtr copy = reduced(*whole_, edge)) copies_.push_back(std::move(copy));
}

const VolumePtr& Pyramid::seenOn(const SlicePlane& plane) const {
  constexpr double across = 2;  // pixels of a copy that one of the plane is at least as large as
  const auto isFine = [&](const VolumePtr& copy) {
    const glm::dvec3 mm = copy->geometry().spacing();
    return plane.average && across * std::max(mm.x, mm.y) <= plane.mmPerPixel;
  };
  const auto fine = std::find_if(copies_.rbegin(), copies_.rend(), isFine);
  return fine == copies_.rend() ? whole_ : *fine;
}

std::size_t Pyramid::bytes() const {
  return std::accumulate(copies_.begin(), copies_.end(), std::size_t(0),
                         [](std::size_t sum, const VolumePtr& copy) { return sum + copy->bytes(); });
}

}  // namespace volumen
