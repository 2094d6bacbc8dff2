#pragma once

#include <vector>

#include "viewer/plan/plan.h"

namespace volumen {

/// Input of a rule: the completed scene, the options, the volume's facts and the pilot's result.
struct RuleInput {
  const Scene& scene;
  const VolumeFacts& facts;
  const RenderOptions& options;
  const std::optional<PilotFinding>& pilot;
};

/// A rule decides one effect: it sets its fields of the plan and returns the line for --explain. Rules run in
/// the order of the table, and later rules may read earlier decisions. `cost`, if present, appends the cost
/// model's prediction once everything is decided. A sound rule leaves out only exact zeros and turns itself
/// off (everything on) with `options.full`.
struct Rule {
  const char* name;
  bool sound;
  Effect (*decide)(const RuleInput&, Plan&);
  std::string (*cost)(const RuleInput&, const Plan&) = nullptr;
};

const std::vector<Rule>& rules();

}  // namespace volumen
