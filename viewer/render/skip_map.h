#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace volumen {

/// How far each block is from the nearest one that holds a visible value: 0 there, else the chessboard
/// distance in blocks, at most 255. A ray in a block at distance d may leap to the end of the (2d - 1)^3
/// blocks around it.
struct SkipMap {
  glm::ivec3 count{0};
  std::vector<std::uint8_t> distance;  ///< i fastest, with 4 readable bytes behind the last
};

SkipMap makeSkipMap(glm::ivec3 count, const std::vector<std::uint8_t>& visible);

}  // namespace volumen
