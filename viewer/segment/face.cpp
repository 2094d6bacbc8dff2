#include "viewer/segment/face.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "viewer/segment/distance_field.h"
#include "viewer/segment/holes.h"
#include "viewer/segment/mask.h"
#include "viewer/segment/mean_cells.h"
#include "viewer/segment/morphology.h"
#include "viewer/segment/parts.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr double adultDepthMm = 73;

// The middle of the skull, and its depth below the surface.
struct Skull {
  glm::ivec3 middle{0};
  double depthMm = 0;
  double scaled(double ofAdultMm) const { return ofAdultMm * depthMm / adultDepthMm; }
};

// The cells of a head, and the depth of each below its surface in mm. Where the volume ends is no surface.
struct Head {
  BitMask body;
  std::vector<float> depths;
};

template <class Holds>
BitMask cellsWhere(const VoxelGeometry& grid, const Holds& holds) {
  BitMask cells(grid);
  parallelFor(grid.size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (int k = int(begin); k < int(end); ++k)
      for (int j = 0; j < grid.size.y; ++j)
        for (int i = 0; i < grid.size.x; ++i)
          if (holds(glm::ivec3(i, j, k))) cells.set({i, j, k});
  });
  return cells;
}

// Closing and filling join the skin to the brain, past dark bone and air in the head. Opening takes holders
// and ears away, which so lie outside.
Head headIn(const MeanCells& cells, const std::string& modality, const CancelToken& cancel) {
  constexpr double gapMm = 6, thinMm = 6;
  constexpr int axial = 2;
  const double air = airThreshold(cells, modality);
  const BitMask matter = cellsWhere(cells.grid, [&](glm::ivec3 cell) {
    return cells.known.at(cell) && cells.values[cells.placeOf(cell)] > air;
  });
  BitMask body = closed(Parts(matter, Neighbours::faces, cancel).largest(), gapMm, cancel);
  body = holesFilled(holesFilledInSlices(body, axial, cancel), cancel);
  body = Parts(opened(body, thinMm, cancel), Neighbours::faces, cancel).largest();
  std::vector<float> depths = distancesFrom(subtracted(cells.known, body));
  return {std::move(body), std::move(depths)};
}

// Below a skull, heads get narrow before shoulders come, which are deeper.
Skull skullOf(const Head& head, const MeanCells& cells) {
  constexpr double leastMm = 40, neck = 0.85;
  const glm::ivec3 size = cells.grid.size;
  Skull skull;
  for (int k = size.z - 1; k >= 0; --k) {
    Skull deepest;
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const double depth = head.depths[cells.placeOf({i, j, k})];
        if (head.body.at({i, j, k}) && depth > deepest.depthMm) deepest = {{i, j, k}, depth};
      }
    if (deepest.depthMm > skull.depthMm)
      skull = deepest;
    else if (skull.depthMm > leastMm && deepest.depthMm < neck * skull.depthMm)
      break;
  }
  return skull;
}

// Returns the number of cells from the middle of the skull to the end of the head in a direction; 0 if the
// volume ends before.
int cellsToEnd(const Head& head, const MeanCells& cells, glm::ivec3 from, glm::ivec3 step) {
  int count = 0;
  glm::ivec3 at = from;
  const auto isInGrid = [&] { return clamp(at, glm::ivec3(0), cells.grid.size - 1) == at; };
  for (; isInGrid() && head.body.at(at); at += step) ++count;
  return isInGrid() && cells.known.at(at) ? count : 0;
}

