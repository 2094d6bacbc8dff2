#pragma once

#include <map>
#include <span>
#include <string>

#include "ui/controller/segment_jobs.h"
#include "viewer/recipe/step_kinds.h"

namespace volumen {

/// The kinds of steps that are offered on the current segment, in the order of a list: those of recipes but
/// for what is clicked, painted or grown from seeds, those that change it first; and two that are several
/// steps: "split" makes its parts segments, "merge" takes another segment in, which goes.
std::span<const StepKind> offeredSteps();
/// One of these by its name, which it must be.
const StepKind& offeredStep(const std::string& name);

/// The fields of a step that are chosen by people; others are filled as it is done: places, lists of
/// segments.
bool isChosen(const StepField& field);

/// The work that does such a step to the current segment, what the mask takes away being in none that is made
/// of values. Fields name segments as steps do (segment_record.h); those left out are as their row says.
SegmentWork workOf(const StepKind& kind, const std::map<std::string, StepValue>& fields,
                   const Session& session);

}  // namespace volumen
