#pragma once

#include <string>

#include "viewer/plan/rules.h"

namespace volumen {

/// Returns the line of an effect that is on or off; name and soundness come from the table.
inline Effect on(std::string reason) {
  return {.name = {}, .on = true, .sound = false, .reason = std::move(reason)};
}
inline Effect off(std::string reason) {
  return {.name = {}, .on = false, .sound = false, .reason = std::move(reason)};
}

/// Formats a number with `digits` significant digits.
std::string inDigits(double x, int digits = 4);

/// Returns for example "2 voxels" or "0.25 voxel".
inline std::string inVoxels(double x) { return inDigits(x) + (x > 1 ? " voxels" : " voxel"); }

/// Returns whether the scene shows light and not a projection of values.
inline bool composite(const RuleInput& in) { return in.scene.mode == Mode::composite; }

/// Returns the requested resampler, else OpenGL for the OpenGL-only method and the CPU for others.
Resampler resamplerOf(const RenderOptions& options);

/// Returns whether the level's promise is kept (design.md 2). Only planes on the CPU know the values between
/// two samples; other paths take plain steps.
inline bool keepsLevels(const RenderOptions& o) {
  return o.method == Method::planes && resamplerOf(o) == Resampler::cpu;
}

/// Returns the number of lights that are on and not black.
int lightsThatShine(const Scene& scene);
/// Returns whether any light is neither white nor grey.
bool lightIsColoured(const Scene& scene);
/// Returns an upper bound of a sample's colour (picture.md 5: c D'' + S'').
double brightest(const Scene& scene);

// Rules of the table (rules.h) in separate files: method, integration of rays, lighting, and changes of the
// curve.
Effect decideMethod(const RuleInput& in, Plan& plan);
std::string methodCost(const RuleInput& in, const Plan& plan);
Effect decideResampler(const RuleInput& in, Plan& plan);
Effect decideBlending(const RuleInput& in, Plan& plan);
Effect decideIntegration(const RuleInput& in, Plan& plan);
/// Returns for example "2354 rays of this picture, also followed cell by cell, tell of a PSNR of 45.3 dB at
/// least and ...".
std::string toldBy(const PilotFinding& pilot);
/// Returns Plan::pilotSteps for a plan that is complete otherwise.
std::optional<PilotSteps> openSteps(const RuleInput& in, const Plan& plan);
Effect decideShader(const RuleInput& in, Plan& plan);
Effect decideCurveTable(const RuleInput& in, Plan& plan);
Effect decideFaintSamples(const RuleInput& in, Plan& plan);

}  // namespace volumen
