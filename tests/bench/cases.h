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
  std::vector<double> viewsMs{};  ///< fastest frame of each view
  Plan plan{};                    ///< plan of the first view
  RenderStats stats{};            ///< statistics of the last frame
};

/// Draws an 8-view orbit of every case, its first view once before. Called once a round, so that noise
/// affects all cases alike.
Status drawRound(std::vector<Case>& cases);

/// Returns the median over the views of their fastest frames, ms.
double msOf(const Case& c);

/// Returns options for plain steps of one voxel. The pictures have 512 x 512 pixels.
RenderOptions plainSteps(int threads);

/// Returns `count` white lights around the viewer, together as bright as one.
std::vector<Light> ringOfLights(int count);

/// Formats like printf and returns the text (up to 399 bytes).
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

}  // namespace volumen::bench
