#include "viewer/recipe/step_names.h"

#include <algorithm>
#include <string_view>

#include "viewer/recipe/step_kinds.h"

namespace volumen {

namespace {

// Visits the segment names in the fields of a step.
template <class Visit>
void forEachName(Step& step, const Visit& visit) {
  const StepKind* const kind = stepKind(step.kind);
  if (!kind) return;
  for (const StepField& field : kind->fields) {
    const auto given = step.fields.find(field.name);
    if (given == step.fields.end()) continue;
    if (auto* names = std::get_if<std::vector<std::string>>(&given->second))
      std::ranges::for_each(*names, visit);
    else if (auto* name = std::get_if<std::string>(&given->second);
             name && field.words.empty() && !name->empty())
      visit(*name);
  }
}

}  // namespace

std::vector<std::string> changedBy(const Step& step) {
  std::vector<std::string> changed{step.segment};
  const StepKind* const kind = stepKind(step.kind);
  if (!kind || !kind->runAll) return changed;
  if (const auto with = step.fields.find("with"); with != step.fields.end())
    for (const std::string& name : std::get<std::vector<std::string>>(with->second)) changed.push_back(name);
  return changed;
}

std::vector<std::string> neededBy(const Step& step) {
  std::vector<std::string> needed;
  if (!makesAnew(step)) needed = changedBy(step);
  Step copy = step;
  forEachName(copy, [&](const std::string& name) { needed.push_back(name); });
  return needed;
}

bool onlyNarrows(const Step& step) {
  const StepKind* const kind = stepKind(step.kind);
  return kind && kind->use == StepKind::Use::narrows;
}

bool leavesEmpty(const Step& step) {
  const StepKind* const kind = stepKind(step.kind);
  return kind && (kind->use == StepKind::Use::reshapes || kind->use == StepKind::Use::narrows);
}

bool makesAnew(const Step& step) {
  const StepKind* const kind = stepKind(step.kind);
  return kind && kind->use == StepKind::Use::makes;
}

bool isOfValues(const StepField& field) { return std::string_view(field.unit) == "value"; }

bool namesValue(const Step& step) {
  const StepKind* const kind = stepKind(step.kind);
  return kind && std::ranges::any_of(kind->fields, [&](const StepField& field) {
           const auto given = step.fields.find(field.name);
           if (given == step.fields.end()) return false;
           return isOfValues(field) ||
                  (!field.words.empty() && given->second == StepValue(std::string("value")));
         });
}

bool isRangeReversed(const Step& step) {
  const auto low = step.fields.find("low"), high = step.fields.find("high");
  return low != step.fields.end() && high != step.fields.end() &&
         std::get<double>(low->second) > std::get<double>(high->second);
}

Step renamed(Step step, const std::function<std::string(const std::string&)>& name) {
  step.segment = name(step.segment);
  forEachName(step, [&](std::string& one) { one = name(one); });
  return step;
}

Step withoutDefaults(Step step) {
  if (const StepKind* const kind = stepKind(step.kind))
    for (const StepField& field : kind->fields)
      if (const auto given = step.fields.find(field.name);
          given != step.fields.end() && given->second == field.byDefault)
        step.fields.erase(given);
  return step;
}

std::vector<Step> stepsBehind(const std::vector<Step>& steps, std::set<std::string> segments) {
  std::vector<Step> behind;
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    const std::vector<std::string> changed = changedBy(*step);
    if (std::ranges::none_of(changed, [&](const std::string& name) { return segments.contains(name); }))
      continue;
    if (makesAnew(*step)) segments.erase(step->segment);
    for (std::string& name : neededBy(*step)) segments.insert(std::move(name));
    behind.push_back(*step);
  }
  std::ranges::reverse(behind);
  return behind;
}

}  // namespace volumen
