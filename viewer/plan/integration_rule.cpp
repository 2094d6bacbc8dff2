// Choice of the integration of rays: cell by cell, or by plain steps.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "viewer/plan/check_options.h"
#include "viewer/plan/cost_model.h"
#include "viewer/plan/resonance.h"
#include "viewer/plan/rule_lines.h"
#include "viewer/plan/smoothness.h"
#include "viewer/scene/step_length.h"

namespace volumen {

namespace {

// Returns whether the opacity jumps, or rises within `narrow` values: values between two samples then matter.
bool isSharp(const TransferFunction& curve, double narrow) {
  for (std::size_t n = 0; n + 1 < curve.points.size(); ++n) {
    const CurvePoint &a = curve.points[n], &b = curve.points[n + 1];
    if (std::abs(b.opacity - a.opacity) > 0.05 && double(b.value) - a.value <= narrow) return true;
  }
  return false;
}

// Limits of plain steps for matter that changes little between voxels: longest and shortest step (shorter
// ones take longer than cell by cell), change of extinction per voxel times the squared step, and light per
// voxel times the step. Noise and plates and stripes of one voxel keep the level's promise at these limits.
struct EvenSteps {
  double longest, shortest, extinction, light;
};
EvenSteps evenStepsOf(Quality quality) {
  switch (quality) {
    case Quality::draft:  // the same steps as standard give the same means
    case Quality::standard:
      return {3.0 / 8, 3.0 / 16, 0.16, 0.044};
    case Quality::high:
      return {1.0 / 4, 1.0 / 4, 0.03, 0};
    case Quality::exact:
      break;
  }
  return {1.0 / 4, 1.0 / 8, 0.006, 0};
}

// Returns the longest length of a one-voxel step on any ray, mm. In perspective it is a bound: the largest
// spacing if the grid is not sheared.
double longestVoxelMm(const Camera& camera, const VoxelGeometry& geometry) {
  if (camera.projection == Projection::parallel) return stepMm(camera, geometry, 1);
  const glm::dmat3 squares = glm::transpose(geometry.patientFromVoxelStep) * geometry.patientFromVoxelStep;
  double most = 0;
  for (int n = 0; n < 3; ++n)
    most = std::max(most, std::abs(squares[n].x) + std::abs(squares[n].y) + std::abs(squares[n].z));
  return std::sqrt(most);
}

// Bounds for plain steps: contribution of a voxel to a ray, and its change along the ray.
struct EvenStep {
  double voxels, most, change;
};

// Returns the largest contribution of a voxel to a ray, as a fraction of white.
double mostOfVoxel(const RuleInput& in, const Steepness& s) {
  const double voxelMm = longestVoxelMm(*in.scene.camera, in.facts.geometry);
  return -std::expm1(-s.perMm * voxelMm) * std::max(1.0, brightest(in.scene));
}

// Returns whether the level applies without manual choices.
bool isWholeLevel(const RenderOptions& o) {
  return !o.step && !o.tolerance && !o.curveTable && !o.opacityThreshold;
}

// Returns the longest plain step that keeps the level's promise, also for lattices: it is shortened a little
// if all samples would meet the same places of their cells. Empty if there is none.
std::optional<EvenStep> evenStep(const RuleInput& in) {
  const RenderOptions& o = in.options;
  if (in.facts.gradientBounds.empty() || !isWholeLevel(o) || o.withError) return {};
  if (!in.scene.transferFunction.gradientOpacity.empty()) return {};
  // Along a slope of values a comb of peaks repeats, and all samples may meet the same place of each tooth.
  constexpr int mostTurns = 8;
  if (turnsOf(in.scene.transferFunction) > mostTurns) return {};
  const Steepness s = steepnessOf(in.scene.transferFunction, in.facts);
  const double bright = std::max(1.0, brightest(in.scene));
  const double voxelMm = longestVoxelMm(*in.scene.camera, in.facts.geometry);
  const double change = s.change * voxelMm * bright, most = s.perMm * voxelMm * bright;
  const EvenSteps even = evenStepsOf(o.quality);
  const glm::dvec3 alongVoxel = alongVoxelOf(*in.scene.camera, in.facts.geometry);
  constexpr double little = 0.85;
  for (double step = even.longest; step >= even.shortest; step /= 2) {
    // Light may change sign anywhere within a voxel; extinction changes along all of it.
    if (in.scene.shading.lit && most * step > even.light) continue;
    if (change * step * step > even.extinction) continue;
    if (const auto kept = stepWithoutResonance(alongVoxel, step, little * step))
      return EvenStep{*kept, mostOfVoxel(in, s), change};
  }
  return {};
}

// Returns whether the curve is too sharp for plain steps, whatever the volume's values between samples.
bool isSharpFor(const RuleInput& in) {
  return isSharp(in.scene.transferFunction, (in.facts.p999 - in.facts.p01) / 50);
}

// Returns the largest error, as a fraction of white, that pixels missed by a pilot may have: it knows nothing
// about a few rays in thousands. `high` promises a third of the error.
double mostMissed(Quality quality) { return quality == Quality::high ? 0.08 : 0.25; }

// Returns whether a voxel is opaque enough to hide what lies behind it, so that rays may be far off.
bool canHide(const RuleInput& in) {
  return mostOfVoxel(in, steepnessOf(in.scene.transferFunction, in.facts)) > mostMissed(in.options.quality);
}

// First step to try for a draft, voxels: one of few that spread evenly over the cells.
constexpr double firstInDrafts = 0.7236;

// Returns a step near the typical result for bone in CT at `standard`, so that a second try is seldom far
// off; for thin matter a longer one. It must not be a simple fraction of a voxel.
double firstStep(Quality quality, bool hides) {
  if (quality == Quality::standard) return hides ? 0.4198 : 0.7236;
  return hides ? 0.2165 : 0.3052;
}

// Returns Plan::redoneAbove of a level: four times its promise for 99 % of pixels.
double redoneAbove(Quality quality) { return 4 * promiseOf(quality).most99 / 255; }

// Returns the steps for a pilot, without `shortest`. Where a voxel is opaque enough to hide what lies behind
// it, a pilot may overlook rays that are far off. There the picture compares steps of two lengths and redoes
// rays that differ.
std::optional<PilotSteps> stepsOfMatter(const RuleInput& in) {
  if (!canIntegrate(in.scene, in.options) || in.facts.gradientBounds.empty()) return {};
  if (isSharpFor(in)) return {};
  const Quality quality = in.options.quality;
  if (quality == Quality::draft) return PilotSteps{0, firstInDrafts};
  const bool hides = canHide(in);
  return PilotSteps{0, firstStep(quality, hides), hides ? redoneAbove(quality) : 0};
}

// True for projections by planes on the CPU, the only ones that follow rays through cells.
bool goesFromCellToCell(const RuleInput& in) {
  return !composite(in) && in.options.method == Method::planes && resamplerOf(in.options) == Resampler::cpu;
}

Effect plainSteps(const Plan& plan, const std::string& why) {
  return on("plain steps of " + inVoxels(plan.stepVoxels) + why);
}

std::string redoneText(const Plan& plan) {
  if (plan.redoneAbove == 0) return {};
  return ", rays that every other step alone would change by more than " +
         inDigits(255 * plan.redoneAbove, 3) + "/255 cell by cell";
}

// Decides for paths that can go from cell to cell; `tried` tells of steps that a pilot rejected.
Effect integrated(const RuleInput& in, Plan& plan, const std::string& tried) {
  if (const auto even = evenStep(in)) {
    plan.stepVoxels = even->voxels;
    return plainSteps(plan, ": a voxel adds at most " + inDigits(even->most, 2) +
                                " to a ray, and the curve's slope times that of the values is at most " +
                                inDigits(even->change, 2) + " a voxel" + tried);
  }
  plan.stepVoxels = 2;  // stops at which rays test blocks around them
  plan.cellByCell = true;
  plan.errorBudget = in.options.tolerance.value_or(levelOf(in.options.quality).rayBudget / 255);
  return on(
      "cell by cell, integrated through the curve: cut where it bends, then until each part of a ray is "
      "expected to be off by no more than its share of " +
      inDigits(255 * plan.errorBudget, 3) + "/255" + (in.options.tolerance ? ", as asked" : "") + tried);
}

// Decides for all other paths.
Effect stepped(const RuleInput& in, Plan& plan, const std::string& tried) {
  plan.stepVoxels = levelOf(in.options.quality).stepVoxels;
  if (composite(in) && !isSharpFor(in)) return plainSteps(plan, ": the curve is smooth");
  // Means over pixels of a draft average out the errors of many rays.
  if (in.scene.mode != Mode::average || in.options.quality != Quality::draft) plan.stepVoxels /= 2;
  return plainSteps(
      plan, (composite(in) ? ": the curve has a step" : ": extremes and means lie between coarser samples") +
                tried);
}

}  // namespace

std::string toldBy(const PilotFinding& pilot) {
  if (pilot.rays == 0) return "no ray that was tried shows anything";
  if (pilot.psnrDb == 0)
    return std::to_string(pilot.rays) +
           " rays of this picture, also followed cell by cell, tell of means over blocks within " +
           inDigits(std::ceil(100 * pilot.blockRmse) / 100, 3) + "/255 and a mean colour within " +
           inDigits(std::ceil(100 * pilot.meanColour) / 100, 3) + "/255";
  // Rounded towards the weaker promise.
  return std::to_string(pilot.rays) +
         " rays of this picture, also followed cell by cell, tell of a PSNR of " +
         inDigits(std::floor(10 * pilot.psnrDb) / 10) + " dB at least and a 99th percentile of " +
         inDigits(std::ceil(100 * pilot.percentile99) / 100, 3) + "/255 at most";
}

std::optional<PilotSteps> openSteps(const RuleInput& in, const Plan& plan) {
  const RenderOptions& o = in.options;
  if (o.full) {  // sound rules change no choice
    RenderOptions lean = o;
    lean.full = false;
    return makePlan(in.scene, in.facts, lean)->pilotSteps;
  }
  // The pilot of a draft does not tell the error of each pixel.
  if (o.quality == Quality::draft && o.withError) return {};
  // No sample of rays can promise a maximum.
  if (o.quality == Quality::exact || !isWholeLevel(o)) return {};
  // The rays needed for a 99th percentile would be too large a share of smaller pictures, and would miss the
  // ends of strips.
  const bool isSmall = double(o.size.x) * o.size.y < 384.0 * 384 || std::min(o.size.x, o.size.y) < 128;
  if (isSmall && o.quality != Quality::draft) return {};
  auto steps = stepsOfMatter(in);
  if (!steps || (steps->redoneAbove > 0 && !plan.cellByCell)) return {};
  Plan plain = plan;
  plain.stepVoxels = steps->first;
  plain.cellByCell = false;
  // A pilot takes about a tenth of a frame, so steps must save more than that.
  constexpr double worthwhile = 0.81;
  const double share = predictedCost(plain, in.facts).ns() / predictedCost(plan, in.facts).ns();
  if (!(share <= worthwhile)) return {};
  steps->shortest = steps->first * share / worthwhile;
  return steps;
}

Effect decideIntegration(const RuleInput& in, Plan& plan) {
  if (in.options.step) {
    plan.stepVoxels = *in.options.step;
    return plainSteps(plan, ", as asked");
  }
  if (goesFromCellToCell(in)) {
    plan.stepVoxels = 2;  // stops at which rays test blocks around them
    plan.cellByCell = true;
    return on(std::string("cell by cell: ") + (in.scene.mode == Mode::average ? "means" : "extremes") +
              " are exact");
  }
  if (in.pilot && in.pilot->kept) {
    plan.stepVoxels = in.pilot->stepVoxels;
    plan.redoneAbove = in.pilot->redoneAbove;
    return plainSteps(plan, redoneText(plan) + ": " + toldBy(*in.pilot));
  }
  const std::string tried =
      in.pilot ? "; not plain steps of " + inVoxels(in.pilot->stepVoxels) + ", as " + toldBy(*in.pilot) : "";
  return canIntegrate(in.scene, in.options) ? integrated(in, plan, tried) : stepped(in, plan, tried);
}

}  // namespace volumen
