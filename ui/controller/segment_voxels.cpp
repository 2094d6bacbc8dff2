#include "ui/controller/segment_voxels.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "ui/workspace/segment_record.h"
#include "viewer/segment/parts.h"

namespace volumen {

namespace {

bool isInGrid(glm::ivec3 voxel, glm::ivec3 size) {
  return voxel.x >= 0 && voxel.y >= 0 && voxel.z >= 0 && voxel.x < size.x && voxel.y < size.y &&
         voxel.z < size.z;
}

// Returns the voxel of the mask nearest to a point; nothing if there is none within `within` voxels.
std::optional<glm::ivec3> nearestIn(const BitMask& mask, glm::dvec3 pPatient, int within) {
  const VoxelGeometry& grid = mask.geometry();
  const glm::ivec3 middle(glm::floor(grid.voxelFromPatient(pPatient) + 0.5));
  std::optional<glm::ivec3> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (int k = -within; k <= within; ++k)
    for (int j = -within; j <= within; ++j)
      for (int i = -within; i <= within; ++i) {
        const glm::ivec3 voxel = middle + glm::ivec3(i, j, k);
        if (!isInGrid(voxel, grid.size) || !mask.at(voxel)) continue;
        const double mm = glm::distance(grid.patientFromVoxel(voxel), pPatient);
        if (mm < least) least = mm, nearest = voxel;
      }
  return nearest;
}

constexpr const char* partName = "Part";

// Keeps or removes the component of a segment with a leak guard.
StepsWanted guardedPart(const Step& connectedStep, const std::string& own, PartUse use, int number) {
  Step step = connectedStep;
  if (use == PartUse::keep) {
    step.segment = own;
    return {{step}, {number}};
  }
  return {{{"copy", partName, {{"other", own}}}, step, {"subtract", own, {{"other", partName}}}}, {number}};
}

}  // namespace

Result<StepsWanted> stepsOfPart(const PartWanted& wanted, const SegmentMap& map, int number,
                                const CancelToken& cancel) {
  constexpr int besideSurface = 2;  // voxels; the seen point may lie outside the range, at half the light
  const bool isOfRange = wanted.use == PartUse::add;
  const BitMask whole = isOfRange ? keptVoxelsInRange(*wanted.volume, wanted.range, wanted.mask, cancel)
                                  : maskOf(*map.labels, std::uint8_t(number));
  const auto seed = nearestIn(whole, wanted.pPatient, wanted.onSurface ? besideSurface : 0);
  if (!seed)
    return Error{isOfRange
                     ? "The voxel that was clicked is not in the range of values: click on another one, "
                       "or change the range in the panel Segments."
                     : "The voxel that was clicked is not in the current segment: click on one that is."};
  const std::vector<glm::dvec3> at{whole.geometry().patientFromVoxel(*seed)};
  const std::string own = stepNameOf(number), part = partName;
  Step connectedStep{"connected", part, {{"at", at}, {"neighbours", wanted.neighbours}}};
  if (wanted.leakGuardMm > 0) {
    connectedStep.fields["leakGuardMm"] = wanted.leakGuardMm;
    // Its existence does not depend on which voxels touch.
    if (connectedBeyond(whole, std::span(&*seed, 1), Neighbours::faces, wanted.leakGuardMm, cancel).empty())
      return Error{"What was clicked is thinner than twice the leak guard: make that smaller."};
    if (!isOfRange) return guardedPart(connectedStep, own, wanted.use, number);
  }
  if (!isOfRange)
    return StepsWanted{{{wanted.use == PartUse::keep ? "keep" : "remove",
                         own,
                         {{"at", at}, {"neighbours", wanted.neighbours}}}},
                       {number}};
  StepsWanted steps{{{"range", part, {{"low", wanted.range.low}, {"high", wanted.range.high}}}}, {number}};
  steps = keptIn(std::move(steps), {part}, *wanted.volume, wanted.mask, cancel);
  steps.steps.push_back(connectedStep);
  steps.steps.push_back({"add", own, {{"other", part}}});
  return steps;
}

}  // namespace volumen
