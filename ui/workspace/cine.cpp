#include "ui/workspace/cine.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace volumen {

namespace {

constexpr double usualRate = 15;  // frames a second

bool hasTimes(const Cine& cine) {
  return cine.framesPerSecond <= 0 && cine.frameTimesMs.size() > 1 &&
         std::reduce(cine.frameTimesMs.begin() + 1, cine.frameTimesMs.end()) > 0;
}

// Returns how long a frame is shown before the next, in ms. Uses the average if the file gives no time.
double msBetween(const Cine& cine, int from, int to) {
  const auto later = std::size_t(std::max(from, to));
  const bool isSaid = hasTimes(cine) && std::abs(from - to) == 1 && later < cine.frameTimesMs.size();
  const double ms = isSaid ? cine.frameTimesMs[later] : 0;
  return ms > 0 ? ms : 1000 / cineRate(cine);
}

}  // namespace

double cineRate(const Cine& cine) {
  if (cine.framesPerSecond > 0) return cine.framesPerSecond;
  if (!hasTimes(cine)) return usualRate;
  const double sum = std::reduce(cine.frameTimesMs.begin() + 1, cine.frameTimesMs.end());
  return 1000 * double(cine.frameTimesMs.size() - 1) / sum;
}

CineTrack::CineTrack(const Cine& cine, const CineRound& round, int place, bool backwards)
    : places_(std::size_t(round.last - round.first) + 1), loops_(round.loops) {
  const auto add = [&](int p) { steps_.push_back({p, 0}); };
  for (int p = round.first; p <= round.last; ++p) add(p);
  if (round.backAndForth)
    for (int p = round.last - 1; p >= round.first + (loops_ ? 1 : 0); --p) add(p);
  const double usual = cineRate(cine), slower = round.rate > 0 ? usual / round.rate : 1;
  for (std::size_t n = 0; n < steps_.size(); ++n)
    steps_[n].ms = slower * msBetween(cine, steps_[n].place, steps_[(n + 1) % steps_.size()].place);
  const auto isThere = [&](const Step& step) { return step.place == place; };
  const auto begin = backwards ? steps_.begin() + std::ptrdiff_t(places_) : steps_.begin();
  auto found = std::find_if(begin, steps_.end(), isThere);
  if (found == steps_.end()) found = std::ranges::find_if(steps_, isThere);
  if (found != steps_.end()) at_ = std::size_t(found - steps_.begin());
  if (isOver()) at_ = 0;
}

std::size_t CineTrack::indexAfter(std::size_t step) const {
  if (step + 1 < steps_.size()) return step + 1;
  return loops_ ? 0 : step;
}

int CineTrack::pass(double ms, int most) {
  spent_ += std::max(0.0, ms);
  for (; !isOver() && spent_ >= steps_[at_].ms; --most) {
    if (most <= 0) {
      spent_ = steps_[at_].ms;  // the next position is due at once in the next call
      break;
    }
    spent_ -= steps_[at_].ms;
    at_ = indexAfter(at_);
  }
  return place();
}

}  // namespace volumen
