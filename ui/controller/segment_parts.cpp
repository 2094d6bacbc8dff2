#include "ui/controller/segment_parts.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "results/segments/segment_record.h"
#include "results/text/text.h"
#include "ui/controller/segment_target.h"
#include "ui/workspace/curve_spans.h"
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

PartUse useOf(const PartClick& click, const SegmentOptions& options) {
  if (click.keys & Qt::ControlModifier) return PartUse::keep;
  if (click.keys & Qt::AltModifier) return PartUse::remove;
  return options.partUse;
}

QString whyNoPart(const Session& session, const PartClick& click, PartUse use) {
  if (click.onFrame) return tr("Frames have no connected parts: show the series as slices.");
  const QString why = whyNotIn(session, click.series);
  const bool isReady = !why.isEmpty() || segmentShown(session) || use == PartUse::add;
  return isReady ? why : whyNotChanged(session);
}

}  // namespace

Segment segmentOfRange(const ValueRange& range, const Series& series) {
  Segment segment;
  segment.label = nameOfRange(range, series);
  segment.range = range;
  return segment;
}

Result<SegmentWork> partOf(const Session& session, const SegmentOptions& options, const PartClick& click) {
  const PartUse use = useOf(click, options);
  if (const QString why = whyNoPart(session, click, use); !why.isEmpty()) return Error{why.toStdString()};
  SegmentWork work = workShown(session,
                               use == PartUse::add    ? tr("Add connected part")
                               : use == PartUse::keep ? tr("Keep connected part")
                                                      : tr("Remove connected part"),
                               tr("Finding the connected part"));
  if (const Segment* segment = segmentShown(session))
    work.number = segment->number;
  else
    work.change = [made = segmentOfRange(options.range, session.series()->series)](Segment& s) { s = made; };
  PartWanted wanted{work.volume, session.maskOf(click.series), click, options};
  wanted.options.partUse = use;
  work.steps = [wanted](const SegmentMap& map, int number, const CancelToken& cancel) {
    return stepsOfPart(wanted, map, number, cancel);
  };
  return work;
}

Result<StepsWanted> stepsOfPart(const PartWanted& wanted, const SegmentMap& map, int number,
                                const CancelToken& cancel) {
  constexpr int besideSurface = 2;  // voxels; the seen point may lie outside the range, at half the light
  const SegmentOptions& options = wanted.options;
  const bool isOfRange = options.partUse == PartUse::add;
  const BitMask whole = isOfRange ? keptVoxelsInRange(*wanted.volume, options.range, wanted.mask, cancel)
                                  : maskOf(*map.labels, std::uint8_t(number));
  const auto seed = nearestIn(whole, wanted.click.pPatient, wanted.click.onSurface ? besideSurface : 0);
  if (!seed)
    return Error{isOfRange
                     ? "The voxel that was clicked is not in the range of values: click on another one, "
                       "or change the range in the panel Segments."
                     : "The voxel that was clicked is not in the current segment: click on one that is."};
  const std::vector<glm::dvec3> at{whole.geometry().patientFromVoxel(*seed)};
  const std::string own = stepNameOf(number), part = partName;
  Step connectedStep{"connected", part, {{"at", at}, {"neighbours", options.neighbours}}};
  if (options.leakGuardMm > 0) {
    connectedStep.fields["leakGuardMm"] = options.leakGuardMm;
    // Its existence does not depend on which voxels touch.
    if (connectedBeyond(whole, std::span(&*seed, 1), Neighbours::faces, options.leakGuardMm, cancel).empty())
      return Error{"What was clicked is thinner than twice the leak guard: make that smaller."};
    if (!isOfRange) return guardedPart(connectedStep, own, options.partUse, number);
  }
  if (!isOfRange)
    return StepsWanted{{{options.partUse == PartUse::keep ? "keep" : "remove",
                         own,
                         {{"at", at}, {"neighbours", options.neighbours}}}},
                       {number}};
  StepsWanted steps{{{"range", part, {{"low", options.range.low}, {"high", options.range.high}}}}, {number}};
  steps = keptIn(std::move(steps), {part}, *wanted.volume, wanted.mask, cancel);
  steps.steps.push_back(connectedStep);
  steps.steps.push_back({"add", own, {{"other", part}}});
  return steps;
}

}  // namespace volumen
