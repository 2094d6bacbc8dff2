#pragma once

#include <span>
#include <string>

namespace volumen {

/// The first of several, and how many there are besides: "Bone, Skin and 7 more".
std::string listedFirst(std::span<const std::string> names, std::size_t most = 5);

}  // namespace volumen
