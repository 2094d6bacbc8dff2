#pragma once

#include <string>

#include "viewer/plan/rules.h"

namespace volumen {

/// The line of an effect that is on or off; name and soundness are the table's.
inline Effect on(std::string reason) {
  return {.name = {}, .on = true, .sound = false, .reason = std::move(reason)};
}
inline Effect off(std::string reason) {
  return {.name = {}, .on = false, .sound = false, .reason = std::move(reason)};
}

/// A number in so many digits.
std::string inDigits(double x, int digits = 4);

/// "2 voxels", "0.25 voxel".
inline std::string inVoxels(double x) { return inDigits(x) + (x > 1 ? " voxels" : " voxel"); }

/// Whether the scene shows light, not a projection of values.
inline bool composite(const RuleInput& in) { return in.scene.mode == Mode::composite; }

/// What resamples: as asked, else OpenGL for the method that is OpenGL's alone, and the CPU.
Resampler resamplerOf(const RenderOptions& options);

/// Whether a level's promise is kept (design.md 2): by the CPU's planes, which know what values lie between
/// two samples. Other paths take plain steps.
inline bool keepsLevels(const RenderOptions& o) {
  return o.method == Method::planes && resamplerOf(o) == Resampler::cpu;
}

/// Lights that are on and not black.
int lightsThatShine(const Scene& scene);
/// Whether any of them is neither white nor grey.
bool lightIsColoured(const Scene& scene);
/// No sample's colour is brighter than this (picture.md 5: c D'' + S'').
double brightest(const Scene& scene);

// Rules of the table (rules.h) in files of their own: what draws, how rays are integrated, how light is
// computed, what changes the curve.
Effect decideMethod(const RuleInput& in, Plan& plan);
std::string methodCost(const RuleInput& in, const Plan& plan);
Effect decideResampler(const RuleInput& in, Plan& plan);
Effect decideBlending(const RuleInput& in, Plan& plan);
Effect decideIntegration(const RuleInput& in, Plan& plan);
/// "2354 rays of this picture, also followed cell by cell, tell of a PSNR of 45.3 dB at least and ...".
std::string toldBy(const PilotFinding& pilot);
/// Plan::pilotSteps of a plan that is complete else.
std::optional<PilotSteps> openSteps(const RuleInput& in, const Plan& plan);
Effect decideShader(const RuleInput& in, Plan& plan);
Effect decideCurveTable(const RuleInput& in, Plan& plan);
Effect decideFaintSamples(const RuleInput& in, Plan& plan);

}  // namespace volumen
