#include "viewer/plan/picture_text.h"

#include "viewer/scene/scene_json.h"

namespace volumen {

const char* qualityName(Quality quality) {
  static constexpr const char* names[] = {"draft", "standard", "high", "exact"};
  return names[int(quality)];
}

namespace {

// DESIGN 2's promises, against the reference, in /255 of well-conditioned pixels.
const char* promise(Quality quality) {
  static constexpr const char* promises[] = {"means over 16 x 16 pixels within 3/255 RMSE of standard",
                                             "PSNR >= 42 dB, 99th percentile <= 8/255",
                                             "PSNR >= 52 dB, 99th percentile <= 2.5/255", "maximum <= 1/255"};
  return promises[int(quality)];
}

std::string levelText(const Plan& plan) {
  if (plan.method == Method::reference) return "reference";
  return plan.options.step ? "plain steps" : qualityName(plan.options.quality);
}

// What a level promises holds for what it chooses itself.
bool keepsThePromise(const RenderOptions& o) {
  return !o.stopAt && !o.opacityThreshold && !o.curveTable && o.gradient == GradientOperator::sobel;
}

std::string errorText(const Plan& plan) {
  if (plan.method == Method::reference) return "within 0.05/255 of the limit";
  if (!keepsThePromise(plan.options))
    return "not promised: thresholds, curve table or gradient operator were chosen by hand";
  return plan.options.step ? "that of the midpoint rule at this step" : promise(plan.options.quality);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> pictureText(const Plan& plan) {
  std::vector<std::pair<std::string, std::string>> text{{"Software", "volumen " VOLUMEN_VERSION},
                                                        {"Comment", "Not for clinical use"},
                                                        {"volumen-level", levelText(plan)},
                                                        {"volumen-error", errorText(plan)}};
  if (plan.method != Method::reference)
    text.push_back({"volumen-step", std::to_string(plan.stepVoxels) + " voxel"});
  text.push_back({"volumen-scene", sceneToJson(plan.scene)});
  return text;
}

}  // namespace volumen
