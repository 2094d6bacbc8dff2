#include "results/segments/step_work.h"

#include <algorithm>
#include <set>
#include <span>

#include "results/segments/segment_record.h"
#include "results/segments/segments.h"
#include "viewer/recipe/step_kinds.h"
#include "viewer/recipe/step_names.h"
#include "viewer/segment/parts.h"

namespace volumen {

namespace {

const Segment* segmentCalled(const SegmentMap& map, const std::string& name) {
  const auto found = std::ranges::find_if(
      map.segments, [&](const Segment& segment) { return stepNameOf(segment.number) == name; });
  return found == map.segments.end() ? nullptr : &*found;
}

// Replaces numbers of segments in a sentence by their names.
std::string namedIn(std::string sentence, const SegmentMap& map) {
  for (const Segment& segment : map.segments) {
    const std::string quoted = '"' + stepNameOf(segment.number) + '"';
    for (std::size_t at = 0; (at = sentence.find(quoted, at)) != std::string::npos;) {
      sentence.replace(at, quoted.size(), '"' + segment.label + '"');
      at += segment.label.size() + 2;
    }
  }
  return sentence;
}

// Returns the masks of all segments that the steps start from.
NamedMasks masksFor(const StepsWanted& wanted, const SegmentMap& map) {
  NamedMasks masks = wanted.given;
  for (const Step& step : wanted.steps)
    for (const std::string& name : neededBy(step))
      if (const Segment* segment = segmentCalled(map, name); segment && !masks.contains(name))
        masks.emplace(name, maskOf(*map.labels, std::uint8_t(segment->number)));
  return masks;
}

// The steps by which a segment takes voxels from others and leaves those of locked ones. They cover all
// segments that might overlap if the steps ran with other numbers. For manual work they cover actual overlaps
// only.
class Taking {
 public:
  Taking(const std::vector<Step>& steps) : byHand_(madeByHand(steps)) {
    for (const Step& step : steps)
      for (std::string& name : changedBy(step)) changed_.insert(std::move(name));
  }

  /// `later` are segments that get their voxels afterwards and take them from it.
  std::vector<Step> steps(const SegmentMap& map, int number, const BitMask& mask,
                          std::span<const int> later) const {
    const std::string own = stepNameOf(number);
    std::vector<Step> taking;
    for (const Segment& segment : map.segments) {
      const std::string other = stepNameOf(segment.number);
      if (other == own || std::ranges::count(later, segment.number) > 0) continue;
      const bool mightOverlap = isRecorded(own) && isRecorded(other);
      if (!mightOverlap && intersected(maskOf(*map.labels, std::uint8_t(segment.number)), mask).empty())
        continue;
      const std::string &from = segment.locked ? own : other, &what = segment.locked ? other : own;
      taking.push_back({"subtract", from, {{"other", what}}});
    }
    return taking;
  }

 private:
  bool isRecorded(const std::string& name) const {
    return changed_.contains(name) && !byHand_.contains(name);
  }

  std::set<std::string> changed_, byHand_;
};

// Recipes may have helpers of the same name.
std::string freeHelper(const std::vector<Step>& steps, std::string name) {
  while (std::ranges::find(steps, name, &Step::segment) != steps.end()) name += " 2";
  return name;
}

bool isOnlyNarrowed(const std::vector<Step>& steps, const std::string& name) {
  return std::ranges::all_of(steps, [&](const Step& step) {
    return onlyNarrows(step) || std::ranges::count(changedBy(step), name) == 0;
  });
}

}  // namespace

Result<SegmentMap> withStepsDone(SegmentMap map, const StepsWanted& wanted, const Volume& volume,
                                 const CancelToken& cancel) {
  std::vector<Step> steps = wanted.steps;
  std::erase_if(steps, [&](const Step& step) {
    return step.kind == byHandStep && wanted.given.contains(step.segment);
  });
  StepRun run{steps, masksFor(wanted, map)};
  for (const int number : wanted.numbers) run.kept.insert(stepNameOf(number));
  const auto masks = runSteps(std::move(run), volume, cancel);
  if (!masks) return Error{namedIn(masks.message(), map)};
  std::vector<Step> done = wanted.steps, all = map.steps;
  all.insert(all.end(), wanted.steps.begin(), wanted.steps.end());
  const Taking taking(all);
  for (std::size_t n = 0; n < wanted.numbers.size(); ++n) {
    const int number = wanted.numbers[n];
    const BitMask& mask = masks->at(stepNameOf(number));
    if (!wanted.areApart && !isOnlyNarrowed(wanted.steps, stepNameOf(number)))
      std::ranges::move(taking.steps(map, number, mask, std::span(wanted.numbers).subspan(n + 1)),
                        std::back_inserter(done));
    map = withMask(std::move(map), number, mask);
  }
  if (cancel.cancelled()) return Error{"Cancelled."};
  return withRecorded(std::move(map), done);
}

std::string withoutStepName(const std::string& why) { return why.substr(why.find(": ") + 2); }

std::string keptName(StepsWanted& wanted, const Volume& volume, const Mask& mask, const CancelToken& cancel) {
  if (mask.empty()) return {};
  const std::string kept = freeHelper(wanted.steps, "Kept");
  // Without cuts it is a step of a recipe.
  if (mask.lassos.empty()) {
    wanted.steps.push_back({"patient", kept});
  } else {
    wanted.steps.push_back({byHandStep, kept});
    wanted.given.emplace(kept, keptVoxels(volume, mask, cancel));
  }
  return kept;
}

StepsWanted keptIn(StepsWanted wanted, const std::vector<std::string>& names, const Volume& volume,
                   const Mask& mask, const CancelToken& cancel) {
  const std::string kept = keptName(wanted, volume, mask, cancel);
  if (kept.empty()) return wanted;
  for (const std::string& name : names) wanted.steps.push_back({"intersect", name, {{"other", kept}}});
  return wanted;
}

// After each step the next largest part is the second in size.
Result<StepsWanted> stepsOfSplit(SegmentMap& map, int number, double leastMl, const CancelToken& cancel) {
  const Segment whole = *findSegment(map, number);
  const std::string own = stepNameOf(number);
  const double voxels = leastMl * 1000 / map.labels->geometry().voxelVolume();
  const Parts parts(maskOf(*map.labels, std::uint8_t(number)), Neighbours::faces, cancel);
  StepsWanted wanted{{}, {}, true, {}};
  for (std::size_t n = 1; n < parts.count() && double(parts.size(n)) >= voxels - 1e-9; ++n) {
    const auto free = freeNumber(map);
    if (!free) return Error{"It has more parts than there can be segments: keep only larger ones."};
    Segment part = whole;
    part.number = *free;
    part.label = freeName(map, whole.label);
    part.colour.reset();
    part.trackingId.clear();
    part.trackingUid.clear();
    markEdited(part);
    map = withSegment(std::move(map), std::move(part));
    const std::string name = stepNameOf(*free);
    wanted.steps.push_back({"part", name, {{"other", own}}});
    wanted.steps.push_back({"subtract", own, {{"other", name}}});
    wanted.numbers.push_back(*free);
  }
  if (wanted.numbers.empty()) return Error{"It has no second part that is large enough."};
  map.current = number;
  return wanted;
}

}  // namespace volumen
