#include "viewer/plan/rule_lines.h"

#include <algorithm>
#include <cmath>

#include "viewer/plan/cost_model.h"
#include "viewer/plan/visibility.h"
#include "viewer/volume/bytes.h"
#include "viewer/volume/gradients.h"

namespace volumen {

namespace {

Effect lighting(const RuleInput& in, Plan& plan) {
  plan.lit = composite(in) && (in.scene.shading.lit || in.options.full);
  if (!composite(in)) return off("a projection of values has no lighting");
  if (!in.scene.shading.lit)
    return plan.lit ? on("asked for in full, with the light of an unlit scene") : off("the scene is unlit");
  return on("the scene is lit by " + std::to_string(lightsThatShine(in.scene)) + " of " +
            std::to_string(in.scene.lights.size()) + " lights");
}

Effect specular(const RuleInput& in, Plan& plan) {
  const bool shines = in.scene.shading.lit && in.scene.shading.specular > 0 && lightsThatShine(in.scene) > 0;
  plan.specular = plan.lit && (shines || in.options.full);
  if (!plan.lit) return off("nothing is lit");
  if (!shines)
    return plan.specular
               ? on("asked for in full")
               : off(in.scene.shading.specular > 0 ? "no light shines" : "the material's specular is 0");
  return on("the material's specular is " + inDigits(in.scene.shading.specular));
}

Effect lightColour(const RuleInput& in, Plan& plan) {
  const bool coloured = in.scene.shading.lit && lightIsColoured(in.scene);
  plan.colouredLight = plan.lit && (coloured || in.options.full);
  if (!plan.lit) return off("nothing is lit");
  if (coloured) return on("a light has a colour: computed for red, green and blue");
  return plan.colouredLight ? on("asked for in full")
                            : off("no light has a colour: computed once for red, green and blue");
}

Effect gradientOpacity(const RuleInput& in, Plan& plan) {
  const auto& points = in.scene.transferFunction.gradientOpacity;
  const bool matters = std::any_of(points.begin(), points.end(), [](const auto& p) { return p.factor != 1; });
  plan.gradientOpacity = composite(in) && (matters || in.options.full);
  if (!composite(in)) return off("a projection of values has no opacity");
  if (!matters)
    return plan.gradientOpacity ? on("asked for in full") : off("its factor is 1 at every gradient");
  return on("the opacity depends on the gradient");
}

Effect gradients(const RuleInput&, Plan& plan) {
  plan.gradients = plan.lit || plan.gradientOpacity;
  if (!plan.gradients) return off("neither light nor opacity asks for them: no Sobel pass, no memory");
  return on(plan.lit ? "lighting needs the surface's direction" : "the gradient opacity needs them");
}

Effect gradientOperator(const RuleInput& in, Plan& plan) {
  plan.gradientOperator = in.options.gradient;
  if (!plan.gradients) return off("there are no gradients");
  switch (plan.gradientOperator) {
    case GradientOperator::central:
      return on("central differences, as asked");
    case GradientOperator::zuckerHummel:
      return on("Zucker and Hummel, as asked");
    case GradientOperator::sobel:
      break;
  }
  return on("Sobel, over all 26 neighbours: smooth, and turns with the object");
}

Effect clip(const RuleInput& in, Plan& plan) {
  const Clip& c = in.scene.clip;
  const bool box = c.boxLow != glm::dvec3(0) || c.boxHigh != glm::dvec3(1);
  plan.clip = box || !c.planes.empty() || in.options.full;
  if (!box && c.planes.empty())
    return plan.clip ? on("asked for in full")
                     : off("the clip box is the whole volume and there are no planes");
  return on(std::string(box ? "a clip box" : "no clip box") + " and " + std::to_string(c.planes.size()) +
            " planes cut the rays");
}

Effect segmentSurfaces(const RuleInput& in, Plan& plan) {
  const std::size_t count = shownSegments(in.scene).size();
  plan.segments = false;
  if (count == 0) return off("no segment shows");
  if (!composite(in)) return off("a projection of values has no surfaces");
  if (!keepsLevels(in.options))
    return off(
        "only rays that the CPU follows from the front meet surfaces: use --method planes or reference");
  plan.segments = true;
  return on("rays are cut where they meet " +
            (count == 1 ? "the surface of 1 segment" : "surfaces of " + std::to_string(count) + " segments"));
}

// True for planes and for CPU slices, which planes kernels blend.
bool isDrawnByPlanes(const RuleInput& in) {
  return in.options.method == Method::planes ||
         (in.options.method == Method::blend && resamplerOf(in.options) == Resampler::cpu);
}

// Skips blocks that cannot exceed (or undercut) the extreme met so far.
Effect outdoneBlocks(const RuleInput& in, Plan& plan) {
  if (in.scene.mode == Mode::average) return off("a mean looks at every value");
  if (!isDrawnByPlanes(in)) return off("this method looks at every sample");
  if (resamplerOf(in.options) == Resampler::gl) return off("OpenGL resamples every value of a projection");
  if (!in.facts.blockRanges) return off("nothing is known of the blocks");
  if (in.options.full) return off("asked for in full");
  plan.skipBlocks = true;
  return on(in.scene.mode == Mode::mip ? "what holds nothing larger than a ray has met is passed over"
                                       : "what holds nothing smaller than a ray has met is passed over");
}

Effect emptyBlocks(const RuleInput& in, Plan& plan) {
  plan.visibleShare = 1;
  plan.skipBlocks = false;
  if (!composite(in)) return outdoneBlocks(in, plan);
  if (!isDrawnByPlanes(in)) return off("this method looks at every sample");
  if (!in.facts.blockRanges) return off("nothing is known of the blocks");
  const BlockRanges& blockRanges = *in.facts.blockRanges;
  const std::int64_t visible = visibleBlockCount(plan.curve, blockRanges);
  plan.visibleShare = double(visible) / double(blockRanges.size());
  const std::string share =
      inDigits(100 * (1 - plan.visibleShare)) + " % of the blocks hold no visible value";
  if (in.options.full) return off("asked for in full; " + share);
  plan.skipBlocks = plan.visibleShare < 1;
  return plan.skipBlocks ? on(share) : off("every block holds a visible value");
}

// Limits the light that could still come from behind to this fraction of its brightness: at most 0.2/255,
// which leaves a fifth of 0.25/255 for rounding before.
double stopTransmittance(const RuleInput& in) {
  const RenderOptions& o = in.options;
  const double most = 0.2 / 255 / std::max(1.0, brightest(in.scene));
  // The promises of these levels are far coarser than this limit.
  if (!o.step && (o.quality == Quality::draft || o.quality == Quality::standard)) return most;
  // Steps above half a voxel have so much larger errors that a finer limit is not worth its time.
  const bool fine = o.quality == Quality::exact || o.step.value_or(1) <= 0.5;
  return std::min(fine ? 1.0 / 16384 : 1.0 / 4096, most);
}

std::string behind(const RuleInput& in, const Plan& plan) {
  const std::string share = in.options.stopAt
                                ? inDigits(*in.options.stopAt)
                                : "1/" + std::to_string(std::lround(1 / plan.stopTransmittance));
  return "less than " + share + " of the light behind comes through";
}

std::string asAsked(const RuleInput& in) { return in.options.stopAt ? ", as asked" : ""; }

// Slices come from the back. If skipping hidden samples pays, they are found from the front first, without
// light.
Effect earlyTerminationOfSlices(const RuleInput& in, Plan& plan) {
  if (resamplerOf(in.options) == Resampler::gl)
    return off("what comes from the back cannot know what will hide it");
  if (in.options.blending.value_or(Blending::floats) != Blending::floats)
    return off("slices that are rounded hide nothing for good");
  plan.stopTransmittance = in.options.stopAt.value_or(stopTransmittance(in));
  if (plan.stopTransmittance == 0) return off("every slice is blended, as asked");
  // If more of the visible matter is seen, blending all of it is faster, as measured.
  constexpr double mostSeen = 0.4;
  if (in.options.stopAt || seenShare(plan, in.facts) <= mostSeen)
    return on("what lies where " + behind(in, plan) + " is not blended: found from the front first" +
              asAsked(in));
  plan.stopTransmittance = 0;
  return off("too little is hidden for finding it from the front first");
}

Effect earlyRayTermination(const RuleInput& in, Plan& plan) {
  plan.stopTransmittance = 0;
  if (!composite(in)) return off("a projection looks at the whole ray");
  if (plan.method == Method::blend) return earlyTerminationOfSlices(in, plan);
  plan.stopTransmittance = in.options.stopAt.value_or(stopTransmittance(in));
  if (plan.stopTransmittance == 0) return off("every ray is followed to its end, as asked");
  return on("a ray ends where " + behind(in, plan) + asAsked(in));
}

// Returns a bound on the change of colour, as a fraction of white, per small turn of the normal.
double lightPerTurn(const Scene& scene) {
  double light = 0;
  for (const Light& l : scene.lights)
    if (l.on) light += l.intensity * std::max({l.colour.r, l.colour.g, l.colour.b});
  return light * (scene.shading.diffuse + scene.shading.specular * std::sqrt(scene.shading.shininess));
}

// Returns whether 16-bit gradients would blur small gradients that matter. Their error limits are 1/256 for a
// colour at the gradient floor (a quarter of that at `exact`) and 1/256 for ramps of gradient opacity. A
// step of gradient opacity allows no error. A few extreme values can make the packing that coarse.
bool packingIsCoarse(const RuleInput& in, GradientOperator by) {
  if (by == GradientOperator::sobel && !gradients16AreRounded(in.facts.range, in.facts.rescaleSlope))
    return false;
  double smallestPerMm = std::numeric_limits<double>::infinity();
  if (in.scene.shading.lit && *in.scene.shading.gradientFloor > 0) {
    const double finer = in.options.quality == Quality::exact ? 4 : 1;
    smallestPerMm = *in.scene.shading.gradientFloor / (finer * std::max(1.0, lightPerTurn(in.scene)));
  }
  const auto& points = in.scene.transferFunction.gradientOpacity;
  for (std::size_t n = 0; n + 1 < points.size(); ++n)
    if (const double rise = std::abs(points[n + 1].factor - points[n].factor); rise > 0)
      smallestPerMm = std::min(smallestPerMm, (points[n + 1].gradient - points[n].gradient) / rise);
  const glm::dvec3 spacing = in.facts.geometry.spacing();
  const double step =
      gradients16Scale(in.facts.range, in.facts.rescaleSlope) / std::min({spacing.x, spacing.y, spacing.z});
  return composite(in) && step / 2 > smallestPerMm / 256;
}

// Returns whether the curve rises within so few floats around 16-bit densities that its opacity would be off
// by more than a thousandth.
bool densitiesAreCoarse(const RuleInput& in) {
  constexpr double rounding = 0x1p-24, most = 1.0 / 1024;
  const auto& points = in.scene.transferFunction.points;
  for (std::size_t n = 0; n + 1 < points.size(); ++n) {
    const double low = points[n].value, high = points[n + 1].value;
    if (!(high > low) || high < in.facts.range.low || low > in.facts.range.high) continue;
    const double far = std::max(std::abs(low - in.facts.densityZero), std::abs(high - in.facts.densityZero));
    if (rounding * far > most * (high - low)) return true;
  }
  return false;
}

Effect inBytes(const RuleInput& in, Plan& plan) {
  plan.bits = 8;
  const bool exact = in.facts.integers && bytesHoldExactly(in.facts.range, in.facts.rescaleSlope);
  return on(std::string("8 bits, as asked: values ") +
            (exact ? "kept exactly" : "rounded to 1/255 of their range") +
            (plan.gradients ? ", gradients to 1/127 of the largest" : ""));
}

Effect precision(const RuleInput& in, Plan& plan) {
  if (in.options.precision == 8) return inBytes(in, plan);
  // 16 bits hold integers exactly, but a negative slope would reverse the order of values.
  const bool fits = in.facts.integers && in.facts.rescaleSlope > 0;
  // Texture hardware that filters 16 bits may keep only 8 bits of the position between voxels. On scenes with
  // thin bright shells that gave 0.7/255 RMSE at standard's steps.
  const bool coarse =
      resamplerOf(in.options) == Resampler::gl && plan.method != Method::preshaded && !in.options.precision &&
      (in.options.step || in.options.quality == Quality::high || in.options.quality == Quality::exact);
  const bool packed = fits && !in.options.precision && packingIsCoarse(in, plan.gradientOperator);
  const bool narrow = fits && !in.options.precision && composite(in) && densitiesAreCoarse(in);
  plan.bits = fits && !coarse && !packed && !narrow ? in.options.precision.value_or(16) : 32;
  if (!fits) return on("32 bits: 16-bit integers with a positive slope do not hold the values");
  if (packed)
    return on(
        "32 bits: gradients packed into 16 bits would be too coarse for this scene beside the extreme "
        "values");
  if (narrow)
    return on("32 bits: the curve rises within so few values that those of 16 bits would be too coarse");
  if (coarse) return on("32 bits, interpolated in floats: filters of texture hardware are too coarse here");
  return on(std::to_string(plan.bits) +
            (in.options.precision ? " bits, as asked" : " bits hold the stored integers exactly"));
}

// Skips plain steps in cells that show nothing (VisibleCells).
Effect emptyCells(const RuleInput& in, Plan& plan) {
  // Measured fraction above which testing takes longer than the samples it saves.
  constexpr double many = 0.6;
  // With floats only gradients are saved, as they are stored apart from densities: up to this fraction of
  // blocks.
  constexpr double manyBlocks = 0.3;
  plan.skipCells = false;
  if (!composite(in)) return off("a projection of values has no opacity");
  if (plan.cellByCell) return off("rays that go from cell to cell ask each of them anyway");
  if (plan.redoneAbove > 0) return off("steps of two lengths are compared only in cells that show anyway");
  if (plan.method != Method::planes || plan.resampler != Resampler::cpu)
    return off("there is no kernel that asks single cells");
  if (in.options.full) return off("asked for in full");
  if (!plan.skipBlocks) return off("there are no empty blocks either");
  if (plan.visibleShare == 0) return off("nothing shows");
  const double share = shareInVisibleBlocks(plan.curve, *in.facts.blockRanges);
  const std::string values = "in blocks that show something about " +
                             std::to_string(std::lround(100 * share)) + " % of the values do";
  if (plan.bits == 32 ? !plan.gradients || plan.visibleShare > manyBlocks : share > many) return off(values);
  plan.skipCells = true;
  return on(values + ": samples are taken in cells that can");
}

Effect gradientFetch(const RuleInput& in, Plan& plan) {
  if (!plan.gradients) return off("there are no gradients");
  const KernelKey kernel = kernelKey(plan);
  if (kernel.store == Store::plane || !isDrawnByPlanes(in))
    return on("at every sample: all of them are looked at");
  if (kernel.sampling == Sampling::passages) return on("once a cell, where something shows");
  if (kernel.store != Store::float32) return on("with every density: one load brings both");
  return on(kernel.sampling == Sampling::visibleCells ? "where opacity counts: few samples have any"
                                                      : "with every density: most samples are looked at");
}

}  // namespace

const std::vector<Rule>& rules() {
  static const std::vector<Rule> table = {
      {"method", false, decideMethod, methodCost},
      {"lighting", true, lighting},
      {"specular", true, specular},
      {"light colour", true, lightColour},
      {"gradient opacity", true, gradientOpacity},
      {"gradients", true, gradients},
      {"gradient operator", false, gradientOperator},
      {"clip", true, clip},
      {"segments", false, segmentSurfaces},
      {"integration", false, decideIntegration},
      {"curve table", false, decideCurveTable},
      {"faint samples", false, decideFaintSamples},
      {"empty blocks", true, emptyBlocks},
      {"early ray termination", false, earlyRayTermination},
      {"precision", false, precision},
      {"resampler", false, decideResampler},
      {"shader", false, decideShader},
      {"empty cells", true, emptyCells},
      {"gradient fetch", false, gradientFetch},
      {"blending", false, decideBlending},
  };
  return table;
}

}  // namespace volumen
