#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "viewer/plan/options.h"
#include "viewer/scene/scene.h"

namespace volumen {

/// The options that choose a scene and how it is drawn (DESIGN 4), as typed.
struct SceneOptions {
  std::string sceneFile, preset, view, projection, mode, size = "512x512";
};

/// Adds --scene, --preset, --view, --projection, --size and --mode.
void addSceneOptions(CLI::App& app, SceneOptions& options);

/// The scene for a volume: file or preset, then the single overrides. The Error names the file or option.
Result<Scene> makeScene(const SceneOptions& options, const Volume& volume);

/// The options that choose accuracy and method, as typed.
struct MethodOptions {
  std::string quality, method = "planes", resampler, shader = "auto", mapLookup, gradient = "sobel", blending;
  std::optional<double> step, tolerance, stopAt, opacityThreshold;
  std::optional<int> precision, mapSize, curveTable, threads;
  bool reference = false, full = false;
};

/// Adds --quality, --step, --reference, --method, --resampler, --blending, --precision, --shader, --map-size,
/// --map-lookup, --tolerance, --stop-at, --opacity-threshold, --curve-table, --gradient, --threads and
/// --full.
void addMethodOptions(CLI::App& app, MethodOptions& options);

/// Both together as the planner reads them. The Error (wrong usage) names the options that do not go
/// together.
Result<RenderOptions> renderOptions(const SceneOptions& scene, const MethodOptions& method);

/// What the planner would refuse, before anything is measured: options that the scene does not go with. It
/// looks at nothing of the volume but its geometry.
Status checkPlan(const Scene& scene, const Volume& volume, const RenderOptions& options);

}  // namespace volumen
