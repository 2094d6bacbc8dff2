#include "viewer/plan/facts.h"

#include <cmath>

#include "viewer/volume/gradient_bounds.h"
#include "viewer/volume/histogram.h"

namespace volumen {

namespace {

// Returns whether all voxels have one value that is slope * integer + intercept rounded to a float: narrow
// windows may show the difference.
bool isRounded(const Volume& volume, ValueRange range) {
  const double unrounded = std::visit(
      [&](const auto& stored) { return volume.slope() * double(stored.front()) + volume.intercept(); },
      volume.stored());
  return range.low == range.high && range.low != unrounded;
}

}  // namespace

VolumeFacts factsOf(const Volume& volume) {
  VolumeFacts facts;
  facts.geometry = volume.geometry();
  facts.rescaleSlope = volume.slope();
  const bool isUnsigned = std::holds_alternative<std::vector<std::uint16_t>>(volume.stored());
  facts.densityZero = volume.intercept() + (isUnsigned ? 32768 * volume.slope() : 0);
  facts.range = valueRange(volume);
  facts.integers =
      !std::holds_alternative<std::vector<float>>(volume.stored()) && !isRounded(volume, facts.range);
  const auto p = percentiles(volume, {1, 999});
  facts.p01 = p[0];
  facts.p999 = p[1];
  if (!volume.attributes().windows.empty()) facts.fileWindow = volume.attributes().windows.front();
  facts.blockRanges = std::make_shared<const BlockRanges>(blockRanges(volume));
  facts.gradientBounds = gradientBoundsOf(volume, *facts.blockRanges, facts.range);
  facts.cut = volume.attributes().cut;
  return facts;
}

double defaultGradientFloor(double valueSpread, const VoxelGeometry& geometry) {
  return valueSpread / 32 / std::cbrt(geometry.voxelVolume());
}

double defaultGradientFloor(const VolumeFacts& facts) {
  return defaultGradientFloor(facts.p999 - facts.p01, facts.geometry);
}

}  // namespace volumen