// A head is longer than wide, and as wide as it is deep; chests and pairs of legs are wider.
bool isHead(const Head& head, const MeanCells& cells, const Skull& skull) {
  constexpr double leastMm = 45, mostMm = 100, widest = 2.7;
  const auto reach = [&](glm::ivec3 step) { return cellsToEnd(head, cells, skull.middle, step); };
  const int left = reach({1, 0, 0}), right = reach({-1, 0, 0}), front = reach({0, -1, 0});
  if (left == 0 || right == 0 || front == 0) return false;
  int back = 0;  // may lie on a table, or end with the volume
  for (glm::ivec3 at = skull.middle; at.y < cells.grid.size.y && head.body.at(at); ++at.y) ++back;
  const double cellMm = cells.grid.spacing().x;
  return skull.depthMm >= leastMm && skull.depthMm <= mostMm && front + back >= left + right &&
         (left + right) * cellMm <= widest * skull.depthMm;
}

// Returns values that are above 0 in the region to remove.
MeanCells regionOf(const Head& head, const MeanCells& cells, const Skull& skull) {
  constexpr double skinMm = 5, faceMm = 25, reachMm = 190, belowMm = 15, earsMm = 20, ball = 0.75;
  constexpr double lean = glm::pi<double>() / 12;
  const glm::dvec3 forward(0, -std::cos(lean), -std::sin(lean));
  const auto fromMiddle = [&](glm::ivec3 cell) {
    return cells.grid.patientFromVoxelStep * glm::dvec3(cell - skull.middle);
  };
  const double ballMm = ball * skull.depthMm;
  const BitMask centres = cellsWhere(cells.grid, [&](glm::ivec3 cell) {
    return head.body.at(cell) && head.depths[cells.placeOf(cell)] >= ballMm &&
           fromMiddle(cell).z >= -skull.scaled(belowMm);
  });
  MeanCells region{cells.grid, distancesFrom(centres), cells.known};
  for (int k = 0; k < cells.grid.size.z; ++k)
    for (int j = 0; j < cells.grid.size.y; ++j)
      for (int i = 0; i < cells.grid.size.x; ++i) {
        const std::size_t place = cells.placeOf({i, j, k});
        const glm::dvec3 from = fromMiddle({i, j, k});
        region.values[place] = float(std::min({double(region.values[place]) - (ballMm - skull.scaled(skinMm)),
                                               skull.scaled(faceMm) - head.depths[place],
                                               glm::dot(from, forward) + skull.scaled(earsMm),
                                               skull.scaled(reachMm) - glm::length(from)}));
      }
  return region;
}

// The Error: a face cannot be searched in the volume.
Status checkVolume(const Volume& volume) {
  constexpr double leastMm = 30, mostMl = 1e6;
  const auto& [name, modality, windows, padding, cut] = volume.attributes();
  const VoxelGeometry& geometry = volume.geometry();
  if (!modality.empty() && modality != "CT" && modality != "MR")
    return Error{name + " is neither CT nor MR: faces can be taken away from these alone."};
  if (!geometry.calibrated)
    return Error{name + " is not calibrated: where its front is must be known to take a face away."};
  const glm::dvec3 extent = geometry.spacing() * glm::dvec3(geometry.size);
  if (std::min({extent.x, extent.y, extent.z}) < leastMm)
    return Error{name + " is thinner than 30 mm and shows no face that could be taken away."};
  if (extent.x * extent.y * extent.z > mostMl * 1000)
    return Error{name + " is larger than a cubic metre: no face can be taken away."};
  return {};
}

}  // namespace

Result<BitMask> faceOf(const Volume& volume, const CancelToken& cancel) {
  if (Status s = checkVolume(volume); !s) return s.error();
  const MeanCells cells = meanCells(volume);
  const Head head = headIn(cells, volume.attributes().modality, cancel);
  const Skull skull = skullOf(head, cells);
  if (cancel.cancelled()) return Error{"No face was taken away: cancelled."};
  if (!isHead(head, cells, skull))
    return Error{volume.attributes().name + " shows no head with air around it: no face can be taken away."};
  return voxelsAboveZero(regionOf(head, cells, skull), volume.geometry());
}

Result<VolumePtr> defaced(const Volume& volume, const CancelToken& cancel) {
  const auto face = faceOf(volume, cancel);
  return face ? keptAlone(volume, inverted(*face), cancel) : face.error();
}

}  // namespace volumen
