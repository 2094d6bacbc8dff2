#include "viewer/plan/picture_text.h"

#include <cstdio>

#include "viewer/plan/rule_lines.h"
#include "viewer/scene/scene_json.h"

namespace volumen {

const char* qualityName(Quality quality) {
  static constexpr const char* names[] = {"draft", "standard", "high", "exact"};
  return names[int(quality)];
}

const char* methodName(Method method) {
  static constexpr const char* names[] = {"planes", "blend", "preshaded", "gpu", "reference"};
  return names[int(method)];
}

namespace {

// DESIGN 2's promises, against the reference, in /255 of well-conditioned pixels.
std::string promise(Quality quality) {
  if (quality == Quality::draft) return "means over 16 x 16 pixels within 3/255 RMSE of standard";
  if (quality == Quality::exact) return "maximum <= 1/255";
  const LevelPromise p = promiseOf(quality);
  return "PSNR >= " + inDigits(p.leastPsnrDb) + " dB, 99th percentile <= " + inDigits(p.most99) + "/255";
}

std::string levelText(const Plan& plan) {
  if (plan.method == Method::reference) return "reference";
  return plan.options.step ? "plain steps" : qualityName(plan.options.quality);
}

// What was asked for that no level promises anything of.
std::string besides(const Plan& plan) {
  const RenderOptions& o = plan.options;
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if (plan.method == Method::preshaded) add("colours of voxels interpolated, not values");
  if (plan.shader == Shader::table) add("light from a table of 5-bit indices, in 8 bits");
  if (plan.shader == Shader::map && (o.shader == Shader::map || o.mapSize || o.mapLookup))
    add("light from a map of " + std::to_string(plan.mapSize) + " directions an edge, " +
        (plan.mapLookup == MapLookup::nearest ? "nearest" : "bilinear"));
  if (plan.blending == Blending::bits8)
    add("1/2 of 1/255 rounded off after each slice, colours above 1 cut off");
  if (plan.blending == Blending::bits16)
    add("1/2 of 1/65535 rounded off after each slice, colours above 1 cut off");
  if (plan.bits == 8) add("values and gradients of 8 bits");
  if (o.tolerance) add("a tolerance instead of a level's");
  if (o.stopAt || o.opacityThreshold || o.curveTable || o.gradient != GradientOperator::sobel)
    add("thresholds, curve table or gradient operator");
  return text;
}

// Of a projection that goes from cell to cell.
bool isExact(const Plan& plan) { return plan.cellByCell && plan.scene.mode != Mode::composite; }

std::string errorText(const Plan& plan) {
  if (plan.method == Method::reference) return "within 0.05/255 of the limit";
  const std::string chosen = besides(plan);
  if (!chosen.empty()) return "not promised, chosen by hand: " + chosen;
  if (isExact(plan)) return "exact, but for the rounding of floats";
  if (plan.options.step) return "that of the midpoint rule at this step";
  if (keepsLevels(plan.options)) return promise(plan.options.quality);
  return "not promised: plain steps of " + inVoxels(plan.stepVoxels) +
         " do not see what lies between two samples";
}

}  // namespace

std::string errorText(const MeasuredError& m) {
  char text[200];
  std::snprintf(
      text, sizeof text,
      "99 %% of pixels within %.3g/255, largest %.3g/255, RMSE %.3g/255, measured at %zu of %zu pixels",
      m.error.percentile99, m.error.maximum, m.error.rmse, m.pixels, m.ofPixels);
  return text;
}

std::vector<std::pair<std::string, std::string>> pictureText(const Plan& plan,
                                                             const std::optional<MeasuredError>& measured) {
  std::vector<std::pair<std::string, std::string>> text{{"Software", "volumen " VOLUMEN_VERSION},
                                                        {"Comment", "Not for clinical use"},
                                                        {"volumen-method", methodName(plan.method)},
                                                        {"volumen-level", levelText(plan)},
                                                        {"volumen-error", errorText(plan)}};
  if (plan.pilot && plan.pilot->kept) text.push_back({"volumen-error-pilot", toldBy(*plan.pilot)});
  if (measured) text.push_back({"volumen-error-measured", errorText(*measured)});
  if (plan.method != Method::reference)
    text.push_back({"volumen-step", isExact(plan)     ? "cell by cell"
                                    : plan.cellByCell ? "cell by cell, integrated and cut where it is uneven"
                                                      : inVoxels(plan.stepVoxels)});
  text.push_back({"volumen-scene", sceneToJson(plan.scene)});
  return text;
}

}  // namespace volumen
