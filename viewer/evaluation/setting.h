#pragma once

#include <string>
#include <vector>

#include "viewer/plan/options.h"

namespace volumen {

/// One way to draw a picture: all that a row of the study turns.
struct Setting {
  std::string knob;   ///< that was turned: "step", "precision", ..., or "grid" where several were
  std::string value;  ///< what it was turned to, in words: "1/4", "8 bits"
  RenderOptions options;
  double resolution = 1;  ///< of the picture's width and height; smaller ones are enlarged, bilinearly
  bool operator==(const Setting&) const = default;
};

/// One knob at a time, from the base: every value of every knob, the base itself first.
std::vector<Setting> oneKnobAtATime(const RenderOptions& base);

/// The grid of the knobs that matter for time: step, resolution, shader and where rays end; step by the other
/// methods.
std::vector<Setting> gridOfKnobs(const RenderOptions& base);

/// What the knobs are turned from: everything as the planner chooses it for a plain step small enough that
/// the other knobs' errors show.
RenderOptions studyBase(glm::ivec2 size, int threads);

/// A setting in a few words: "stop at 1/256", "planes, OpenGL"; where the value says it all, without the
/// knob.
std::string settingName(const Setting& setting);

/// "planes, OpenGL": by which the plots colour their points.
std::string methodName(const RenderOptions& options);

}  // namespace volumen
