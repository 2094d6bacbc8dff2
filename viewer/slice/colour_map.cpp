#include "viewer/slice/colour_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace volumen {

namespace {

struct Corner {
  int at, r, g, b;
};

struct Palette {
  ColourMap map;
  const char* name;
  std::vector<Corner> corners;
};

const std::vector<Palette>& palettes() {
  static const std::vector<Palette> table{
      {ColourMap::grey, "grey", {{0, 0, 0, 0}, {255, 255, 255, 255}}},
      {ColourMap::hotIron,
       "hotIron",
       {{0, 0, 0, 0}, {128, 255, 0, 0}, {191, 255, 126, 0}, {255, 255, 255, 255}}},
      {ColourMap::pet,
       "pet",
       {{0, 0, 0, 0}, {63, 0, 128, 125}, {128, 128, 0, 255}, {192, 255, 128, 0}, {255, 255, 255, 255}}},
      {ColourMap::rainbow,
       "rainbow",
       {{0, 0, 0, 255}, {64, 0, 255, 255}, {128, 0, 255, 0}, {192, 255, 255, 0}, {255, 255, 0, 0}}},
  };
  return table;
}

const Palette& paletteOf(ColourMap map) { return *std::ranges::find(palettes(), map, &Palette::map); }

ColourTable tableOf(const Palette& palette) {
  ColourTable table{};
  for (std::size_t n = 0; n + 1 < palette.corners.size(); ++n) {
    const Corner &a = palette.corners[n], &b = palette.corners[n + 1];
    for (int i = a.at; i <= b.at; ++i) {
      const double part = double(i - a.at) / (b.at - a.at);
      const auto between = [&](int from, int to) {
        return std::uint32_t(std::lround(from + part * (to - from)));
      };
      table[std::size_t(i)] =
          0xff000000u | between(a.r, b.r) << 16 | between(a.g, b.g) << 8 | between(a.b, b.b);
    }
  }
  return table;
}

// Blends one channel of two colours.
std::uint32_t mixed(std::uint32_t under, std::uint32_t over, int shift, double part) {
  const double u = under >> shift & 0xff, o = over >> shift & 0xff;
  return std::uint32_t(u + part * (o - u) + 0.5) << shift;
}

}  // namespace

const char* colourMapName(ColourMap map) { return paletteOf(map).name; }

std::optional<ColourMap> colourMapNamed(std::string_view name) {
  for (const Palette& palette : palettes())
    if (name == palette.name) return palette.map;
  return {};
}

std::span<const ColourMap> colourMaps() {
  static constexpr ColourMap all[] = {ColourMap::grey, ColourMap::hotIron, ColourMap::pet,
                                      ColourMap::rainbow};
  return all;
}

const ColourTable& colourTable(ColourMap map) {
  static const auto tables = [] {
    std::array<ColourTable, 4> made;
    for (const Palette& palette : palettes()) made[std::size_t(palette.map)] = tableOf(palette);
    return made;
  }();
  return tables[std::size_t(map)];
}

void layOver(std::span<std::uint32_t> pixels, std::span<const float> values, const GreyMapping& grey,
             ColourMap map, double opacity) {
  const std::vector<std::uint8_t> bytes = greyBytes(values, grey);
  const ColourTable& colours = colourTable(map);
  constexpr double fadesIn = 64;
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    if (std::isnan(values[n])) continue;
    const double part = opacity * std::min(1.0, bytes[n] / fadesIn);
    const std::uint32_t over = colours[bytes[n]], under = pixels[n];
    pixels[n] = 0xff000000u | mixed(under, over, 16, part) | mixed(under, over, 8, part) |
                mixed(under, over, 0, part);
  }
}

}  // namespace volumen
