#include "viewer/segment/mean_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "viewer/segment/table.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr double cellMm = 3;
constexpr std::size_t bins = 256;

VoxelGeometry cellsOver(const VoxelGeometry& geometry) {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const glm::dvec3& corner : geometry.boxCorners()) low = min(low, corner), high = max(high, corner);
  VoxelGeometry cells;
  cells.size = max(glm::ivec3(ceil((high - low) / cellMm)), glm::ivec3(1));
  cells.patientFromVoxelStep = glm::dmat3(cellMm);
  cells.origin = low + cellMm / 2;
  return cells;
}

// Returns the number of the bin below which a histogram is divided best, and the mean bin below it.
std::pair<double, double> bestDivision(const std::array<double, bins>& counts) {
  double all = 0, sum = 0, below = 0, sumBelow = 0, best = -1;
  for (std::size_t n = 0; n < bins; ++n) all += counts[n], sum += double(n) * counts[n];
  std::pair<double, double> found{0, 0};
  for (std::size_t n = 0; n + 1 < bins; ++n) {
    below += counts[n], sumBelow += double(n) * counts[n];
    if (below == 0 || below == all) continue;
    const double apart = (sum - sumBelow) / (all - below) - sumBelow / below;
    const double between = below * (all - below) * apart * apart;
    if (between > best) best = between, found = {double(n + 1), sumBelow / below};
  }
  return found;
}

// Returns the values at the eight cells around a place, weighted linearly.
double valueBetween(const MeanCells& cells, glm::dvec3 place) {
  const glm::ivec3 last = cells.grid.size - 1;
  place = clamp(place, glm::dvec3(0), glm::dvec3(last));
  const glm::ivec3 low(place);
  const glm::dvec3 part = place - glm::dvec3(low);
  double sum = 0;
  for (int n = 0; n < 8; ++n) {
    const glm::ivec3 corner(n & 1, n >> 1 & 1, n >> 2);
    const glm::dvec3 weight = mix(1.0 - part, part, glm::dvec3(corner));
    sum += weight.x * weight.y * weight.z * cells.values[cells.placeOf(min(low + corner, last))];
  }
  return sum;
}

}  // namespace

MeanCells meanCells(const Volume& volume) {
  const VoxelGeometry& from = volume.geometry();
  const VoxelGeometry grid = cellsOver(from);
  MeanCells cells{grid, std::vector<float>(std::size_t(grid.voxelCount())), BitMask(grid)};
  const auto& padding = volume.attributes().padding;
  const auto fill = [&](glm::ivec3 cell) {
    double sum = 0;
    int count = 0;
    for (int n = 0; n < 8; ++n) {
      const glm::dvec3 corner = glm::dvec3(n & 1, n >> 1 & 1, n >> 2) / 2.0 - 0.25;
      const glm::ivec3 at(round(from.voxelFromPatient(grid.patientFromVoxel(glm::dvec3(cell) + corner))));
      if (clamp(at, glm::ivec3(0), from.size - 1) != at) continue;
      const double value = volume.value(at.x, at.y, at.z);
      if (!isPadding(padding, value)) sum += value, ++count;
    }
    if (count == 0) return;
    cells.known.set(cell);
    cells.values[cells.placeOf(cell)] = float(sum / count);
  };
  parallelFor(grid.size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (int k = int(begin); k < int(end); ++k)
      for (int j = 0; j < grid.size.y; ++j)
        for (int i = 0; i < grid.size.x; ++i) fill({i, j, k});
  });
  return cells;
}

double airThreshold(const MeanCells& cells, const std::string& modality) {
  constexpr double highestAirHu = -500, usual = 0.995;
  std::vector<float> known;
  for (int k = 0; k < cells.grid.size.z; ++k)
    for (int j = 0; j < cells.grid.size.y; ++j)
      for (int i = 0; i < cells.grid.size.x; ++i)
        if (cells.known.at({i, j, k})) known.push_back(cells.values[cells.placeOf({i, j, k})]);
  if (known.empty()) return 0;
  const double low = *std::ranges::min_element(known);
  if (modality == "CT" && low < highestAirHu) return notAirHu;
  const auto top = known.begin() + std::ptrdiff_t(usual * double(known.size() - 1));
  std::ranges::nth_element(known, top);
  const double width = std::sqrt(double(*top) - low) / double(bins);
  if (!(width > 0)) return low;
  std::array<double, bins> counts{};
  for (const float value : known)
    counts[std::size_t(std::min(std::sqrt(double(value) - low) / width, double(bins - 1)))] += 1;
  const auto [division, air] = bestDivision(counts);
  const double root = (division + air) / 2 * width;
  return low + root * root;
}

BitMask voxelsAboveZero(const MeanCells& cells, const VoxelGeometry& geometry) {
  BitMask found(geometry);
  const glm::ivec3 size = geometry.size;
  const glm::dvec3 step = cells.grid.voxelFromPatientStep() * geometry.patientFromVoxelStep[0];
  parallelFor(std::int64_t(size.y) * size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin; n < end; ++n) {
      const int j = int(n % size.y), k = int(n / size.y);
      const glm::dvec3 first = cells.grid.voxelFromPatient(geometry.patientFromVoxel({0, j, k}));
      for (int i = 0; i < size.x; ++i)
        if (valueBetween(cells, first + double(i) * step) > 0) found.set({i, j, k});
    }
  });
  return found;
}

}  // namespace volumen
