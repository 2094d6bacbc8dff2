#include "ui/controller/segment_layer.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "ui/controller/segment_samples.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// The number of sample points in a segment, for the pixels of a tile and their neighbours.
struct TileCounts {
  std::array<std::uint16_t, SegmentSamples::tileWidth + 2> own{}, above{},
      below{};  // starts at the pixel left of the tile

  // Beyond the picture the edge pixels repeat; beyond the area there is nothing.
  void read(const SegmentSamples& samples, int row, int tile, std::size_t number) {
    const QRect& area = samples.area();
    const int from = tile * SegmentSamples::tileWidth,
              to = std::min(from + SegmentSamples::tileWidth, area.width());
    const int left = std::max(from - 1, 0), right = std::min(to + 1, area.width());
    samples.count(row, number, left, right, &own[std::size_t(left - from + 1)]);
    if (left == from) own[0] = own[1];
    if (right == to) own[std::size_t(to - from) + 1] = own[std::size_t(to - from)];
    samples.count(std::max(row - 1, 0), number, from, to, &above[1]);
    samples.count(std::min(row + 1, area.height() - 1), number, from, to, &below[1]);
  }
};

// The tint of the pixels of a tile, in sample points: how many are covered, how many are hidden, and their
// colours.
class TileTint {
 public:
  explicit TileTint(int places) : places_(float(places)), half_((places + 1) / 2) {}

  // Without branches, so that the loop is vectorised.
  void add(const TileCounts& counts, QRgb colour, double opacity) {
    const float inside = float(opacity), outline = float(std::min(1.0, 2 * opacity));
    const float red = float(qRed(colour)), green = float(qGreen(colour)), blue = float(qBlue(colour));
    const int half = half_;
    for (std::size_t x = 0; x < covered_.size(); ++x) {
      const int here = counts.own[x + 1], left = counts.own[x], right = counts.own[x + 2],
                above = counts.above[x + 1], below = counts.below[x + 1];
      const int inner = std::min(std::min(std::min(left, right), std::min(above, below)), here);
      const int most = std::max(std::max(left, right), std::max(above, below));
      const int least = (here > 0) & (most <= here) ? half : 0;  // for thin segments
      const int seen = std::max(here, least);
      const float hides = float(inner) * inside + float(seen - inner) * outline;
      covered_[x] += float(seen);
      hidden_[x] += hides;
      red_[x] += hides * red, green_[x] += hides * green, blue_[x] += hides * blue;
    }
  }

  void fill(QRgb colour, double opacity) {
    covered_.fill(places_), hidden_.fill(places_ * float(opacity));
    red_.fill(hidden_[0] * float(qRed(colour)));
    green_.fill(hidden_[0] * float(qGreen(colour)));
    blue_.fill(hidden_[0] * float(qBlue(colour)));
  }

  void mixInto(std::span<QRgb> pixels) const {
    for (std::size_t x = 0; x < pixels.size(); ++x) {
      const float whole = std::max(places_, covered_[x]), open = whole - hidden_[x];
      const auto mixed = [&](int under, float over) {
        return int((open * float(under) + over) / whole + 0.5F);
      };
      const QRgb under = pixels[x];
      pixels[x] =
          qRgb(mixed(qRed(under), red_[x]), mixed(qGreen(under), green_[x]), mixed(qBlue(under), blue_[x]));
    }
  }

 private:
  using Row = std::array<float, SegmentSamples::tileWidth>;
  float places_;  // per pixel
  int half_;
  Row covered_{}, hidden_{}, red_{}, green_{}, blue_{};
};

// Returns the only number in a tile and its neighbours; nothing if there are several.
std::optional<std::size_t> onlyNumber(const SegmentSamples& samples, int row, int tile,
                                      std::size_t shownCount) {
  const SegmentSamples::Numbers& met = samples.numbersIn(row, tile);
  if (met.count() != 1) return {};
  const int lastRow = samples.area().height() - 1, lastTile = samples.tiles() - 1;
  if (samples.numbersIn(std::max(row - 1, 0), tile) != met ||
      samples.numbersIn(std::min(row + 1, lastRow), tile) != met ||
      samples.numbersIn(row, std::max(tile - 1, 0)) != met ||
      samples.numbersIn(row, std::min(tile + 1, lastTile)) != met)
    return {};
  std::size_t number = 0;
  while (number < shownCount && !met[number]) ++number;
  return number;
}

void paintTile(const SegmentSamples& samples, int row, int tile, std::span<const SegmentLayer::Shown> shown,
               double opacity, std::span<QRgb> pixels) {
  TileTint tint(samples.places());
  if (const auto only = onlyNumber(samples, row, tile, shown.size())) {
    if (*only == 0) return;
    tint.fill(shown[*only - 1].colour, opacity * shown[*only - 1].opacity);
  } else {
    for (std::size_t number = 1; number <= shown.size(); ++number) {
      if (!samples.numbersIn(row, tile)[number]) continue;
      TileCounts counts;
      counts.read(samples, row, tile, number);
      tint.add(counts, shown[number - 1].colour, opacity * shown[number - 1].opacity);
    }
  }
  tint.mixInto(pixels);
}

void paint(QImage& picture, const SegmentSamples& samples, std::span<const SegmentLayer::Shown> shown,
           double opacity) {
  const QRect area = samples.area();
  const std::span all(reinterpret_cast<QRgb*>(picture.bits()),
                      std::size_t(picture.width()) * std::size_t(picture.height()));
  parallelFor(area.height(), 0, [&](std::int64_t begin, std::int64_t end) {
    for (int row = int(begin); row < int(end); ++row)
      for (int tile = 0; tile < samples.tiles(); ++tile) {
        const int x = tile * SegmentSamples::tileWidth,
                  count = std::min(SegmentSamples::tileWidth, area.width() - x);
        const std::size_t first =
            std::size_t(area.top() + row) * std::size_t(picture.width()) + std::size_t(area.left() + x);
        paintTile(samples, row, tile, shown, opacity, all.subspan(first, std::size_t(count)));
      }
  });
}

}  // namespace

QImage withSegments(QImage picture, const SlicePlane& plane, const SegmentLayer& layer) {
  if (picture.format() != QImage::Format_RGB32) picture = picture.convertToFormat(QImage::Format_RGB32);
  if (layer.labels) {
    if (!layer.shown.empty())
      paint(picture, SegmentSamples::ofLabels(layer, plane), layer.shown, layer.opacity);
    return picture;
  }
  for (const SegmentLayer::Shown& shown : layer.shown)
    paint(picture, SegmentSamples::ofSegmentation(*layer.segmentation, shown.segment, plane),
          std::span(&shown, 1), layer.opacity);
  return picture;
}

}  // namespace volumen
