#include "results/segments/segment_record.h"

#include <algorithm>
#include <bitset>
#include <glm/common.hpp>

#include "viewer/recipe/step_kinds.h"
#include "viewer/recipe/step_names.h"
#include "viewer/volume/free_name.h"

namespace volumen {

namespace {

const std::string removedEnding = " removed";

// Returns whether a name is that of a present or removed segment.
bool isSegmentsName(const std::string& name) { return !name.empty() && name[0] >= '0' && name[0] <= '9'; }

bool hasSegment(const SegmentMap& map, int number) {
  return std::ranges::find(map.segments, number, &Segment::number) != map.segments.end();
}

std::set<std::string> stepNamesOf(const SegmentMap& map) {
  std::set<std::string> names;
  for (const Segment& segment : map.segments) names.insert(stepNameOf(segment.number));
  return names;
}

// Tracks segments step by step: which were made at all, and which by hand.
struct Making {
  std::set<std::string> made, byHand;

  bool isByHand(const std::string& name) const {
    return byHand.contains(name) || (isSegmentsName(name) && !made.contains(name));
  }
  /// Adds a step. Returns whether a recipe can do it.
  bool add(const Step& step) {
    const std::vector<std::string> needed = neededBy(step);
    const bool hand = step.kind == byHandStep ||
                      std::ranges::any_of(needed, [&](const std::string& name) { return isByHand(name); });
    for (const std::string& name : changedBy(step)) {
      made.insert(name);
      if (hand)
        byHand.insert(name);
      else
        byHand.erase(name);
    }
    return !hand;
  }
};

using LabelPairs = std::bitset<256 * 256>;

// Adds which labels became which in a brick.
void addLabelChanges(LabelPairs& pairs, const LabelMap::Brick& before, const LabelMap::Brick& after,
                     glm::ivec3 size) {
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const std::size_t n = std::size_t((k * LabelMap::edge + j) * LabelMap::edge + i);
        const std::size_t a = before.voxels ? (*before.voxels)[n] : before.label,
                          b = after.voxels ? (*after.voxels)[n] : after.label;
        if (a != b) pairs.set(256 * a + b);
      }
}

LabelPairs labelChangesOf(const LabelMap& before, const LabelMap& after) {
  LabelPairs pairs;
  const glm::ivec3 grid = before.geometry().size, bricks = before.bricks();
  for (int n = 0; n < bricks.x * bricks.y * bricks.z; ++n) {
    const LabelMap::Brick &a = before.brick(std::size_t(n)), &b = after.brick(std::size_t(n));
    if (a == b) continue;
    const glm::ivec3 at(n % bricks.x, n / bricks.x % bricks.y, n / bricks.x / bricks.y);
    addLabelChanges(pairs, a, b, glm::min(glm::ivec3(LabelMap::edge), grid - at * LabelMap::edge));
  }
  return pairs;
}

bool hasChanged(const LabelPairs& pairs, int number) {
  const auto own = std::size_t(number);
  for (std::size_t other = 0; other < 256; ++other)
    if (pairs[256 * other + own] || pairs[256 * own + other]) return true;
  return false;
}

// Returns whether the labels differ on the same grid.
bool haveOtherLabels(const SegmentMap& before, const SegmentMap& after) {
  return before.labels && after.labels && before.labels != after.labels &&
         before.labels->geometry() == after.labels->geometry();
}

// A segment that gained voxels or lost some to no segment was changed by hand. Others lost theirs to such
// segments.
std::vector<Step> stepsOfChanges(const LabelPairs& pairs, const SegmentMap& map) {
  std::vector<Step> byHand, losses;
  for (const Segment& segment : map.segments) {
    const std::string name = stepNameOf(segment.number);
    const auto own = std::size_t(segment.number);
    bool hand = false;
    std::vector<Step> lost;
    for (std::size_t other = 0; other < 256; ++other) {
      hand |= pairs[256 * other + own] || (pairs[256 * own + other] && !hasSegment(map, int(other)));
      if (pairs[256 * own + other]) lost.push_back({"subtract", name, {{"other", stepNameOf(int(other))}}});
    }
    if (hand)
      byHand.push_back({byHandStep, name});
    else
      std::ranges::move(lost, std::back_inserter(losses));
  }
  std::ranges::move(losses, std::back_inserter(byHand));
  return byHand;
}

// Notes in segments made by hand which step also computed their shape.
void nameComputing(SegmentMap& map, const Making& making, const Step& step) {
  const auto kinds = stepsOfShape();
  const auto kind = std::ranges::find_if(kinds, [&](const StepKind& k) { return k.name == step.kind; });
  if (kind == kinds.end()) return;
  for (const std::string& name : changedBy(step))
    for (Segment& segment : map.segments) {
      if (stepNameOf(segment.number) != name || !making.isByHand(name) ||
          segment.algorithmType > SegmentAlgorithm::manual)
        continue;
      segment.algorithmType = SegmentAlgorithm::semiautomatic;
      segment.algorithm = kind->title;
    }
}

// Returns a free name, which is taken from then on.
std::string takenName(std::set<std::string>& taken, const std::string& wanted) {
  return freeName(wanted, [&](const std::string& name) { return !taken.insert(name).second; });
}

// Returns the properties of a segment that recipes hold.
Segment describedSegment(const Segment& segment, const std::string& name, int number) {
  Segment made;
  made.number = number;
  made.label = name;
  made.description = segment.description;
  made.category = segment.category;
  made.type = segment.type;
  made.modifier = segment.modifier;
  made.colour = segment.colour;
  return made;
}

}  // namespace

