#include "ui/controller/label_pixels.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

using Rows = std::vector<std::uint8_t>;
constexpr std::uint8_t severalLabels = LabelPixels::mixed;

// Pixels of which all those up to `reach` pixels from them, along both axes, are the same; the others are
// mixed. Beyond the picture all goes on.
Rows whereAllAround(const Rows& pixels, glm::ivec2 size, int reach) {
  Rows along(pixels.size()), all(pixels.size());
  const auto width = std::size_t(size.x);
  parallelFor(size.y, 0, [&](std::int64_t begin, std::int64_t end) {
    for (auto y = std::size_t(begin); y < std::size_t(end); ++y) {
      const std::uint8_t* in = &pixels[y * width];
      std::uint8_t* out = &along[y * width];
      std::copy(in, in + width, out);
      for (std::size_t by = 1; by <= std::size_t(reach); ++by) {
        for (std::size_t x = by; x < width; ++x) out[x] |= in[x] == in[x - by] ? 0 : severalLabels;
        for (std::size_t x = by; x < width; ++x) out[x - by] |= in[x] == in[x - by] ? 0 : severalLabels;
      }
    }
  });
  parallelFor(size.y, 0, [&](std::int64_t begin, std::int64_t end) {
    for (int y = int(begin); y < int(end); ++y) {
      const std::uint8_t* in = &along[std::size_t(y) * width];
      std::uint8_t* out = &all[std::size_t(y) * width];
      std::copy(in, in + width, out);
      for (int other = std::max(0, y - reach); other <= std::min(size.y - 1, y + reach); ++other) {
        const std::uint8_t* beside = &along[std::size_t(other) * width];
        for (std::size_t x = 0; x < width; ++x) out[x] |= in[x] == beside[x] ? 0 : severalLabels;
      }
    }
  });
  return all;
}

// How often each label was met in a pixel.
class LabelCounts {
 public:
  void add(std::uint8_t shown) {
    if (count_[shown]++ == 0) met_[metCount_++] = shown;
  }
  std::span<const std::uint8_t> met() const { return {met_.data(), metCount_}; }
  int of(std::uint8_t shown) const { return count_[shown]; }
  void clear() {
    for (const std::uint8_t shown : met()) count_[shown] = 0;
    metCount_ = 0;
  }

 private:
  std::array<std::uint16_t, 256> count_{};
  std::array<std::uint8_t, 256> met_{};
  std::size_t metCount_ = 0;
};

void countLabels(LabelBorder::Reader& reader, int x, int y, int places, LabelCounts& counts) {
  const double step = 1.0 / places;
  for (int j = 0; j < places; ++j)
    for (int i = 0; i < places; ++i) counts.add(reader.at({x + (i + 0.5) * step, y + (j + 0.5) * step}));
}

}  // namespace

LabelPixels::LabelPixels(const SegmentLayer& layer, const SlicePlane& plane) {
  const LabelBorder border(layer, plane);
  constexpr int reach = 3;  // beyond the last pixels with labels: all are background
  glm::ivec2 low = plane.size, high(0);
  for (int y = 0; y < plane.size.y; ++y) {
    const auto [from, to] = border.pixelsOfRow(y);
    if (from < to) low = glm::min(low, {from, y}), high = glm::max(high, {to, y + 1});
  }
  if (low.x >= high.x) return;
  low_ = glm::max(low - reach, 0);
  size_ = glm::min(high + reach, plane.size) - low_;
  whole_.resize(std::size_t(size_.x) * std::size_t(size_.y));
  parts_.resize(std::size_t(size_.y));
  firstPart_ = std::make_unique_for_overwrite<std::uint32_t[]>(whole_.size());
  lookAtAll(border);
  lookCloser(border);
  inside_ = whereAllAround(whole_, size_, 2);
}

void LabelPixels::lookAtAll(const LabelBorder& border) {
  const int places = border.placesPerPixel();
  parallelFor(size_.y, 0, [&](std::int64_t begin, std::int64_t end) {
    LabelBorder::Reader reader(border);
    LabelCounts counts;
    for (int y = low_.y + int(begin); y < low_.y + int(end); ++y) {
      const auto [from, to] = border.pixelsOfRow(y);
      for (int x = from; x < to; ++x) {
        std::uint8_t& whole = whole_[place(x, y)];
        if (places == 1) {
          whole = reader.at({x + 0.5, y + 0.5});
          continue;
        }
        countLabels(reader, x, y, places, counts);
        whole = counts.met().size() == 1 ? counts.met()[0] : mixed;
        counts.clear();
      }
    }
  });
}

void LabelPixels::lookCloser(const LabelBorder& border) {
  const int places = std::max(4, border.placesPerPixel());
  const Rows same = whereAllAround(whole_, size_, 1);
  parallelFor(size_.y, 0, [&](std::int64_t begin, std::int64_t end) {
    LabelBorder::Reader reader(border);
    LabelCounts counts;
    for (int y = low_.y + int(begin); y < low_.y + int(end); ++y) {
      std::vector<Part>& parts = parts_[std::size_t(y - low_.y)];
      for (int x = low_.x; x < low_.x + size_.x; ++x) {
        if (same[place(x, y)] != mixed) continue;
        countLabels(reader, x, y, places, counts);
        const bool isWhole = counts.met().size() == 1;
        whole_[place(x, y)] = isWhole ? counts.met()[0] : mixed;
        if (!isWhole || counts.met()[0] == mixed) {
          firstPart_[place(x, y)] = std::uint32_t(parts.size());
          for (const std::uint8_t shown : counts.met())
            parts.push_back({shown, false, float(counts.of(shown)) / float(places * places)});
          parts.back().isLast = true;
        }
        counts.clear();
      }
    }
  });
}

}  // namespace volumen
