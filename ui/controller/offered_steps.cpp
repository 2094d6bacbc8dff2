#include "ui/controller/offered_steps.h"

#include <algorithm>

#include "results/segments/segment_record.h"
#include "results/segments/segments.h"
#include "results/text/text.h"
#include "ui/controller/segment_target.h"
#include "viewer/recipe/step_names.h"

namespace volumen {

namespace {

using StepPlaces = std::vector<glm::dvec3>;
using ChosenFields = std::map<std::string, StepValue>;

// Steps that grow segments have their own page.
bool isOffered(const StepKind& kind) {
  const std::string_view name = kind.name;
  return name != byHandStep && name != growFromSeedsStep &&
         std::ranges::none_of(kind.fields, [](const StepField& field) {
           return field.need == StepField::Need::yes && std::holds_alternative<StepPlaces>(field.byDefault);
         });
}

// Offers that consist of several steps.
std::vector<StepKind> severalSteps() {
  using enum StepKind::Use;
  return {{"merge",
           "Merge",
           "with all voxels of another segment, which goes",
           {{"other", "Other segment", "", std::string(), {}, {}, StepField::Need::yes}},
           changes,
           nullptr},
          {"split",
           "Split into parts",
           "its largest part and all that is smaller than this; other parts become segments",
           {{"leastMl", "Smaller than", "ml", 0.0, {0, 1e6}}},
           changes,
           nullptr}};
}

const Segment* otherIn(const SegmentMap& map, const std::string& name) {
  const auto found = std::ranges::find_if(
      map.segments, [&](const Segment& segment) { return stepNameOf(segment.number) == name; });
  return found == map.segments.end() ? nullptr : &*found;
}

// An Error means that a segment the step names no longer exists.
Status checkOthers(const Step& step, const SegmentMap& map) {
  for (const std::string& name : neededBy(step))
    if (!otherIn(map, name)) return Error{"The other segment is not there any more."};
  return {};
}

// Runs a step on all segments at once; it receives the names of locked and unlocked ones.
StepsWanted jointly(Step step, const SegmentMap& map, int number) {
  std::vector<std::string> with, locked;
  StepsWanted wanted{{}, {number}, true, {}};
  for (const Segment& segment : map.segments) {
    if (segment.number == number) continue;
    (segment.locked ? locked : with).push_back(stepNameOf(segment.number));
    if (!segment.locked) wanted.numbers.push_back(segment.number);
  }
  step.fields["with"] = with;
  step.fields["locked"] = locked;
  wanted.steps = {std::move(step)};
  return wanted;
}

Result<StepsWanted> offeredStepsOf(const StepKind& kind, const ChosenFields& fields, const SegmentMap& map,
                                   int number, const Volume& volume, const Mask& mask,
                                   const CancelToken& cancel) {
  Step step{kind.name, stepNameOf(number), fields};
  if (Status s = checkOthers(step, map); !s) return s.error();
  if (kind.runAll) return jointly(std::move(step), map, number);
  StepsWanted wanted{{step}, {number}, false, {}};
  // A step that uses another segment does not segment by values.
  const bool isOfValues = makesAnew(step) && neededBy(step).empty();
  return isOfValues ? keptIn(std::move(wanted), {step.segment}, volume, mask, cancel) : wanted;
}

// An Error means that the segment was removed or locked since it was chosen.
Status checkFree(const SegmentMap& map, int number) {
  const Segment* segment = findSegment(map, number);
  if (!segment) return Error{"The segment is not there any more."};
  if (segment->locked) return Error{segment->label + " is locked: unlock it first."};
  return {};
}

Result<SegmentMap> mergedSegments(SegmentMap map, int number, const std::string& name, const Volume& volume,
                                  const CancelToken& cancel) {
  const Segment* other = otherIn(map, name);
  if (!other) return Error{"The other segment is not there any more."};
  for (const int changed : {number, other->number})
    if (Status s = checkFree(map, changed); !s) return s.error();
  const int gone = other->number;
  Result<SegmentMap> made = withStepsDone(
      std::move(map), {{{"add", stepNameOf(number), {{"other", name}}}}, {number}}, volume, cancel);
  if (!made) return made;
  SegmentMap left = withoutSegment(std::move(*made), gone);
  left.current = number;
  return left;
}

Result<SegmentMap> splitSegment(SegmentMap map, int number, double leastMl, const Volume& volume,
                                const CancelToken& cancel) {
  if (Status s = checkFree(map, number); !s) return s.error();
  const Result<StepsWanted> wanted = stepsOfSplit(map, number, leastMl, cancel);
  return wanted ? withStepsDone(std::move(map), *wanted, volume, cancel) : Result<SegmentMap>(wanted.error());
}

double chosenNumber(const StepKind& kind, const ChosenFields& fields, const char* name) {
  const auto given = fields.find(name);
  if (given != fields.end()) return std::get<double>(given->second);
  return std::get<double>(
      std::ranges::find(kind.fields, std::string_view(name), &StepField::name)->byDefault);
}

}  // namespace

std::span<const StepKind> offeredSteps() {
  static const std::vector<StepKind> all = [] {
    std::vector<StepKind> rows = severalSteps();
    std::ranges::copy_if(stepKinds(), std::back_inserter(rows), isOffered);
    std::stable_partition(rows.begin(), rows.end(),
                          [](const StepKind& k) { return k.use != StepKind::Use::makes; });
    return rows;
  }();
  return all;
}

const StepKind& offeredStep(const std::string& name) {
  return *std::ranges::find_if(offeredSteps(), [&](const StepKind& kind) { return kind.name == name; });
}

bool isChosen(const StepField& field) {
  return !std::holds_alternative<StepPlaces>(field.byDefault) &&
         !std::holds_alternative<std::vector<std::string>>(field.byDefault);
}

SegmentWork workOf(const StepKind& kind, const ChosenFields& fields, const Session& session) {
  SegmentWork work = workShown(session, tr(kind.title), tr(kind.title));
  work.number = segmentShown(session)->number;
  const VolumePtr volume = work.volume;
  const std::string name = kind.name;
  if (name == "merge")
    work.makeAll = [number = work.number, other = std::get<std::string>(fields.at("other")), volume](
                       const SegmentMap& map, const CancelToken& cancel) {
      return mergedSegments(map, number, other, *volume, cancel);
    };
  else if (name == "split")
    work.makeAll = [number = work.number, least = chosenNumber(kind, fields, "leastMl"), volume](
                       const SegmentMap& map, const CancelToken& cancel) {
      return splitSegment(map, number, least, *volume, cancel);
    };
  else
    work.steps = [&kind, fields, volume, mask = session.maskOf(work.series)](
                     const SegmentMap& map, int number, const CancelToken& cancel) {
      return offeredStepsOf(kind, fields, map, number, *volume, mask, cancel);
    };
  return work;
}

}  // namespace volumen
