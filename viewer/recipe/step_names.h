#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "viewer/recipe/recipe.h"

namespace volumen {

struct StepField;

// Segments that steps read and change. A step of an unknown kind is about its own segment only.

/// Returns the segments that a step changes, its own first.
std::vector<std::string> changedBy(const Step& step);
/// Returns the segments that a step needs as they were before: those its fields name, and all it changes
/// without making them anew.
std::vector<std::string> neededBy(const Step& step);
/// Return whether a step can only make its segment smaller, keeps an empty one empty, or makes it anew.
bool onlyNarrows(const Step& step);
bool leavesEmpty(const Step& step);
bool makesAnew(const Step& step);
/// Returns whether a field is a voxel value of the series.
bool isOfValues(const StepField& field);
/// Returns whether a step compares with a voxel value. A lesion by a value may rely on its default.
bool namesValue(const Step& step);
/// Returns whether its value range ("low", "high") is reversed.
bool isRangeReversed(const Step& step);

/// Returns the step with segments renamed.
Step renamed(Step step, const std::function<std::string(const std::string&)>& name);
/// Returns the step without fields at their default.
Step withoutDefaults(Step step);

/// Returns the steps that these segments depend on.
std::vector<Step> stepsBehind(const std::vector<Step>& steps, std::set<std::string> segments);

}  // namespace volumen
