#pragma once

#include "viewer/evaluation/progress.h"
#include "viewer/render/render.h"

namespace volumen {

/// How fast one view of an orbit is drawn.
struct OrbitView {
  double angleDegrees = 0;  ///< that the camera was turned by about its up axis
  std::vector<double> framesMs;
  std::vector<double> processorsMs;  ///< of all processors together, a frame each
  RenderStats stats;                 ///< of the last frame
};

/// How fast a scene is drawn from all around (design.md 4, `bench`).
struct Orbit {
  Plan plan;  ///< of the first view
  double firstFrameMs =
      0;  ///< facts, blocks, gradients, plan and picture, from a volume of which nothing is known
  double gradientsMs = 0;  ///< of them, the Sobel pass and copies
  std::vector<OrbitView> views;
};

/// What is measured.
struct OrbitOptions {
  int views = 8;   ///< the camera turned by 360 / views each
  int rounds = 5;  ///< frames a view; a round draws every view once, so that noise hits all alike
};

/// Draws and times. A camera that the scene does not give is fitted first. `caches` should be fresh, else the
/// first frame is not one. An Error: the plan's, the renderer's, or "cancelled".
Result<Orbit> measureOrbit(const Scene& scene, const RenderOptions& options, const OrbitOptions& orbit,
                           RenderCaches& caches, const StudyProgress& progress = {},
                           const CancelToken& cancel = {});

/// All frames of all views.
std::vector<double> allFramesMs(const Orbit& orbit);
std::vector<double> allProcessorsMs(const Orbit& orbit);

/// As a table for people: a line a view, and one over all.
std::string orbitText(const Orbit& orbit);
/// One JSON object for scripts.
std::string orbitJson(const Orbit& orbit);

}  // namespace volumen
