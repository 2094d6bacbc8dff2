#include "viewer/plan/facts.h"

#include <cmath>

#include "viewer/volume/histogram.h"
#include "viewer/volume/slopes.h"

namespace volumen {

VolumeFacts factsOf(const Volume& volume) {
  VolumeFacts facts;
  facts.geometry = volume.geometry();
  facts.slope = volume.slope();
  facts.range = valueRange(volume);
  // One value alone is drawn as a float: slope * integer + intercept may be another before it is rounded.
  facts.integers =
      !std::holds_alternative<std::vector<float>>(volume.stored()) && facts.range.low < facts.range.high;
  const auto p = percentiles(volume, {1, 999});
  facts.p01 = p[0];
  facts.p999 = p[1];
  if (!volume.attributes().windows.empty()) facts.fileWindow = volume.attributes().windows.front();
  facts.bricks = std::make_shared<const BrickRanges>(brickRanges(volume));
  facts.slopes = slopesOf(volume, *facts.bricks, facts.range);
  return facts;
}

double defaultGradientFloor(const VolumeFacts& facts) {
  return (facts.p999 - facts.p01) / 32 / std::cbrt(facts.geometry.voxelVolume());
}

}  // namespace volumen
