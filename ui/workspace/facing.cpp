#include "ui/workspace/facing.h"

#include <algorithm>
#include <cmath>

#include "ui/workspace/flat_plane.h"
#include "ui/workspace/frame_text.h"

namespace volumen {

namespace {

// Tissue lies at the chest wall, air opposite.
ChestWall brighterSide(const LoadedFrame& frame) {
  constexpr int step = 8;             // pixels between samples
  constexpr double leastPart = 0.05;  // smallest mean difference of the sides, as part of the value range
  const Volume& values = *frame.slice->volume;
  const glm::ivec3 size = values.size();
  double low = 0, high = 0, left = 0, right = 0;
  int count = 0;
  for (int j = 0; j < size.y; j += step)
    for (int i = 0; i < size.x / 2; i += step, ++count) {
      const double a = values.value(i, j, 0), b = values.value(size.x - 1 - i, j, 0);
      if (count == 0) low = high = a;
      low = std::min({low, a, b}), high = std::max({high, a, b});
      left += a, right += b;
    }
  if (count == 0 || std::abs(left - right) < leastPart * count * (high - low) || high == low)
    return ChestWall::anywhere;
  const bool isInverted = !frame.greys.empty() && frame.greys.front().mapping.inverted;
  return (left > right) != isInverted ? ChestWall::left : ChestWall::right;
}

glm::dvec2 wholeMm(const FacingFrame& f) {
  const VoxelGeometry& geometry = f.frame->geometry();
  const SlicePlane plane = framePlane(geometry);
  return glm::dvec2(plane.size) * plane.mmPerPixel;
}

double fittedMm(const FacingFrame& f) {
  const glm::dvec2 whole = wholeMm(f);
  return std::max(whole.x / f.pixels.x, whole.y / f.pixels.y);
}

}  // namespace

ChestWall chestWallOf(const LoadedFrame& frame) {
  const std::string& along = frame.rowSide;  // direction of the rows
  const bool toBack = along.find('P') != std::string::npos, toFront = along.find('A') != std::string::npos;
  if (toBack != toFront) return toBack ? ChestWall::right : ChestWall::left;
  return frame.colour() ? ChestWall::anywhere : brighterSide(frame);
}

bool liesUpsideDown(const LoadedFrame& frame) {
  if (frame.columnSide.empty()) return false;
  const char down = frame.columnSide.front();  // direction of the columns
  const std::string& breast = frame.slice->series.laterality;
  return down == 'S' || ((down == 'L' || down == 'R') && breast == std::string(1, down));
}

std::vector<FlatLook> facingLooks(const std::vector<FacingFrame>& frames, bool sameScale) {
  double mmPerPixel = 0;  // largest among frames with pixel size in mm
  for (const FacingFrame& f : frames)
    if (hasMm(*f.frame)) mmPerPixel = std::max(mmPerPixel, fittedMm(f));
  std::vector<FlatLook> looks;
  for (const FacingFrame& f : frames) {
    FlatLook& look = looks.emplace_back(f.look);
    const double fitted = fittedMm(f), shown = sameScale && hasMm(*f.frame) ? mmPerPixel : fitted;
    look.turn = {};
    look.zoom = std::clamp(fitted / shown, leastZoom, mostZoom);
    look.panMm = {0, 0};
    if (f.wanted == ChestWall::anywhere) continue;
    const ChestWall now = chestWallOf(*f.frame);
    const bool facesAway = now != ChestWall::anywhere && now != f.wanted;
    const bool isUpsideDown = liesUpsideDown(*f.frame);
    look.turn = {isUpsideDown ? 2 : 0, facesAway != isUpsideDown};
    const double beside = (wholeMm(f).x - f.pixels.x * fitted / look.zoom) / 2;
    look.panMm.x = f.wanted == ChestWall::right ? beside : -beside;
  }
  return looks;
}

}  // namespace volumen
