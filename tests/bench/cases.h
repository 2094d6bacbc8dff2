#pragma once

#include <string>
#include <vector>

#include "viewer/evaluation/orbit.h"

namespace volumen::bench {

/// One of several pictures whose times are compared.
struct Case {
  std::string name;
  Scene scene;
  RenderOptions options;
  RenderCaches* caches = nullptr;
  std::vector<double> viewsMs{};  ///< the fastest frame of each view
  Plan plan{};                    ///< of the first view
  RenderStats stats{};            ///< of the last frame
};

/// Draws an 8-view orbit of every case, its first view once before; called once a round, so that noise hits
/// all alike.
Status drawRound(std::vector<Case>& cases);

/// The median over the views, each at its fastest.
double msOf(const Case& c);

/// The plain step of one voxel at 512 x 512.
RenderOptions plainSteps(int threads);

/// So many white lights around the viewer, as bright as one together.
std::vector<Light> ringOfLights(int count);

/// A printf into a string.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

}  // namespace volumen::bench
