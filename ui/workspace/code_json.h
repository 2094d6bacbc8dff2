#pragma once

#include <nlohmann/json.hpp>

#include "viewer/segment/code.h"

namespace volumen {

/// Its three texts; null where there is none.
inline nlohmann::ordered_json codeJson(const Code& code) {
  if (code.value.empty()) return {};
  return {{"value", code.value}, {"scheme", code.scheme}, {"meaning", code.meaning}};
}

}  // namespace volumen
