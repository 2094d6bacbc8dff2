#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "viewer/recipe/recipe.h"

namespace volumen {

struct StepField;

// Which segments steps are about. A step of an unknown kind is about its own alone.

/// The segments that a step changes, its own first.
std::vector<std::string> changedBy(const Step& step);
/// The segments that it needs as they were before: those that its fields name, and all that it changes where
/// it does not make them.
std::vector<std::string> neededBy(const Step& step);
/// Whether it can only make its segment smaller; whether it leaves an empty one empty; whether it makes it,
/// whatever it was.
bool onlyNarrows(const Step& step);
bool leavesEmpty(const Step& step);
bool makesAnew(const Step& step);
/// Whether a field is a value of the series.
bool isOfValues(const StepField& field);
/// Whether a step compares with a value of its own; a lesion by a value may leave it out.
bool namesValue(const Step& step);
/// Whether its range of values ("low", "high") ends below where it begins.
bool isRangeReversed(const Step& step);

/// With other names of segments.
Step renamed(Step step, const std::function<std::string(const std::string&)>& name);
/// Without the fields that are as their row says.
Step withoutDefaults(Step step);

/// Those of the steps that these segments come from.
std::vector<Step> stepsBehind(const std::vector<Step>& steps, std::set<std::string> segments);

}  // namespace volumen
