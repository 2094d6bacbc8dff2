#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "viewer/slice/grey.h"

namespace volumen {

/// Palette for grey values in 0..1. Hot iron and PET are piecewise linear through the corners of the PS3.6
/// B.1 palettes, within 3/255 of their entries. Rainbow goes from blue through green to red.
enum class ColourMap { grey, hotIron, pet, rainbow };

/// Name of a map in files ("hotIron"), and the map of a name.
const char* colourMapName(ColourMap map);
std::optional<ColourMap> colourMapNamed(std::string_view name);
/// Returns all maps in menu order.
std::span<const ColourMap> colourMaps();

/// Colours of grey 0/255 to 255/255, as 0xffRRGGBB.
using ColourTable = std::array<std::uint32_t, 256>;
const ColourTable& colourTable(ColourMap map);

/// Blends values over pixels (0xffRRGGBB) of the same count. Values have opacity `opacity`, which fades in
/// over the lowest quarter of their window; NaN is transparent.
void layOver(std::span<std::uint32_t> pixels, std::span<const float> values, const GreyMapping& grey,
             ColourMap map, double opacity);

}  // namespace volumen
