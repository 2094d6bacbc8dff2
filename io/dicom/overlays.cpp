#include "io/dicom/overlays.h"

#include <algorithm>

#include "viewer/segment/packed_bits.h"

namespace volumen::dicom {
namespace {

/// One of the groups 6000, 6002 .. 601E.
class Plane {
 public:
  Plane(const DataSet& data, std::uint32_t group) : data_(data), group_(group) {}

  bool isThere() const {
    return data_.has(tag(0x0010), data_.root()) || data_.has(tag(0x3000), data_.root());
  }
  bool isEmbedded() const { return !data_.has(tag(0x3000), data_.root()); }
  int bitPosition() const { return word(0x0102).value_or(0); }
  std::string label() const {
    for (std::uint32_t element : {0x1500u, 0x0022u})
      if (const std::string text = data_.utf8(tag(element), data_.root()); !text.empty()) return text;
    return "Overlay " + std::to_string((group_ - 0x6000) / 2 + 1);
  }

  /// Returns the overlay frame that lies over frame `n` of the picture, or nothing.
  std::optional<std::uint64_t> frameOver(int n) const {
    const auto count = data_.number(tag(0x0015), data_.root());
    if (!count) return 0;  // one overlay frame for all
    const double frame = n - (double(word(0x0051).value_or(1)) - 1);
    if (frame < 0 || frame >= *count) return {};
    return std::uint64_t(frame);
  }

  /// Returns the mask from Overlay Data for a picture of `size`.
  Result<std::vector<std::uint8_t>> mask(glm::ivec2 size, std::uint64_t frame) const {
    const std::uint64_t rows = word(0x0010).value_or(0), columns = word(0x0011).value_or(0);
    const std::vector<std::uint8_t> bits = data_.bytes(tag(0x3000), data_.root());
    const std::uint64_t first = frame * rows * columns;
    if (first + rows * columns > 8 * std::uint64_t(bits.size()))
      return Error{"its data hold " + std::to_string(bits.size()) + " bytes, too few for " +
                   std::to_string(columns) + " x " + std::to_string(rows) + " pixels"};
    const glm::ivec2 corner = origin();
    std::vector<std::uint8_t> mask(std::size_t(size.x) * std::size_t(size.y));
    for (int y = std::max(0, corner.y); y < std::min<std::int64_t>(size.y, corner.y + std::int64_t(rows));
         ++y)
      for (int x = std::max(0, corner.x);
           x < std::min<std::int64_t>(size.x, corner.x + std::int64_t(columns)); ++x) {
        const std::uint64_t bit = first + std::uint64_t(y - corner.y) * columns + std::uint64_t(x - corner.x);
        mask[std::size_t(y) * std::size_t(size.x) + std::size_t(x)] = bitAt(bits, bit);
      }
    return mask;
  }

 private:
  std::uint32_t tag(std::uint32_t element) const { return group_ << 16 | element; }
  std::optional<std::uint16_t> word(std::uint32_t element) const {
    return data_.word(tag(element), data_.root());
  }
  /// Returns the position of its first pixel, from 0. The file counts from 1, row first; values below 1 are
  /// outside.
  glm::ivec2 origin() const {
    const std::vector<std::uint16_t> v = data_.words(tag(0x0050), data_.root());
    if (v.size() < 2) return {0, 0};
    return {std::int16_t(v[1]) - 1, std::int16_t(v[0]) - 1};
  }

  const DataSet& data_;
  std::uint32_t group_;
};

/// Returns the mask stored in an unused bit of the pixels.
Result<std::vector<std::uint8_t>> embeddedMask(const Plane& plane, const PixelSource& pixels,
                                               const FileHeader& header, int n) {
  const int bit = plane.bitPosition(), lowest = header.format.highBit + 1 - header.format.bitsStored;
  const bool unused = bit < header.format.bitsAllocated && (bit > header.format.highBit || bit < lowest);
  if (!unused || header.format.samples != 1 || header.format.kind != PixelFormat::Kind::integer)
    return Error{"it has neither data nor a bit of its own in the pixels"};
  if (header.syntax.coding == Coding::jpeg2000)
    return Error{"its bits are not kept by " + std::string(header.syntax.name)};
  PixelFormat format = header.format;
  format.bitsStored = 1;
  format.highBit = bit;
  format.isSigned = false;
  const auto decoded = pixels.frame(n, format);
  if (!decoded) return decoded.error();
  return std::visit([](const auto& bits) { return std::vector<std::uint8_t>(bits.begin(), bits.end()); },
                    decoded->samples);
}

}  // namespace

std::vector<FrameOverlay> readOverlays(const DataSet& data, const PixelSource& pixels,
                                       const FileHeader& header, int n, std::vector<std::string>& warnings) {
  const glm::ivec2 size(header.format.columns, header.format.rows);
  std::vector<FrameOverlay> overlays;
  for (std::uint32_t group = 0x6000; group <= 0x601e; group += 2) {
    const Plane plane(data, group);
    const auto frame = plane.frameOver(n);
    if (!plane.isThere() || !frame) continue;
    auto mask = plane.isEmbedded() ? embeddedMask(plane, pixels, header, n) : plane.mask(size, *frame);
    if (mask)
      overlays.push_back({plane.label(), std::move(*mask)});
    else
      warnings.push_back(plane.label() + " is left out: " + mask.message() + ".");
  }
  return overlays;
}

}  // namespace volumen::dicom
