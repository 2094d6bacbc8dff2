#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace volumen {

/// Returns outlines along the edges of the set pixels (1; others 0) of a picture, first row on top: one for
/// each part whose pixels share edges. Pixel (x, y) has the corners (x, y) and (x + 1, y + 1). Holes are
/// joined to their part by a channel of no width (keyhole). Filled by even-odd or non-zero winding, the
/// outlines enclose exactly the set pixels. An outline has a point wherever it turns; two
/// neighbouring points are never equal.
std::vector<std::vector<glm::ivec2>> pixelOutlines(std::span<const std::uint8_t> pixels, glm::ivec2 size);

/// Closed outlines in pixels, where integers are centres.
using Outlines = std::vector<std::vector<glm::dvec2>>;

/// Returns the pixels whose centres lie inside an odd number of outlines, one byte a pixel; empty if the
/// outlines cross too many rows (2^24 crossings).
std::vector<std::uint8_t> filledEvenOdd(const Outlines& outlines, glm::ivec2 size);

/// Returns the area inside an odd number of outlines in pixels, by at least 8 lines a pixel, at most 8192 in
/// all: exact for pixelOutlines(). 0 if they cross too many lines.
double evenOddArea(const Outlines& outlines);

}  // namespace volumen
