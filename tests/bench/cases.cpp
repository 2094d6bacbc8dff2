#include "tests/bench/cases.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>

#include "viewer/evaluation/statistics.h"

namespace volumen::bench {

Status drawRound(std::vector<Case>& cases) {
  for (Case& c : cases) {
    auto orbit = measureOrbit(c.scene, c.options, {.views = 8, .rounds = 1}, *c.caches);
    if (!orbit) return orbit.error();
    c.viewsMs.resize(orbit->views.size(), std::numeric_limits<double>::max());
    for (std::size_t n = 0; n < c.viewsMs.size(); ++n)
      c.viewsMs[n] = std::min(c.viewsMs[n], orbit->views[n].framesMs.front());
    c.plan = std::move(orbit->plan);
    c.stats = std::move(orbit->views.back().stats);
  }
  return {};
}

double msOf(const Case& c) { return median(c.viewsMs); }

RenderOptions plainSteps(int threads) {
  RenderOptions o;
  o.step = 1;
  o.threads = threads;
  return o;
}

std::vector<Light> ringOfLights(int count) {
  std::vector<Light> lights(count);
  for (int n = 0; n < count; ++n) {
    const double angle = 6.283185307179586 * n / count;
    lights[n].direction = {std::cos(angle), std::sin(angle), 1};
    lights[n].intensity = 1.0 / count;
  }
  return lights;
}

std::string text(const char* format, ...) {
  char out[400];
  va_list values;
  va_start(values, format);
  std::vsnprintf(out, sizeof out, format, values);
  va_end(values);
  return out;
}

}  // namespace volumen::bench
