#pragma once

#include "viewer/evaluation/progress.h"
#include "viewer/render/render.h"

namespace volumen {

/// Drawing times of one view of an orbit.
struct OrbitView {
  double angleDegrees = 0;  ///< Rotation of the camera about its up axis.
  std::vector<double> framesMs;
  std::vector<double> processorsMs;  ///< Time of all processors together, per frame.
  RenderStats stats;                 ///< Statistics of the last frame.
};

/// Drawing times of a scene from all around (design.md 4, `bench`).
struct Orbit {
  Plan plan;                ///< Plan of the first view.
  double firstFrameMs = 0;  ///< Facts, blocks, gradients, plan and picture of a fresh volume.
  double gradientsMs = 0;   ///< Part of firstFrameMs for the Sobel pass and copies.
  std::vector<OrbitView> views;
};

/// Extent of the measurement.
struct OrbitOptions {
  int views = 8;   ///< The camera turns by 360 degrees / views each.
  int rounds = 5;  ///< Frames per view. A round draws every view once, so that noise affects all alike.
};

/// Draws and times the views. First fits a camera if the scene has none. `caches` should be fresh, else the
/// first frame is not a true first frame. Returns the plan's or the renderer's Error, or "cancelled".
Result<Orbit> measureOrbit(const Scene& scene, const RenderOptions& options, const OrbitOptions& orbit,
                           RenderCaches& caches, const StudyProgress& progress = {},
                           const CancelToken& cancel = {});

/// Returns the times of all frames of all views.
std::vector<double> allFramesMs(const Orbit& orbit);
std::vector<double> allProcessorsMs(const Orbit& orbit);

/// Returns a table for people: one line per view, and one over all views.
std::string orbitText(const Orbit& orbit);
/// Returns one JSON object for scripts.
std::string orbitJson(const Orbit& orbit);

}  // namespace volumen
