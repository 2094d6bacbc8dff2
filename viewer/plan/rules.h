#pragma once

#include <vector>

#include "viewer/plan/plan.h"

namespace volumen {

/// What a rule sees: the completed scene and what was asked, with the facts of the volume and what a pilot
/// found.
struct RuleInput {
  const Scene& scene;
  const VolumeFacts& facts;
  const RenderOptions& options;
  const std::optional<PilotFinding>& pilot;
};

/// A rule decides one effect: sets its fields of the plan and returns the line that says so. Rules run in the
/// order of the table; a later one may read what an earlier one decided. `cost`, where there is one, adds to
/// the line what the cost model says once all is decided. A sound rule leaves out only what contributes
/// exactly nothing, and switches itself off (everything on) where `options.full` is set.
struct Rule {
  const char* name;
  bool sound;
  Effect (*decide)(const RuleInput&, Plan&);
  std::string (*cost)(const RuleInput&, const Plan&) = nullptr;
};

const std::vector<Rule>& rules();

}  // namespace volumen
