#include "ui/workspace/cine.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "io/study/cine.h"

namespace volumen {

namespace {

constexpr double usualRate = 15;  // frames a second

bool hasTimes(const Cine& cine) {
  return cine.framesPerSecond <= 0 && cine.frameTimesMs.size() > 1 &&
         std::reduce(cine.frameTimesMs.begin() + 1, cine.frameTimesMs.end()) > 0;
}

// The steps of one round: 0, 1, 2, and back 1.
int roundLength(const Cine& cine, int count) {
  return cine.backAndForth && count > 2 ? 2 * count - 2 : count;
}

int frameOf(int step, int count) { return step < count ? step : 2 * count - 2 - step; }

// How long one frame is on screen before another; as long as on average where no time is said.
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

int cineFrame(const Cine& cine, int count, int first, double ms) {
  if (count < 2) return 0;
  const int length = roundLength(cine, count);
  std::vector<double> durations;
  for (int step = 0; step < length; ++step)
    durations.push_back(msBetween(cine, frameOf(step, count), frameOf((step + 1) % length, count)));
  ms += std::reduce(durations.begin(), durations.begin() + first);
  ms = std::fmod(ms, std::reduce(durations.begin(), durations.end()));
  int step = 0;
  while (step + 1 < length && ms >= durations[std::size_t(step)]) ms -= durations[std::size_t(step++)];
  return frameOf(step, count);
}

}  // namespace volumen
