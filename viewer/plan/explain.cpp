#include <nlohmann/json.hpp>

#include "viewer/plan/plan.h"

namespace volumen {

std::string explain(const Plan& plan) {
  std::string text;
  for (const Effect& e : plan.effects) text += (e.on ? "on   " : "off  ") + e.name + ": " + e.reason + "\n";
  return text;
}

std::string explainJson(const Plan& plan) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const Effect& e : plan.effects)
    out.push_back({{"effect", e.name}, {"on", e.on}, {"sound", e.sound}, {"reason", e.reason}});
  return out.dump();
}

}  // namespace volumen
