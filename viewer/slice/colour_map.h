#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "viewer/slice/grey.h"

namespace volumen {

/// What grey in 0..1 is shown as. Hot iron and PET run through the corners of the palettes of these names in
/// PS3.6 B.1, linear between them (within 3/255 of their entries); rainbow goes from blue through green to
/// red.
enum class ColourMap { grey, hotIron, pet, rainbow };

/// A map's word for files: "hotIron"; and the map of a word.
const char* colourMapName(ColourMap map);
std::optional<ColourMap> colourMapNamed(std::string_view name);
/// All of them, in the order of menus.
std::span<const ColourMap> colourMaps();

/// The colours of grey 0/255 to 255/255: 0xffRRGGBB.
using ColourTable = std::array<std::uint32_t, 256>;
const ColourTable& colourTable(ColourMap map);

/// Lays values over pixels of 0xffRRGGBB, as many of each. How much is seen of a value is `opacity`, but it
/// fades in over the lowest quarter of its window; NaN is not seen.
void layOver(std::span<std::uint32_t> pixels, std::span<const float> values, const GreyMapping& grey,
             ColourMap map, double opacity);

}  // namespace volumen
