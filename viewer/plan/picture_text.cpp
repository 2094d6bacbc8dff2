#include "viewer/plan/picture_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "viewer/plan/rule_lines.h"
#include "viewer/scene/scene_json.h"

namespace volumen {

const char* methodName(Method method) {
  static constexpr const char* names[] = {"planes", "blend", "preshaded", "gpu", "reference"};
  return names[int(method)];
}

namespace {

std::string levelText(const Plan& plan) {
  if (plan.method == Method::reference) return "reference";
  return plan.options.step ? "plain steps" : qualityName(plan.options.quality);
}

std::string joined(std::initializer_list<std::string> parts) {
  std::string text;
  for (const std::string& part : parts)
    if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
  return text;
}

// Returns an empty text if the map was not requested.
std::string mapAsked(const Plan& plan) {
  const RenderOptions& o = plan.options;
  if (plan.shader != Shader::map || !(o.shader == Shader::map || o.mapSize || o.mapLookup)) return {};
  return "light from a map of " + std::to_string(plan.mapSize) + " directions an edge, " +
         (plan.mapLookup == MapLookup::nearest ? "nearest" : "bilinear");
}

// Returns the requested options for which no level makes a promise.
std::string besides(const Plan& plan) {
  const RenderOptions& o = plan.options;
  const bool others = o.stopAt || o.opacityThreshold || o.curveTable || o.gradient != GradientOperator::sobel;
  return joined(
      {plan.method == Method::preshaded ? "colours of voxels interpolated, not values" : "",
       plan.shader == Shader::table ? "light from a table of 5-bit indices, in 8 bits" : "", mapAsked(plan),
       plan.blending == Blending::bits8 ? "1/2 of 1/255 rounded off after each slice, colours above 1 cut off"
                                        : "",
       plan.blending == Blending::bits16
           ? "1/2 of 1/65535 rounded off after each slice, colours above 1 cut off"
           : "",
       plan.bits == 8 ? "values and gradients of 8 bits" : "",
       o.tolerance ? "a tolerance instead of a level's" : "",
       others ? "thresholds, curve table or gradient operator" : ""});
}

// True for projections that go from cell to cell.
bool isExact(const Plan& plan) { return plan.cellByCell && plan.scene.mode != Mode::composite; }

// Returns whether a picture of this plan keeps the promise of its level.
bool keepsItsLevel(const Plan& plan) {
  return plan.method != Method::reference && !plan.options.step && keepsLevels(plan.options) &&
         besides(plan).empty();
}

std::string errorText(const Plan& plan) {
  if (plan.method == Method::reference) return "within 0.05/255 of the limit";
  const std::string chosen = besides(plan);
  if (!chosen.empty()) return "not promised, chosen by hand: " + chosen;
  if (isExact(plan)) return "exact, but for the rounding of floats";
  if (plan.options.step) return "that of the midpoint rule at this step";
  if (keepsLevels(plan.options)) return promiseText(plan.options.quality);
  return "not promised: plain steps of " + inVoxels(plan.stepVoxels) +
         " do not see what lies between two samples";
}

}  // namespace

std::optional<PictureError> estimateOf(const Plan& plan, const std::vector<float>& map255) {
  std::optional<PictureError> e = estimateOf(map255);
  if (!e || !keepsItsLevel(plan)) return e;
  const LevelPromise& promised = promiseOf(plan.options.quality);
  e->maximum = std::min(e->maximum, promised.mostMaximum);
  e->percentile99 = std::min({e->percentile99, promised.most99, e->maximum});
  e->rmse = std::min({e->rmse, e->maximum, 255 / std::pow(10, promised.leastPsnrDb / 20)});
  if (e->rmse > 0) e->psnrDb = std::max(promised.leastPsnrDb, 20 * std::log10(255 / e->rmse));
  return e;
}

std::string notEstimated(const Plan& plan) {
  const RenderOptions& o = plan.options;
  return joined({mapAsked(plan), o.opacityThreshold ? "faint samples left out" : "",
                 o.curveTable ? "a table of the curve" : "",
                 o.gradient != GradientOperator::sobel ? "another gradient operator" : ""});
}

namespace {

// Rounds up to two digits, or three from 100 on.
std::string atMost(double x) {
  const double unit = std::min(1.0, std::pow(10, std::floor(std::log10(x)) - 1));
  const double up = unit * std::ceil(x / unit - 1e-6);
  return inDigits(up, up < 100 ? 2 : 3) + "/255";
}

}  // namespace

std::string estimateText(const Plan& plan, const PictureError& e) {
  const std::string without = notEstimated(plan), but = without.empty() ? "" : "; without that of " + without;
  if (isRoundingAlone(e)) return "none but the rounding of floats" + but;
  const std::string most99 = e.percentile99 > 0 ? atMost(e.percentile99) : "0/255";
  const bool isBound = plan.cellByCell;
  return (isBound ? "at most " : "predicted by rays of the picture, no bound: at most ") + atMost(e.maximum) +
         ", 99th percentile " + most99 + ", PSNR at least " + inDigits(std::floor(e.psnrDb), 3) + " dB" + but;
}

std::string whyNoEstimate(const Plan& plan) {
  if (plan.method == Method::reference) return "The reference is within 0.05/255 of the limit by itself.";
  if (plan.cellByCell) return "The picture is not drawn yet.";
  return "The picture was sampled at fixed steps, which do not tell how far off each pixel is.";
}

std::string errorText(const MeasuredError& m) {
  char text[200];
  std::snprintf(
      text, sizeof text,
      "99 %% of pixels within %.3g/255, largest %.3g/255, RMSE %.3g/255, measured at %zu of %zu pixels",
      m.error.percentile99, m.error.maximum, m.error.rmse, m.pixels, m.ofPixels);
  return text;
}

std::vector<std::pair<std::string, std::string>> pictureText(const Plan& plan, const KnownError& known) {
  std::vector<std::pair<std::string, std::string>> text{{"Software", "volumen " VOLUMEN_VERSION},
                                                        {"Comment", "Not for clinical use"},
                                                        {"volumen-method", methodName(plan.method)},
                                                        {"volumen-level", levelText(plan)},
                                                        {"volumen-error", errorText(plan)}};
  if (const std::string cut = cutText(plan.cut); !cut.empty()) text.push_back({"volumen-cut", cut});
  if (!plan.cellByCell && tellsError(plan)) text.push_back({"volumen-error-pilot", toldBy(*plan.pilot)});
  if (known.estimated) text.push_back({"volumen-error-estimated", estimateText(plan, *known.estimated)});
  if (known.measured) text.push_back({"volumen-error-measured", errorText(*known.measured)});
  if (plan.method != Method::reference)
    text.push_back({"volumen-step", isExact(plan)     ? "cell by cell"
                                    : plan.cellByCell ? "cell by cell, integrated with error control"
                                                      : inVoxels(plan.stepVoxels)});
  text.push_back({"volumen-scene", sceneToJson(plan.scene)});
  return text;
}

}  // namespace volumen
