#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "viewer/plan/options.h"
#include "viewer/scene/scene.h"

namespace volumen {

/// The options that choose a scene and how it is drawn (design.md 4), as typed.
struct SceneOptions {
  std::string sceneFile, preset, view, projection, mode, size = "512x512";
};

/// Adds --scene, --preset, --list-presets, --view, --projection, --size and --mode.
void addSceneOptions(CLI::App& app, SceneOptions& options);

/// The scene of --scene, a scene file or a picture that holds one; none where the option is not given. Read
/// before anything is loaded. The Error names the file.
Result<std::optional<Scene>> readScene(const SceneOptions& options);

/// The scene for a volume: `file`'s (readScene) or the preset's, then the single overrides.
Result<Scene> makeScene(const SceneOptions& options, const std::optional<Scene>& file, const Volume& volume);

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

/// Whether neither a level nor what takes its place is asked for.
bool leavesLevelOpen(const MethodOptions& options);

/// Adds --threads.
void addThreads(CLI::App& app, std::optional<int>& threads);

/// Both together as the planner reads them. The Error (wrong usage) names what is unknown or does not go
/// together.
Result<RenderOptions> renderOptions(const SceneOptions& scene, const MethodOptions& method);

/// What the planner would refuse of a scene made by makeScene, asked before a volume is loaded: options that
/// do not go together. A projection that --preset auto alone may choose is not known yet.
Status checkPlan(const SceneOptions& options, const std::optional<Scene>& file, const RenderOptions& asked);

}  // namespace volumen
