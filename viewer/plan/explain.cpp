#include <cassert>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "viewer/plan/effect_cost.h"

namespace volumen {

namespace {

std::string msText(double ms) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f ms", ms < 9.95 && ms != 0 ? 1 : 0, ms);
  return text;
}

std::string lineOf(const Effect& e) { return (e.on ? "on   " : "off  ") + e.name + ": " + e.reason; }

nlohmann::ordered_json jsonOf(const Effect& e) {
  return {{"effect", e.name}, {"on", e.on}, {"sound", e.sound}, {"reason", e.reason}};
}

}  // namespace

std::string costText(const EffectCost& cost) {
  const std::string often = std::string(cost.ms < 0 ? "saves up to " : "") +
                            (cost.estimated ? "about " : "") + msText(std::abs(cost.ms));
  return cost.onceMs > 0 ? often + ", once " + msText(cost.onceMs) : often;
}

std::string explain(const Plan& plan) {
  std::string text;
  for (const Effect& e : plan.effects) text += lineOf(e) + "\n";
  return text;
}

std::string explain(const Plan& plan, const EffectCosts& costs) {
  assert(costs.size() == plan.effects.size());
  std::string text;
  for (std::size_t n = 0; n < costs.size(); ++n)
    text += lineOf(plan.effects[n]) + (costs[n] ? " (" + costText(*costs[n]) + ")\n" : "\n");
  return text;
}

std::string explainJson(const Plan& plan) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const Effect& e : plan.effects) out.push_back(jsonOf(e));
  return out.dump();
}

std::string explainJson(const Plan& plan, const EffectCosts& costs) {
  assert(costs.size() == plan.effects.size());
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (std::size_t n = 0; n < costs.size(); ++n) {
    nlohmann::ordered_json effect = jsonOf(plan.effects[n]);
    effect["costMs"] = nullptr;
    if (costs[n]) {
      effect["costMs"] = costs[n]->ms;
      effect["costEstimated"] = costs[n]->estimated;
      if (costs[n]->onceMs > 0) effect["onceMs"] = costs[n]->onceMs;
    }
    out.push_back(std::move(effect));
  }
  return out.dump();
}

}  // namespace volumen
