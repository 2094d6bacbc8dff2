#pragma once

#include <string>
#include <utility>
#include <vector>

#include "viewer/plan/plan.h"

namespace volumen {

/// What a PNG says of itself (DESIGN 10): program, method, level or step, promised error, scene; key and
/// value.
std::vector<std::pair<std::string, std::string>> pictureText(const Plan& plan);

/// "draft", "standard", "high", "exact".
const char* qualityName(Quality quality);
/// "planes", "blend", "preshaded", "gpu", "reference".
const char* methodName(Method method);

}  // namespace volumen
