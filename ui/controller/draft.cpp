#include "ui/controller/draft.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <vector>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Beyond 7 the means over blocks of 16 x 16 pixels would differ from those of `standard` by more than
// design.md 2 allows.
constexpr double factors[] = {1, 1.5, 2, 3, 4, 5, 6, 7};
constexpr int lastStep = int(std::size(factors)) - 1;

QImage::Format formatOf(const Picture& picture) {
  return picture.transparent ? QImage::Format_ARGB32_Premultiplied : QImage::Format_RGB32;
}

// Makes an image on all cores. fill(begin, end, row) fills the rows [begin, end); row(y) is the start of a
// row.
template <class Fill>
QImage imageOfRows(QSize size, QImage::Format format, const Fill& fill) {
  QImage image(size, format);
  uchar* first = image.bits();
  const auto row = [first, bytes = image.bytesPerLine()](int y) {
    return reinterpret_cast<QRgb*>(first + y * bytes);
  };
  parallelFor(size.height(), 0,
              [&](std::int64_t begin, std::int64_t end) { fill(int(begin), int(end), row); });
  return image;
}

// The two source pixels of an enlarged pixel along one axis. `count` source pixels are `factor` times as
// large, and both rows share their centre.
struct Neighbours {
  int first, second;
  float weight;  // of `second`
};

Neighbours neighboursAt(int n, int full, int count, double factor) {
  const double at = std::clamp((n + 0.5 - full / 2.0) / factor + count / 2.0 - 0.5, 0.0, count - 1.0);
  const int first = int(at);
  return {first, std::min(first + 1, count - 1), float(at - first)};
}

std::vector<Neighbours> neighboursAlong(int full, int count, double factor) {
  std::vector<Neighbours> neighbours(full);
  for (int n = 0; n < full; ++n) neighbours[n] = neighboursAt(n, full, count, factor);
  return neighbours;
}

}  // namespace

double DraftPace::factor() const { return factors[step_]; }

void DraftPace::measured(double ms) {
  const double pixels = factors[step_] * factors[step_];
  const auto predicted = [&](int step) { return ms * pixels / (factors[step] * factors[step]); };
  if (ms > budgetMs_) {
    int coarser = std::min(step_ + 1, lastStep);
    while (coarser < lastStep && predicted(coarser) > budgetMs_) ++coarser;
    step_ = coarser;
  } else if (step_ > 0 && predicted(step_ - 1) < 0.75 * budgetMs_) {
    --step_;
  }
}

std::optional<double> RestCost::factorOfFiner(double draft, int edge) const {
  constexpr double soonMs = 150;
  const double rest = expected(edge);
  if (rest <= soonMs) return {};
  const auto next = std::find_if(std::begin(factors), std::end(factors), [&](double factor) {
    return factor >= edge && draftMs_ / (factor * factor) <= rest / 3;
  });
  if (next == std::end(factors) || *next * 1.4 > draft) return {};
  return *next;
}

DraftView draftView(const Camera& camera, QSize full, double factor) {
  if (factor == 1) return {full, camera};
  const auto part = [&](int pixels) { return std::max(1, int(std::ceil(pixels / factor - 1e-9))); };
  DraftView draft{{part(full.width()), part(full.height())}, camera};
  const double more = draft.size.height() * factor / full.height();
  draft.camera.height *= more;
  draft.camera.fov = glm::degrees(2 * std::atan(std::tan(glm::radians(camera.fov) / 2) * more));
  return draft;
}

QImage enlarged(const Picture& picture, double factor, QSize full) {
  const std::vector<Neighbours> columns = neighboursAlong(full.width(), picture.size.x, factor);
  const std::vector<Neighbours> rows = neighboursAlong(full.height(), picture.size.y, factor);
  return imageOfRows(full, formatOf(picture), [&](int begin, int end, const auto& rowOf) {
    // Each source row is stretched once, when the result first needs it.
    std::vector<float> stretched[2], blended(std::size_t(4) * full.width());
    int held[2] = {-1, -1};
    const auto stretch = [&](int y) -> const float* {
      auto& out = stretched[y % 2];
      if (held[y % 2] == y) return out.data();
      held[y % 2] = y;
      out.resize(std::size_t(4) * full.width());
      const float* in = picture.row(y);
      for (int x = 0; x < full.width(); ++x)
        for (int c = 0; c < 4; ++c) {
          const float a = in[4 * columns[x].first + c], b = in[4 * columns[x].second + c];
          out[4 * x + c] = a + (b - a) * columns[x].weight;
        }
      return out.data();
    };
    for (int y = begin; y < end; ++y) {
      const float* above = stretch(rows[y].first);
      const float* below = stretch(rows[y].second);
      const float weight = rows[y].weight;
      for (std::size_t n = 0; n < blended.size(); ++n) blended[n] = above[n] + (below[n] - above[n]) * weight;
      toArgb(blended.data(), full.width(), rowOf(y));
    }
  });
}

glm::vec4 enlargedPixel(const Picture& picture, double factor, QSize full, glm::ivec2 pixel) {
  const Neighbours x = neighboursAt(pixel.x, full.width(), picture.size.x, factor);
  const Neighbours y = neighboursAt(pixel.y, full.height(), picture.size.y, factor);
  const auto along = [&](int row) {
    const float *a = picture.row(row) + 4 * x.first, *b = picture.row(row) + 4 * x.second;
    const glm::vec4 first(a[0], a[1], a[2], a[3]), second(b[0], b[1], b[2], b[3]);
    return first + (second - first) * x.weight;
  };
  const glm::vec4 above = along(y.first);
  return above + (along(y.second) - above) * y.weight;
}

QImage toImage(const Picture& picture) {
  const QSize size(picture.size.x, picture.size.y);
  return imageOfRows(size, formatOf(picture), [&](int begin, int end, const auto& rowOf) {
    for (int y = begin; y < end; ++y) toArgb(picture.row(y), size.width(), rowOf(y));
  });
}

}  // namespace volumen
