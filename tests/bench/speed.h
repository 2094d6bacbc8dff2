#pragma once

#include "tests/bench/cases.h"
#include "tests/bench/inputs.h"

namespace volumen::bench {

/// A row of the table of goals.
struct Goal {
  std::string what, measured, goal;
  bool reached = false;
};

/// Input of `bench_speed`, already read.
struct SpeedInputs {
  VolumePtr volume;
  std::vector<NamedScene> scenes;
  int rounds = 3, threads = 0;
};

/// Measures opaque spheres of four sizes, one and two threads, edits of light and curve, lit against unlit,
/// the first picture, and memory. An Error is the renderer's.
Result<std::vector<Goal>> measureGoals(const SpeedInputs& in, RenderCaches& caches);
/// Measures the same with 512 x 512 x 300 voxels.
Result<std::vector<Goal>> measureLargeVolume(const SpeedInputs& in);

/// Returns the cost or saving of each effect on the first scene as a Markdown table.
Result<std::string> effectTable(const SpeedInputs& in, RenderCaches& caches);
/// Returns the times of all scenes on each instruction set as a Markdown table.
Result<std::string> targetTable(const SpeedInputs& in, RenderCaches& caches);

}  // namespace volumen::bench
