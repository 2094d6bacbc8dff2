#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "viewer/plan/options.h"
#include "viewer/scene/scene.h"

namespace volumen {

/// The options that choose a scene and its display (design.md 4), as typed.
struct SceneOptions {
  std::string sceneFile, preset, view, projection, mode, size = "512x512";
};

/// Adds --scene, --preset, --list-presets, --view, --projection, --size and --mode.
void addSceneOptions(CLI::App& app, SceneOptions& options);

/// Reads the scene of --scene, from a scene file or a picture with a scene, before a volume is loaded. Empty
/// without the option. The Error names the file.
Result<std::optional<Scene>> readScene(const SceneOptions& options);

/// Returns the scene for a volume: that of `file` (readScene()) or of the preset, with single options
/// applied.
Result<Scene> makeScene(const SceneOptions& options, const std::optional<Scene>& file, const Volume& volume);

/// The options that choose accuracy and method, as typed.
struct MethodOptions {
  std::string quality, method = "planes", resampler, shader = "auto", mapLookup, gradient = "sobel", blending;
  std::optional<double> step, tolerance, stopAt, opacityThreshold;
  std::optional<int> precision, mapSize, curveTable, threads;
  bool reference = false, full = false;
};

/// Adds --quality.
CLI::Option* addQuality(CLI::App& app, MethodOptions& options);
/// Adds --quality, --step, --reference, --method, --resampler, --blending, --precision, --shader, --map-size,
/// --map-lookup, --tolerance, --stop-at, --opacity-threshold, --curve-table, --gradient, --threads and
/// --full.
void addMethodOptions(CLI::App& app, MethodOptions& options);

/// True if no option sets a level of quality or replaces it.
bool leavesLevelOpen(const MethodOptions& options);

/// Adds --threads.
void addThreads(CLI::App& app, std::optional<int>& threads);

/// Returns the planner's options. The Error (wrong usage) names unknown or contradictory ones.
Result<RenderOptions> renderOptions(const SceneOptions& scene, const MethodOptions& method);

/// Checks before a volume is loaded that the planner accepts a scene of makeScene(). The Error: options
/// contradict each other. The projection that --preset auto would choose is not known yet.
Status checkPlan(const SceneOptions& options, const std::optional<Scene>& file, const RenderOptions& asked);

}  // namespace volumen
