#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "results/segments/segment_map.h"

namespace volumen {

// A map keeps how its segments were made, as steps of a recipe (SegmentMap::steps). Steps call a segment by
// its number, "3". Helpers have other names; a removed segment that others come from is "3 removed". A
// segment that no recorded steps make has one step "byHand", or none.

/// Returns the name that steps use for the segment with a number.
std::string stepNameOf(int number);
/// Returns a name like `wanted` for a helper: one that no present or removed segment has.
std::string helperNameOf(const std::string& wanted);

/// Appends the steps that led to the map's labels. Drops steps that no segment comes from any more.
SegmentMap withRecorded(SegmentMap map, const std::vector<Step>& steps);
/// Returns `after`, made from `before`. If labels changed and no step says how, the changed segments count as
/// made by hand.
SegmentMap withHandMade(const SegmentMap& before, SegmentMap after);
/// Returns `after`, made from `before`. Segments no longer follow the transfer function if their voxels
/// changed but their range did not: they were changed by hand.
SegmentMap withLetGo(const SegmentMap& before, SegmentMap after);
/// Returns `after`, made from `before`. Segments whose voxels changed, but not what is said of how they were
/// made, are marked as edited (markEdited()).
SegmentMap withEditedMarked(const SegmentMap& before, SegmentMap after);
/// Returns the segment as written to files. If steps made it and nothing says how, names the steps.
Segment withStepsNamed(Segment segment, const SegmentMap& map);
/// Returns the steps after removal of the segment with this number.
std::vector<Step> stepsWithout(const SegmentMap& map, int number);
/// Returns whether steps alone make a segment.
bool isMadeBySteps(const SegmentMap& map, int number);
/// Returns the steps that make a segment of `from`, for `to`, in which its number is `as`. Helpers get names
/// that are free there.
std::vector<Step> stepsTaken(const SegmentMap& from, int number, const SegmentMap& to, int as);

/// Returns the names that a recipe of these steps cannot make, because they come from segments that were
/// there before.
std::set<std::string> madeByHand(const std::vector<Step>& steps);

/// The record of a map as a recipe that makes the same voxels, and the names of segments that no steps make.
/// The recipe has no segments if that holds for all.
struct RecordedRecipe {
  Recipe recipe;
  std::vector<std::string> missing;
};
RecordedRecipe recordedRecipe(const SegmentMap& map, const std::string& modality);
/// Returns the names of segments in that recipe by number: their own, or with a number behind them.
std::map<int, std::string> namesInRecipe(const SegmentMap& map);

}  // namespace volumen
