#include "viewer/render/effect_costs.h"

#include <algorithm>

namespace volumen {

namespace {

// Work for a shaded sample relative to colour look-up and compositing, from operation counts of the kernels.
struct SampleWork {
  double colour = 1, gradient = 0, light = 0, shine = 0;
  double all() const { return colour + gradient + light + shine; }
};

constexpr double gradientWork = 3;  // three components at eight corners, against one density

SampleWork workOf(const Plan& plan) {
  SampleWork work;
  if (!plan.lit) return work;
  const auto lights = double(
      std::count_if(plan.scene.lights.begin(), plan.scene.lights.end(), [](const Light& l) { return l.on; }));
  // OpenGL resamples gradients together with densities.
  if (plan.resampler == Resampler::cpu) work.gradient = gradientWork;
  switch (plan.shader) {
    case Shader::map:  // one look-up for any number of lights
      work.light = 2;
      break;
    case Shader::table:
      work.light = 1;
      break;
    case Shader::automatic:
    case Shader::phong:
      work.light = 1 + lights;
      work.shine = plan.specular ? lights : 0;
      break;
  }
  return work;
}

// Checking for existing gradients is not a cost.
double onceMs(const RenderStats& stats) { return stats.gradientsMs < 1 ? 0 : stats.gradientsMs; }

class Costs {
 public:
  Costs(const Plan& plan, const RenderStats& stats) : plan_(plan), stats_(stats), work_(workOf(plan)) {}

  std::optional<EffectCost> operator()(const Effect& effect) const {
    if (!effect.on) return EffectCost{};
    if (effect.name == "method" || effect.name == "reference")
      return EffectCost{.ms = std::max(0.0, stats_.totalMs - stats_.gradientsMs)};
    if (effect.name == "segments") return EffectCost{.ms = stats_.surfacesMs};
    const bool gl = plan_.resampler == Resampler::gl;
    if (effect.name == "resampler") return gl ? std::optional(EffectCost{.ms = stats_.glMs}) : std::nullopt;
    if (effect.name == "integration" && !gl) return EffectCost{.ms = stats_.pilotMs + stats_.resampleMs};
    if (plan_.method == Method::gpu) return std::nullopt;
    return plan_.method == Method::preshaded ? ofVoxels(effect) : ofSamples(effect);
  }

 private:
  // All voxels are lit before the first sample.
  std::optional<EffectCost> ofVoxels(const Effect& effect) const {
    if (effect.name == "lighting") return EffectCost{.ms = stats_.shadeMs};
    if (effect.name == "gradients") return EffectCost{.onceMs = onceMs(stats_)};
    return std::nullopt;
  }

  std::optional<EffectCost> ofSamples(const Effect& effect) const {
    if (effect.name == "gradients" && work_.gradient > 0)
      return EffectCost{.ms = share(work_.gradient), .estimated = true, .onceMs = onceMs(stats_)};
    if (effect.name == "lighting") return EffectCost{.ms = share(work_.light), .estimated = true};
    if (effect.name == "specular") return EffectCost{.ms = share(work_.shine), .estimated = true};
    if (effect.name == "gradient opacity") {
      // Fetched before the opacity is known: part of resampling.
      const double fetched = gradientWork * double(stats_.composited), plain = double(stats_.resampled);
      return EffectCost{.ms = plain > 0 ? stats_.resampleMs * fetched / (plain + fetched) : 0,
                        .estimated = true};
    }
    // Skipping in projections depends on the values met by each ray.
    const bool composite = plan_.scene.mode == Mode::composite;
    if (effect.name == "empty blocks" && composite && plan_.visibleShare > 0)
      return EffectCost{.ms = -stats_.resampleMs * (1 / plan_.visibleShare - 1), .estimated = true};
    return std::nullopt;
  }

  double share(double work) const { return stats_.shadeMs * work / work_.all(); }

  const Plan& plan_;
  const RenderStats& stats_;
  const SampleWork work_;
};

}  // namespace

EffectCosts effectCosts(const Plan& plan, const RenderStats& stats) {
  const Costs costOf(plan, stats);
  EffectCosts costs;
  for (const Effect& effect : plan.effects) costs.push_back(costOf(effect));
  return costs;
}

}  // namespace volumen
