#include "io/dicom/colour.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/dicom/lookup_table.h"

namespace volumen::dicom {
namespace {

std::uint8_t toByte(std::uint32_t value, int bits) {
  if (bits >= 8) return std::uint8_t(value >> (bits - 8));
  const std::uint32_t top = (1u << bits) - 1;
  return std::uint8_t((value * 255 + top / 2) / top);
}

std::uint8_t rounded(double value) { return std::uint8_t(std::clamp(std::floor(value + 0.5), 0.0, 255.0)); }

void ybrToRgb(std::vector<std::uint8_t>& pixels) {
  for (std::size_t n = 0; n + 2 < pixels.size(); n += 3) {
    const double y = pixels[n], cb = pixels[n + 1] - 128.0, cr = pixels[n + 2] - 128.0;
    pixels[n] = rounded(y + 1.402 * cr);
    pixels[n + 1] = rounded(y - 0.344136 * cb - 0.714136 * cr);
    pixels[n + 2] = rounded(y + 1.772 * cb);
  }
}

/// Returns the three tables of a palette with entries reduced to bytes.
Result<std::array<LookupTable, 3>> readPalette(const DataSet& data, bool isSigned,
                                               std::vector<std::string>& warnings) {
  std::array<LookupTable, 3> palette;
  int used = 0;
  bool widened = false;  // if one table is wider than it says, all three are
  for (std::uint32_t colour = 0; colour < 3; ++colour) {
    const LookupTags tags{0x00281101 + colour, 0x00281201 + colour, 0x00281221 + colour};
    auto table = readLookupTable(data, data.root(), tags, isSigned);
    if (!table) return table.error();
    used = std::max(used, table->usedBits());
    widened = widened || table->bits > table->saidBits;
    palette[colour] = std::move(*table);
  }
  const bool narrow = used <= 8 && std::ranges::all_of(palette, [](auto& table) { return table.bits == 16; });
  if (narrow && used > 0)
    warnings.emplace_back("Its palette says that it has 16 bits, and uses 8: it is shown by those.");
  for (LookupTable& table : palette)
    for (std::uint16_t& entry : table.entries) entry = toByte(entry, narrow ? 8 : widened ? 16 : table.bits);
  return palette;
}

std::vector<std::uint8_t> throughPalette(const Samples& samples, const std::array<LookupTable, 3>& palette) {
  return std::visit(
      [&](const auto& indices) {
        std::vector<std::uint8_t> rgb;
        rgb.reserve(3 * indices.size());
        for (const auto index : indices)
          for (const LookupTable& table : palette) rgb.push_back(std::uint8_t(table.at(double(index))));
        return rgb;
      },
      samples);
}

}  // namespace

Result<std::vector<std::uint8_t>> toRgb(const DecodedFrame& decoded, const PixelFormat& format,
                                        const DataSet& data, std::vector<std::string>& warnings) {
  if (format.samples == 1) {
    const auto palette = readPalette(data, format.isSigned, warnings);
    if (!palette) return palette.error();
    return throughPalette(decoded.samples, *palette);
  }
  std::vector<std::uint8_t> rgb = std::visit(
      [&](const auto& samples) {
        std::vector<std::uint8_t> bytes(samples.size());
        for (std::size_t n = 0; n < bytes.size(); ++n)
          bytes[n] = toByte(std::uint32_t(samples[n]), format.bitsStored);
        return bytes;
      },
      decoded.samples);
  if (decoded.ybr) ybrToRgb(rgb);
  return rgb;
}

}  // namespace volumen::dicom
