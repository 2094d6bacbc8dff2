#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "ui/workspace/segment_map.h"

namespace volumen {

// How the segments of a map were made is kept with it as steps of a recipe (SegmentMap::steps), which call a
// segment by its number, "3". What helped on the way has other names; so has what was removed and others
// come from: "3 removed". A segment that something made which no step can say has one step "byHand", or none.

/// What steps call the segment of a number.
std::string stepNameOf(int number);
/// The like of `wanted` for what helps on the way: no name of a segment that is or was there.
std::string helperNameOf(const std::string& wanted);

/// With more steps behind what led to it, its labels being what they came to. What no segment comes from any
/// more is left out.
SegmentMap withRecorded(SegmentMap map, const std::vector<Step>& steps);
/// `after`, which was made of `before`: where labels were changed and no step says how, the segments that
/// they were changed of count as made by hand.
SegmentMap withHandMade(const SegmentMap& before, SegmentMap after);
/// `after`, which was made of `before`: segments that follow the curve and whose voxels changed, though their
/// range did not, follow it no more: they were changed by hand.
SegmentMap withLetGo(const SegmentMap& before, SegmentMap after);
/// `after`, which was made of `before`: segments whose voxels changed, and of which nothing else is said by
/// now how they were made, are marked as edited (markEdited()).
SegmentMap withEditedMarked(const SegmentMap& before, SegmentMap after);
/// The segment as files have it: where nothing says how it was made, and steps did, by these.
Segment withStepsNamed(Segment segment, const SegmentMap& map);
/// The steps, where the segment of a number is there no more.
std::vector<Step> stepsWithout(const SegmentMap& map, int number);
/// Whether steps alone make a segment of a map.
bool isMadeBySteps(const SegmentMap& map, int number);
/// Those that make a segment of one map, as another one has them, in which it has the number `as`: what helps
/// on the way has names that are free there.
std::vector<Step> stepsTaken(const SegmentMap& from, int number, const SegmentMap& to, int as);

/// What of these steps, which were done on segments that were there before, no recipe can make again: names.
std::set<std::string> madeByHand(const std::vector<Step>& steps);

/// The record of a map as a recipe, which makes the same voxels, and the segments (their names) that are not
/// in it, since no steps make them. Without segments where that is all of them.
struct RecordedRecipe {
  Recipe recipe;
  std::vector<std::string> missing;
};
RecordedRecipe recordedRecipe(const SegmentMap& map, const std::string& modality);
/// What that calls the segments, by their numbers: their names, or with a number behind them.
std::map<int, std::string> namesInRecipe(const SegmentMap& map);

}  // namespace volumen