std::string stepNameOf(int number) { return std::to_string(number); }

std::string helperNameOf(const std::string& wanted) { return isSegmentsName(wanted) ? "_" + wanted : wanted; }

SegmentMap withRecorded(SegmentMap map, const std::vector<Step>& steps) {
  std::vector<Step> all = map.steps;
  for (const Step& step : steps) all.push_back(withoutDefaults(step));
  Making making;
  std::erase_if(all, [&](const Step& step) { return !making.add(step); });
  const std::set<std::string> names = stepNamesOf(map);
  for (const std::string& name : names)
    if (making.byHand.contains(name)) all.push_back({byHandStep, name});
  for (const Step& step : steps) nameComputing(map, making, step);
  map.steps = stepsBehind(all, names);
  if (map.steps.size() > mostSteps) map.steps.clear();  // more than a recipe can have
  return map;
}

SegmentMap withHandMade(const SegmentMap& before, SegmentMap after) {
  if (!haveOtherLabels(before, after) || before.steps != after.steps) return after;
  const std::vector<Step> steps = stepsOfChanges(labelChangesOf(*before.labels, *after.labels), after);
  return steps.empty() ? after : withRecorded(std::move(after), steps);
}

SegmentMap withLetGo(const SegmentMap& before, SegmentMap after) {
  if (!haveOtherLabels(before, after)) return after;
  const auto isBound = [&](const Segment& segment) {
    const auto was = std::ranges::find(before.segments, segment.number, &Segment::number);
    return segment.span && was != before.segments.end() && was->span == segment.span &&
           was->range == segment.range;
  };
  if (std::ranges::none_of(after.segments, isBound)) return after;
  const LabelPairs pairs = labelChangesOf(*before.labels, *after.labels);
  for (Segment& segment : after.segments)
    if (isBound(segment) && hasChanged(pairs, segment.number)) segment.span.reset();
  return after;
}

SegmentMap withEditedMarked(const SegmentMap& before, SegmentMap after) {
  if (!haveOtherLabels(before, after)) return after;
  const auto isAsSaid = [&](const Segment& segment) {
    const auto was = std::ranges::find(before.segments, segment.number, &Segment::number);
    return segment.algorithmType != SegmentAlgorithm::unsaid && was != before.segments.end() &&
           was->algorithmType == segment.algorithmType && was->algorithm == segment.algorithm;
  };
  if (std::ranges::none_of(after.segments, isAsSaid)) return after;
  const LabelPairs pairs = labelChangesOf(*before.labels, *after.labels);
  for (Segment& segment : after.segments)
    if (isAsSaid(segment) && hasChanged(pairs, segment.number)) markEdited(segment);
  return after;
}

