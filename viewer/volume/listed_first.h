#pragma once

#include <span>
#include <string>

namespace volumen {

/// Returns the first `most` names and the number of others: "Bone, Skin and 7 more".
std::string listedFirst(std::span<const std::string> names, std::size_t most = 5);

}  // namespace volumen
