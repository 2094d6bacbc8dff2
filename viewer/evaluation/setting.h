#pragma once

#include <string>
#include <vector>

#include "viewer/plan/options.h"

namespace volumen {

/// One way to draw a picture: all that a row of the study can vary.
struct Setting {
  std::string knob;   ///< The knob that was turned: "step", "precision", ..., or "grid" for several.
  std::string value;  ///< The knob's setting in words: "1/4", "8 bits".
  RenderOptions options;
  /// Scale of the picture's width and height. Smaller pictures are enlarged bilinearly.
  double resolution = 1;
  bool operator==(const Setting&) const = default;
};

/// Returns the base, then every value of every knob with all other knobs at the base.
std::vector<Setting> oneKnobAtATime(const RenderOptions& base);

/// Returns a grid of the knobs that matter for time: step, resolution, shader and where rays end. For the
/// other methods only the step varies.
std::vector<Setting> gridOfKnobs(const RenderOptions& base);

/// Returns the base from which knobs are turned: the planner's choices at a plain step so small that the
/// errors of the other knobs show.
RenderOptions studyBase(glm::ivec2 size, int threads);

/// Returns a setting in a few words: "stop at 1/256", "planes, OpenGL". The knob is left out if the value
/// says it all.
std::string settingName(const Setting& setting);

/// Returns e.g. "planes, OpenGL"; the plots colour their points by it.
std::string methodName(const RenderOptions& options);

}  // namespace volumen
