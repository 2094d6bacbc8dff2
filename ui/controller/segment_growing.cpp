#include "ui/controller/segment_growing.h"

#include <algorithm>
#include <limits>

#include "ui/workspace/segment_record.h"
#include "ui/workspace/segments.h"
#include "ui/workspace/text.h"
#include "viewer/segment/grow_from_seeds.h"

namespace volumen {

namespace {

// About the box of the seeds.
double marginOf(const BitMask& seeds) {
  constexpr double share = 0.1, leastVoxels = 3;
  const auto box = seeds.box();
  if (!box) return 0;
  const glm::dvec3 spacing = seeds.geometry().spacing(),
                   edges = glm::dvec3(box->high - box->low + 1) * spacing;
  return std::max(share * std::max({edges.x, edges.y, edges.z}),
                  leastVoxels * std::max({spacing.x, spacing.y, spacing.z}));
}

Result<SegmentMap> grownIn(SegmentMap map, const Volume& volume, const Mask& mask, GrowthRegion region,
                           const CancelToken& cancel) {
  BitMask within = mask.empty() ? inverted(BitMask(volume.geometry())) : keptVoxels(volume, mask, cancel);
  BitMask seeds(volume.geometry());
  for (const Segment& segment : map.segments) {
    const BitMask own = maskOf(*map.labels, std::uint8_t(segment.number));
    if (isSeed(segment))
      seeds = united(std::move(seeds), own);
    else
      within = subtracted(std::move(within), own);
  }
  SeedGrowth growth;
  growth.within = &within;
  growth.marginMm = region == GrowthRegion::everywhere ? std::numeric_limits<double>::infinity()
                                                       : marginOf(intersected(std::move(seeds), within));
  const Result<LabelMap> grown = grownFromSeeds(volume, *map.labels, growth, cancel);
  if (!grown) return grown.error();
  for (const Segment& segment : std::vector(map.segments))
    if (isSeed(segment))
      map = withMask(std::move(map), segment.number, maskOf(*grown, std::uint8_t(segment.number)));
  return map;
}

// "Lesion 1", "Lesion 2".
std::string lesionName(const SegmentMap& map) {
  for (int n = 1;; ++n) {
    const std::string name = tr("Lesion %1").arg(n).toStdString();
    if (std::ranges::find(map.segments, name, &Segment::label) == map.segments.end()) return name;
  }
}

Result<SegmentMap> withLesion(SegmentMap map, const LesionWanted& wanted, const CancelToken& cancel) {
  const std::optional<int> number = freeNumber(map);
  if (!number) return Error{"There are 255 segments, and no more fit: remove one first."};
  Segment lesion;
  lesion.number = *number;
  lesion.label = lesionName(map);
  lesion.description = wanted.said.toStdString();
  constexpr double mostMm = 1000;  // that the step takes: more than a patient
  const std::string sphere = "Sphere", own = stepNameOf(*number);
  const auto& [amount, isShare] = wanted.threshold;
  const double radiusMm = std::min(wanted.radiusMm, mostMm);
  StepsWanted steps{{{"ball", sphere, {{"at", std::vector{wanted.pPatient}}, {"radiusMm", radiusMm}}}},
                    {*number}};
  steps = keptIn(std::move(steps), {sphere}, *wanted.volume, wanted.mask, cancel);
  const std::string by = isShare ? "share" : "value";
  steps.steps.push_back({"lesion", own, {{"in", sphere}, {"by", by}, {by, amount}}});
  Result<SegmentMap> made =
      withStepsDone(withSegment(std::move(map), std::move(lesion)), steps, *wanted.volume, cancel);
  if (made || cancel.cancelled()) return made;
  // Without the name of the step, which nobody chose.
  const std::string why = made.message();
  return Error{"No lesion in the sphere: " + why.substr(why.find(": ") + 2)};
}

}  // namespace

bool isSeed(const Segment& segment) { return segment.visible && !segment.locked; }

SegmentWork growthOf(const SeriesKey& series, VolumePtr volume, const Mask& mask, GrowthRegion region) {
  SegmentWork work;
  work.series = series;
  work.volume = volume;
  work.text = tr("Grow from seeds");
  work.doing = tr("Growing from seeds");
  work.makeAll = [volume = std::move(volume), mask, region](const SegmentMap& map,
                                                            const CancelToken& cancel) {
    return grownIn(map, *volume, mask, region, cancel);
  };
  return work;
}

SegmentWork lesionOf(const SeriesKey& series, const LesionWanted& wanted) {
  SegmentWork work;
  work.series = series;
  work.volume = wanted.volume;
  work.text = tr("Add lesion");
  work.doing = tr("Finding the lesion");
  work.makeAll = [wanted](const SegmentMap& map, const CancelToken& cancel) {
    return withLesion(map, wanted, cancel);
  };
  return work;
}

}  // namespace volumen
