#include "viewer/volume/picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace volumen {

std::vector<std::uint8_t> toBytes(const Picture& picture) {
  const std::size_t pixels = std::size_t(picture.size.x) * picture.size.y;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(pixels * (picture.transparent ? 4 : 3));
  for (std::size_t n = 0; n < pixels; ++n) {
    const float* p = &picture.rgba[4 * n];
    for (int c = 0; c < 3; ++c) {
      const float straight = !picture.transparent ? p[c] : p[3] > 0 ? p[c] / p[3] : 0.0f;
      bytes.push_back(toByte(straight));
    }
    if (picture.transparent) bytes.push_back(toByte(p[3]));
  }
  return bytes;
}

namespace {

// Computes the errors from each pixel's largest difference and the sum over pixels of its mean square.
PictureError errorOf(std::vector<double> largest, double squares) {
  PictureError e;
  if (largest.empty()) return e;
  const std::size_t count = largest.size();
  e.shareAbove2 = double(std::ranges::count_if(largest, [](double d) { return d > 2; })) / double(count);
  const std::size_t rank = (99 * count + 99) / 100;  // ceil(0.99 N), at least 1
  std::nth_element(largest.begin(), largest.begin() + (rank - 1), largest.end());
  e.percentile99 = largest[rank - 1];
  e.maximum = *std::max_element(largest.begin() + (rank - 1), largest.end());
  e.rmse = std::sqrt(squares / double(count));
  e.psnrDb = e.rmse > 0 ? 20 * std::log10(255 / e.rmse) : std::numeric_limits<double>::infinity();
  return e;
}

}  // namespace

PictureError errorOf(const std::vector<float>& pixels255) {
  double squares = 0;
  for (float d : pixels255) squares += double(d) * d;
  return errorOf(std::vector<double>(pixels255.begin(), pixels255.end()), squares);
}

std::optional<PictureError> estimateOf(const std::vector<float>& map255) {
  if (map255.empty()) return {};
  return errorOf(map255);
}

PictureError compare(const Picture& a, const Picture& b, const std::vector<std::uint8_t>& use) {
  std::vector<double> largest;
  double squares = 0;
  const std::size_t pixels = std::size_t(a.size.x) * a.size.y;
  const int components = componentsThatDiffer(a.transparent || b.transparent);
  for (std::size_t n = 0; n < pixels; ++n) {
    if (!use.empty() && !use[n]) continue;
    double most = 0;
    for (int c = 0; c < 4; ++c) {
      const double d = 255.0 * (double(a.rgba[4 * n + c]) - double(b.rgba[4 * n + c]));
      // A NaN must not pass as "no difference".
      most = std::isnan(d) ? std::numeric_limits<double>::infinity() : std::max(most, std::abs(d));
      squares += d * d / components;
    }
    largest.push_back(most);
  }
  return errorOf(std::move(largest), squares);
}

}  // namespace volumen
