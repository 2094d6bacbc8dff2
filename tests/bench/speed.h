#pragma once

#include "tests/bench/cases.h"
#include "tests/bench/inputs.h"

namespace volumen::bench {

/// One line of the table of goals.
struct Goal {
  std::string what, measured, goal;
  bool reached = false;
};

/// What `bench_speed` was asked, read.
struct SpeedInputs {
  VolumePtr volume;
  std::vector<NamedScene> scenes;
  int rounds = 3, threads = 0;
};

/// Opaque sphere of four sizes, one and two threads, edits of light and curve, lit against unlit, the first
/// picture, memory. An Error: the renderer's.
Result<std::vector<Goal>> measureGoals(const SpeedInputs& in, RenderCaches& caches);
/// The same of 512 x 512 x 300 voxels.
Result<std::vector<Goal>> measureLargeVolume(const SpeedInputs& in);

/// What each effect costs or saves on the first scene: a Markdown table.
Result<std::string> effectTable(const SpeedInputs& in, RenderCaches& caches);
/// All scenes on each instruction set: a Markdown table.
Result<std::string> targetTable(const SpeedInputs& in, RenderCaches& caches);

}  // namespace volumen::bench
