#include "ui/controller/label_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "ui/controller/colour_mix.h"
#include "ui/controller/label_pixels.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr float outlineWidth = 1.5F;  // pixels
constexpr float leastSeen = 0.5F;     // of a pixel, where a label is too thin to cover one

// The pixels by which the depth of a place is found, as far as an outline reaches, and how far they are.
struct Beside {
  int x, y;
  float away;
};
const std::vector<Beside>& besides() {
  static const std::vector<Beside> all = [] {
    std::vector<Beside> found;
    for (int y = -2; y <= 2; ++y)
      for (int x = -2; x <= 2; ++x)
        if (x * x + y * y < 8) found.push_back({x, y, std::sqrt(float(x * x + y * y))});
    return found;
  }();
  return all;
}

// How far the middle of a pixel lies inside the border of a label, pixels; more than 2: anything. A pixel of
// which a part is covered has the border about (covered - 1/2) behind its middle.
float depthAt(const LabelPixels& pixels, int x, int y, std::uint8_t shown) {
  float least = 3;
  for (const Beside& by : besides()) {
    const int i = x + by.x, j = y + by.y;
    if (i < pixels.low().x || j < pixels.low().y || i >= pixels.high().x || j >= pixels.high().y) continue;
    const float covered = pixels.covered(i, j, shown);
    if (covered < 1) least = std::min(least, by.away + covered - 0.5F);
  }
  return least;
}

// Whether none of the nine pixels is covered as a whole; not told at the edge of the picture.
bool isThinAt(const LabelPixels& pixels, int x, int y, std::uint8_t shown) {
  const glm::ivec2 low = pixels.low(), high = pixels.high();
  if (x <= low.x || y <= low.y || x >= high.x - 1 || y >= high.y - 1) return false;
  for (int j = y - 1; j <= y + 1; ++j)
    for (int i = x - 1; i <= x + 1; ++i)
      if (pixels.covered(i, j, shown) >= 1) return false;
  return true;
}

struct LabelLook {
  glm::vec3 colour;
  float inside, outline;  // how much of what is under it is hidden
};

QRgb pixelAtBorder(const LabelPixels& pixels, int x, int y, std::span<const LabelLook> looks, QRgb under) {
  glm::vec3 over(0);
  float hidden = 0, covered = 0;
  pixels.forParts(x, y, [&](std::uint8_t shown, float part) {
    const LabelLook& look = looks[shown - 1u];
    if (part < leastSeen && isThinAt(pixels, x, y, shown)) part = leastSeen;
    const float inner = std::clamp(depthAt(pixels, x, y, shown) + 0.5F - outlineWidth, 0.0F, part);
    const float hides = inner * look.inside + (part - inner) * look.outline;
    over += hides * look.colour;
    hidden += hides, covered += part;
  });
  if (covered > 1) over /= covered, hidden /= covered;
  const glm::vec3 seen = (1 - hidden) * glm::vec3(qRed(under), qGreen(under), qBlue(under)) + over + 0.5F;
  return qRgb(int(seen.x), int(seen.y), int(seen.z));
}

}  // namespace

void paintLabels(QImage& picture, const SlicePlane& plane, const SegmentLayer& layer) {
  if (layer.shown.empty()) return;
  const LabelPixels pixels(layer, plane);
  std::vector<ColourMix> insides;
  std::vector<LabelLook> looks;
  for (const SegmentLayer::Shown& segment : layer.shown) {
    const double part = layer.opacity * segment.opacity;
    insides.emplace_back(segment.colour, part);
    looks.push_back({{qRed(segment.colour), qGreen(segment.colour), qBlue(segment.colour)},
                     float(part),
                     float(std::min(1.0, 2 * part))});
  }
  auto* const first = reinterpret_cast<QRgb*>(picture.bits());
  const auto width = std::size_t(picture.width());
  const glm::ivec2 low = pixels.low(), high = pixels.high();
  parallelFor(high.y - low.y, 0, [&](std::int64_t begin, std::int64_t end) {
    for (int y = low.y + int(begin); y < low.y + int(end); ++y) {
      QRgb* line = first + std::size_t(y) * width;
      for (int x = low.x; x < high.x; ++x) {
        const std::uint8_t inside = pixels.inside(x, y);
        if (inside == 0) continue;
        line[x] = inside == LabelPixels::mixed ? pixelAtBorder(pixels, x, y, looks, line[x])
                                               : insides[inside - 1u](line[x]);
      }
    }
  });
}

}  // namespace volumen
