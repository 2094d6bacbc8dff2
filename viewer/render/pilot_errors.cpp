#include "viewer/render/pilot_errors.h"

#include <algorithm>
#include <cmath>

namespace volumen {

void PilotErrors::beginTile(double chance) { tiles_.push_back({chance}); }

void PilotErrors::add(double largest, double square) {
  // A NaN must not pass as "no difference".
  if (std::isnan(largest) || std::isnan(square)) largest = square = 1e9;
  tiles_.back().squares += square;
  ++tiles_.back().pixels;
  pixels_.push_back({largest, int(tiles_.size()) - 1});
}

double PilotErrors::pixelsInAll() const {
  double all = 0;
  for (const Tile& t : tiles_) all += t.pixels / t.chance;
  return all;
}

double PilotErrors::percentile99(double deviations) const {
  std::vector<Pixel> sorted = pixels_;
  std::ranges::sort(sorted, [](const Pixel& a, const Pixel& b) {
    return a.largest != b.largest ? a.largest > b.largest : a.tile < b.tile;
  });
  const double hundredth = 0.01 * pixelsInAll();
  std::vector<int> above(tiles_.size());
  double sum = 0, variance = 0;  // pixels of a tile are sampled together
  for (const Pixel& p : sorted) {
    const Tile& tile = tiles_[p.tile];
    const double more = 2.0 * above[p.tile]++ + 1;
    sum += 1 / tile.chance;
    variance += (1 - tile.chance) / (tile.chance * tile.chance) * more;
    if (sum + deviations * std::sqrt(variance) > hundredth) return p.largest;
  }
  return 0;
}

PilotErrors::Bounds PilotErrors::likely() const {
  double squares = 0;
  for (const Tile& t : tiles_) squares += t.squares / t.chance;
  const double all = pixelsInAll();
  return {all > 0 ? std::sqrt(squares / all) : 0, percentile99(0)};
}

PilotErrors::Bounds PilotErrors::worst(const Missed& missed) const {
  // Missing all of a set of tiles whose probabilities sum to three has a chance of one in twenty (e^-3).
  // The worst one found is weighted by its probability, which grows with the possible error.
  constexpr double chances = 3, deviations = 2, pixelsOfTile = 16;
  const double all = pixelsInAll();
  double squares = 0, variance = 0;
  double most = rays() > 0 ? pixelsOfTile * missed.least * missed.least * all / rays() : 0;
  for (const Tile& t : tiles_) {
    const double standsFor = t.squares / t.chance;
    squares += standsFor;
    variance += (1 - t.chance) * standsFor * standsFor;
    most = std::max(most, standsFor);
  }
  squares += deviations * std::sqrt(variance) + chances * missed.asWrong * missed.asWrong * most;
  return {all > 0 ? std::sqrt(squares / all) : 0, percentile99(missed.deviations)};
}

}  // namespace volumen
