#include "io/export/segmentation_frames.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "io/study/series.h"

namespace volumen {

namespace {

// Adds a mask to another one of the same grid; returns true if they share a voxel.
bool take(BitMask& taken, const BitMask& mask) {
  bool overlaps = false;
  const auto words = taken.words();
  const auto more = mask.words();
  for (std::size_t n = 0; n < words.size(); ++n) {
    overlaps = overlaps || (words[n] & more[n]);
    words[n] |= more[n];
  }
  return overlaps;
}

}  // namespace

WrittenMask writtenMask(const Segmented& map, int number) {
  WrittenMask made{maskOf(map.labels, std::uint8_t(number))};
  if (const AcquiredLabels* acquired = map.acquired.get()) {
    made.onSlices = maskOf(acquired->labels, std::uint8_t(number));
    made.isInterpolated = acquired->interpolated.contains(number);
  }
  return made;
}

Status checkPlaces(const Series& series, const DicomSource& source) {
  for (std::size_t n = 0; n < source.slices.size(); ++n)
    if (!source.frame(int(n)).place)
      return Error{series.files[n] + " does not say where it lies; write .seg.nrrd."};
  return {};
}

SegmentationFrames::SegmentationFrames(const VoxelGeometry& grid, const DicomSource& source, glm::ivec2 size)
    : source_(source), size_(size), taken_(grid) {
  for (std::size_t n = 0; n < source.slices.size(); ++n) gridSlices_.push_back(gridSliceOf(int(n)));
}

glm::dvec3 SegmentationFrames::voxelAt(int slice, glm::dvec2 pixel) const {
  const DicomSourceFrame::Place& at = *source_.frame(slice).place;
  return taken_.geometry().voxelFromPatient(at.position + pixel.x * at.mm.x * at.right +
                                            pixel.y * at.mm.y * at.down);
}

// Checking the corners of a slice is enough, because positions are linear.
std::optional<int> SegmentationFrames::gridSliceOf(int slice) const {
  constexpr double off = 0.49;  // less than half a voxel
  if (glm::ivec2(taken_.size()) != size_) return {};
  const double k = std::floor(voxelAt(slice, glm::dvec2(size_ - 1) / 2.0).z + 0.5);
  if (!(k >= 0 && k < taken_.size().z)) return {};
  for (const int x : {0, size_.x - 1})
    for (const int y : {0, size_.y - 1}) {
      const glm::dvec3 from = glm::abs(voxelAt(slice, {x, y}) - glm::dvec3(x, y, k));
      if (!(std::max({from.x, from.y, from.z}) < off)) return {};
    }
  return int(k);
}

void SegmentationFrames::readRow(const BitMask& mask, int slice, int y,
                                 std::span<std::uint64_t> words) const {
  if (const auto k = gridSlices_[std::size_t(slice)]) {
    std::ranges::copy(mask.row(y, *k), words.begin());
    return;
  }
  std::ranges::fill(words, 0);
  const glm::dvec3 high = glm::dvec3(mask.size());
  for (int x = 0; x < size_.x; ++x) {
    const glm::dvec3 voxel = glm::floor(voxelAt(slice, {x, y}) + 0.5);
    const bool inside = voxel.x >= 0 && voxel.y >= 0 && voxel.z >= 0 && voxel.x < high.x &&
                        voxel.y < high.y && voxel.z < high.z;
    if (inside && mask.at(glm::ivec3(voxel))) words[std::size_t(x) / 64] |= std::uint64_t(1) << x % 64;
  }
}

bool SegmentationFrames::isOfSlices(const BitMask& mask) const {
  return mask.size() == glm::ivec3(size_, int(gridSlices_.size()));
}

void SegmentationFrames::add(const BitMask& mask, const BitMask* onSlices) {
  if (onSlices && !isOfSlices(*onSlices)) onSlices = nullptr;
  areOfSlices_ = areOfSlices_ && onSlices;
  overlap_ = take(taken_, mask) || overlap_;
  if (onSlices && !takenOnSlices_) takenOnSlices_.emplace(onSlices->geometry());
  if (onSlices) overlap_ = take(*takenOnSlices_, *onSlices) || overlap_;
  const std::size_t perRow = std::size_t(size_.x + 63) / 64;
  std::vector<std::uint64_t> words(perRow * std::size_t(size_.y));
  for (int slice = 0; slice < int(gridSlices_.size()); ++slice) {
    for (int y = 0; y < size_.y; ++y) {
      const auto row = std::span(words).subspan(std::size_t(y) * perRow, perRow);
      if (onSlices)
        std::ranges::copy(onSlices->row(y, slice), row.begin());
      else
        readRow(mask, slice, y, row);
    }
    if (std::ranges::none_of(words, [](std::uint64_t word) { return word != 0; })) continue;
    frames_.push_back({segments_, slice});
    for (std::size_t n = 0; n < words.size(); n += perRow)
      bits_.add(std::span(words).subspan(n, perRow), std::size_t(size_.x));
  }
  ++segments_;
}

std::vector<int> SegmentationFrames::slicesBetween() const {
  constexpr double off = 0.06;  // positions of regular slices still vary a little
  std::vector<int> between;
  for (int slice = 0; slice < int(gridSlices_.size()); ++slice) {
    const double k = voxelAt(slice, glm::dvec2(size_ - 1) / 2.0).z;
    if (std::abs(k - std::round(k)) > off || k < -off || k > taken_.size().z - 1 + off)
      between.push_back(slice);
  }
  return between;
}

bool SegmentationFrames::areOnGrid() const {
  return std::ranges::all_of(gridSlices_, [](const auto& k) { return k.has_value(); });
}

int SegmentationFrames::slicesLeftOut() const {
  int count = 0;
  for (int k = 0; k < taken_.size().z; ++k) {
    if (std::ranges::find(gridSlices_, std::optional<int>(k)) != gridSlices_.end()) continue;
    bool isEmpty = true;
    for (int j = 0; j < taken_.size().y && isEmpty; ++j)
      isEmpty = std::ranges::none_of(taken_.row(j, k), [](std::uint64_t word) { return word != 0; });
    count += !isEmpty;
  }
  return count;
}

}  // namespace volumen