Segment withStepsNamed(Segment segment, const SegmentMap& map) {
  const std::vector<Step> steps = stepsBehind(map.steps, {stepNameOf(segment.number)});
  if (segment.algorithmType != SegmentAlgorithm::unsaid || segment.range || steps.empty() ||
      !isMadeBySteps(map, segment.number))
    return segment;
  segment.algorithmType = SegmentAlgorithm::semiautomatic;
  for (const Step& step : steps)
    if (const StepKind* const kind = stepKind(step.kind))
      segment.algorithm.append(segment.algorithm.empty() ? "" : ", ").append(kind->title);
  return segment;
}

std::vector<Step> stepsWithout(const SegmentMap& map, int number) {
  const std::string name = stepNameOf(number);
  std::set<std::string> taken, left = stepNamesOf(map);
  for (const Step& step : map.steps) taken.insert(step.segment);
  const std::string removed = takenName(taken, name + removedEnding);
  std::vector<Step> steps;
  for (const Step& step : map.steps)
    steps.push_back(renamed(step, [&](const std::string& one) { return one == name ? removed : one; }));
  left.erase(name);
  return stepsBehind(steps, left);
}

bool isMadeBySteps(const SegmentMap& map, int number) {
  Making making;
  for (const Step& step : map.steps) making.add(step);
  return !making.isByHand(stepNameOf(number));
}

std::vector<Step> stepsTaken(const SegmentMap& from, int number, const SegmentMap& to, int as) {
  const std::string own = stepNameOf(number);
  const std::set<std::string> ofSegments = stepNamesOf(from);
  std::set<std::string> taken = stepNamesOf(to);
  for (const Step& step : to.steps) taken.insert(step.segment);
  std::map<std::string, std::string> names{{own, stepNameOf(as)}};
  std::vector<Step> steps;
  for (const Step& step : stepsBehind(from.steps, {own}))
    steps.push_back(renamed(step, [&](const std::string& one) {
      const auto known = names.find(one);
      if (known != names.end()) return known->second;
      return names[one] = takenName(taken, ofSegments.contains(one) ? one + removedEnding : one);
    }));
  return steps;
}

std::set<std::string> madeByHand(const std::vector<Step>& steps) {
  Making making;
  for (const Step& step : steps) making.add(step);
  return making.byHand;
}

std::map<int, std::string> namesInRecipe(const SegmentMap& map) {
  std::set<std::string> taken;
  std::map<int, std::string> names;
  for (const Segment& segment : map.segments)
    names[segment.number] = takenName(taken, segment.label.empty() ? "Segment" : segment.label);
  return names;
}

RecordedRecipe recordedRecipe(const SegmentMap& map, const std::string& modality) {
  RecordedRecipe recorded;
  recorded.recipe.name = "Steps";
  if (!modality.empty()) recorded.recipe.modalities = {modality};
  Making making;
  for (const Step& step : map.steps) making.add(step);
  std::map<std::string, std::string> names;
  std::set<std::string> taken, kept;
  for (const auto& [number, name] : namesInRecipe(map)) {
    names[stepNameOf(number)] = name;
    taken.insert(name);
  }
  for (const Segment& segment : map.segments) {
    const std::string key = stepNameOf(segment.number), &name = names[key];
    if (making.isByHand(key)) {
      recorded.missing.push_back(name);
      continue;
    }
    kept.insert(key);
    std::vector<Segment>& segments = recorded.recipe.segments;
    segments.push_back(describedSegment(segment, name, int(segments.size()) + 1));
  }
  for (const Step& step : stepsBehind(map.steps, kept))
    recorded.recipe.steps.push_back(renamed(step, [&](const std::string& one) {
      const auto known = names.find(one);
      return known != names.end() ? known->second : names[one] = takenName(taken, one);
    }));
  return recorded;
}

}  // namespace volumen
