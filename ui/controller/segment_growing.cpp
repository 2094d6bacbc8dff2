#include "ui/controller/segment_growing.h"

#include <algorithm>

#include "ui/workspace/segment_maps.h"
#include "ui/workspace/segment_record.h"
#include "ui/workspace/segments.h"
#include "ui/workspace/text.h"
#include "viewer/recipe/step_kinds.h"

namespace volumen {

namespace {

// Removes the name of the step, which the user did not choose.
std::string withoutStepName(const std::string& why) { return why.substr(why.find(": ") + 2); }

// Seeds are ordered by number, which decides between paths of equal cost.
Result<SegmentMap> grownIn(SegmentMap map, const Volume& volume, const Mask& mask, GrowthRegion region,
                           const CancelToken& cancel) {
  StepsWanted wanted{{}, {}, true, {}};
  std::vector<std::string> with, locked;
  for (const Segment& segment : map.segments)
    if (isSeed(segment))
      wanted.numbers.push_back(segment.number);
    else
      locked.push_back(stepNameOf(segment.number));
  if (wanted.numbers.size() < 2)
    return Error{"Nothing was grown: seeds of at least two segments are needed, shown and not locked."};
  std::ranges::sort(wanted.numbers);
  for (const int number : wanted.numbers) with.push_back(stepNameOf(number));
  const std::string first = with.front();
  with.erase(with.begin());
  const std::string within = keptName(wanted, volume, mask, cancel),
                    where = region == GrowthRegion::everywhere ? "everywhere" : "about";
  wanted.steps.push_back({growFromSeedsStep,
                          first,
                          {{"with", with}, {"region", where}, {"within", within}, {"locked", locked}}});
  Result<SegmentMap> made = withStepsDone(std::move(map), wanted, volume, cancel);
  if (made || cancel.cancelled()) return made;
  return Error{"Nothing was grown: " + withoutStepName(made.message())};
}

// Returns a free name: "Lesion 1", "Lesion 2".
std::string lesionName(std::vector<SegmentMap> maps, const SegmentMap& map) {
  maps.push_back(map);
  for (int n = 1;; ++n) {
    const std::string name = tr("Lesion %1").arg(n).toStdString();
    if (freeName(maps, name) == name) return name;
  }
}

Result<SegmentMap> withLesion(SegmentMap map, const LesionWanted& wanted, const CancelToken& cancel) {
  const std::optional<int> number = freeNumber(map);
  if (!number) return Error{"There are 255 segments, and no more fit: remove one first."};
  Segment lesion;
  lesion.number = *number;
  lesion.label = lesionName(wanted.beside, map);
  lesion.description = wanted.said.toStdString();
  constexpr double mostMm = 1000;  // limit of the step; larger than a patient
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
  return Error{"No lesion in the sphere: " + withoutStepName(made.message())};
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
