#include "ui/controller/segment_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "ui/controller/label_reader.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// The border of a single voxel contains a disc of 0.41 voxels. The sample points of all pixels leave no free
// disc of 0.316 pixels.
glm::ivec2 partsPerPixel(glm::dvec2 voxelsPerPixel) {
  constexpr double enough = 1.3, most = 16;
  return glm::ivec2(glm::clamp(glm::ceil(voxelsPerPixel / enough - 1e-6), 1.0, most));
}

// Returns the pixels that may see a box, with a margin of one pixel; empty if the plane does not meet it.
QRect pixelsAbout(std::span<const glm::dvec3> corners, const SlicePlane& plane) {
  glm::dvec2 low(1e9), high(-1e9);
  double before = 1e9, behind = -1e9;
  for (const glm::dvec3& corner : corners) {
    const glm::dvec2 p = plane.pixelFromPatient(corner);
    low = glm::min(low, p), high = glm::max(high, p);
    const double away = glm::dot(corner - plane.centre, plane.normal());
    before = std::min(before, away), behind = std::max(behind, away);
  }
  constexpr double touching = 1e-3;  // mm
  if (before > touching || behind < -touching) return {};
  const glm::dvec2 size(plane.size);
  low = glm::clamp(glm::floor(low), glm::dvec2(0), size),
  high = glm::clamp(glm::ceil(high), glm::dvec2(0), size);
  if (low.x >= high.x || low.y >= high.y) return {};
  const QRect met(QPoint(int(low.x), int(low.y)), QPoint(int(high.x) - 1, int(high.y) - 1));
  return met.adjusted(-1, -1, 1, 1) & QRect(0, 0, plane.size.x, plane.size.y);
}

}  // namespace

SegmentSamples::SegmentSamples(std::span<const glm::dvec3> corners, const SlicePlane& plane,
                               glm::dvec2 voxelsPerPixel, std::size_t shownCount, const ReadLine& readLine)
    : area_(pixelsAbout(corners, plane)),
      parts_(partsPerPixel(voxelsPerPixel)),
      shownCount_(shownCount),
      numbers_(lineLength() * linesOfRow() * std::size_t(area_.height())),
      met_(std::size_t(tiles()) * std::size_t(area_.height())) {
  parallelFor(area_.height(), 0, [&](std::int64_t begin, std::int64_t end) {
    for (int row = int(begin); row < int(end); ++row) {
      readRow(row, readLine);
      noteNumbers(row);
    }
  });
}

SegmentSamples SegmentSamples::ofLabels(const SegmentLayer& layer, const SlicePlane& plane) {
  const LabelReader reader(layer, plane);
  return {reader.corners(), plane, reader.voxelsPerPixel(), layer.shown.size(),
          [&](glm::dvec2 pFirst, double step, std::span<std::uint8_t> numbers) {
            reader.read(pFirst, step, numbers);
          }};
}

SegmentSamples SegmentSamples::ofSegmentation(const Segmentation& all, std::size_t segment,
                                              const SlicePlane& plane) {
  const SegmentPlaces places(all, segment);
  const double smallest = std::min({all.mm.x, all.mm.y, all.thickness});
  return {places.corners(), plane, glm::dvec2(plane.mmPerPixel / smallest), 1,
          [&](glm::dvec2 pFirst, double step, std::span<std::uint8_t> numbers) {
            places.holdsAlong(plane.patientFromPixel(pFirst), step * plane.mmPerPixel * plane.right, numbers);
          }};
}

std::span<std::uint8_t> SegmentSamples::line(int row, std::size_t n) {
  return std::span(numbers_).subspan((std::size_t(row) * linesOfRow() + n) * lineLength(), lineLength());
}

std::span<const std::uint8_t> SegmentSamples::line(int row, std::size_t n) const {
  return std::span(numbers_).subspan((std::size_t(row) * linesOfRow() + n) * lineLength(), lineLength());
}

void SegmentSamples::readRow(int row, const ReadLine& readLine) {
  constexpr std::array<glm::dvec2, placesOfPart> placesInPart{
      // in parts
      {{0.5, 0.5}, {0.7, 0.9}, {0.9, 0.3}, {0.3, 0.1}, {0.1, 0.7}}};
  const glm::dvec2 part = 1.0 / glm::dvec2(parts_);
  for (std::size_t n = 0; n < linesOfRow(); ++n) {
    const glm::dvec2 inPixel = (placesInPart[n % placesOfPart] + glm::dvec2(0, n / placesOfPart)) * part;
    readLine(glm::dvec2(area_.left(), area_.top() + row) + inPixel, part.x, line(row, n));
  }
}

void SegmentSamples::noteNumbers(int row) {
  const std::size_t length = std::size_t(tileWidth * parts_.x);
  for (int tile = 0; tile < tiles(); ++tile) {
    std::array<bool, 256> isMet{};
    for (std::size_t n = 0; n < linesOfRow(); ++n) {
      const auto all = line(row, n);
      const auto part =
          all.subspan(std::size_t(tile) * length, std::min(length, all.size() - std::size_t(tile) * length));
      isMet[part.front()] = true;
      if (std::memcmp(part.data(), part.data() + 1, part.size() - 1) == 0) continue;  // all equal
      for (const std::uint8_t number : part) isMet[number] = true;
    }
    Numbers& met = met_[std::size_t(row) * std::size_t(tiles()) + std::size_t(tile)];
    for (std::size_t number = 0; number <= shownCount_; ++number) met[number] = isMet[number];
  }
}

void SegmentSamples::count(int row, std::size_t number, int from, int to, std::uint16_t* counts) const {
  const auto parts = std::size_t(parts_.x), pixels = std::size_t(to - from);
  std::fill_n(counts, pixels, std::uint16_t(0));
  const auto wanted = std::uint8_t(number);  // of the width of samples, so that sixteen are compared at once
  const auto add = [&](std::size_t x, std::uint8_t met) {
    counts[x] = std::uint16_t(counts[x] + (met == wanted));
  };
  for (std::size_t n = 0; n < linesOfRow(); ++n) {
    const std::uint8_t* place = line(row, n).data() + std::size_t(from) * parts;
    if (parts == 1)  // the usual case, which compilers vectorise
      for (std::size_t x = 0; x < pixels; ++x) add(x, place[x]);
    else
      for (std::size_t x = 0; x < pixels; ++x)
        for (std::size_t part = 0; part < parts; ++part) add(x, *place++);
  }
}

}  // namespace volumen
