#pragma once

#include <map>
#include <span>
#include <string>

#include "ui/controller/segment_jobs.h"
#include "viewer/recipe/step_kinds.h"

namespace volumen {

/// Returns the steps offered for the current segment, in the order of a list; those that change it come
/// first. They are the recipe steps except those that need clicks, painting or seeds. Two more consist of
/// several steps: "split" turns parts into segments, "merge" adds another segment and removes it.
std::span<const StepKind> offeredSteps();
/// Returns the offered step with this name, which must exist.
const StepKind& offeredStep(const std::string& name);

/// Returns whether the user chooses a field of a step. Other fields, such as points and lists of segments,
/// are filled in when the step runs.
bool isChosen(const StepField& field);

/// Returns the work that applies such a step to the current segment. Steps that segment by values leave out
/// masked voxels. Fields name segments as steps do (segment_record.h); missing fields have the defaults of
/// their rows.
SegmentWork workOf(const StepKind& kind, const std::map<std::string, StepValue>& fields,
                   const Session& session);

}  // namespace volumen
