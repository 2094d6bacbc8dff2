#pragma once

#include <nlohmann/json.hpp>

#include "viewer/segment/code.h"

namespace volumen {

/// Returns value, scheme and meaning of a code; null if it has no value.
inline nlohmann::ordered_json codeJson(const Code& code) {
  if (code.value.empty()) return {};
  return {{"value", code.value}, {"scheme", code.scheme}, {"meaning", code.meaning}};
}

}  // namespace volumen
