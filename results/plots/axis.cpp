#include "results/plots/axis.h"

#include <cmath>

namespace volumen {

double Axis::pixelOf(double value) const {
  const double share =
      logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return atLow + share * (atHigh - atLow);
}

namespace {

std::vector<Tick> logarithmicTicks(const Axis& axis) {
  const bool few = std::log10(axis.high / axis.low) < 3.3;
  std::vector<Tick> ticks;
  for (int decade = int(std::floor(std::log10(axis.low))); std::pow(10, decade) <= axis.high; ++decade)
    for (const int n : {1, 2, 5}) {
      const double value = n * std::pow(10, decade);
      // A millionth allows for rounding.
      if (value > axis.low * (1 - 1e-6) && value < axis.high * (1 + 1e-6))
        ticks.push_back({value, n == 1 || few});
    }
  return ticks;
}

}  // namespace

std::vector<Tick> ticksOf(const Axis& axis) {
  if (axis.logarithmic) return logarithmicTicks(axis);
  const double rough = (axis.high - axis.low) / 6, decade = std::pow(10, std::floor(std::log10(rough)));
  const double fine = decade * (rough / decade > 5   ? 10
                                : rough / decade > 2 ? 5
                                : rough / decade > 1 ? 2
                                                     : 1);
  const double step = axis.wholeNumbers ? std::max(1.0, fine) : fine;
  std::vector<Tick> ticks;
  for (double value = std::ceil(axis.low / step) * step; value <= axis.high + 1e-6 * step; value += step)
    ticks.push_back({value, true});
  return ticks;
}

QString tickText(double value) { return QString::number(value, 'g', 6); }

}  // namespace volumen
