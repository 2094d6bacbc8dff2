#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ui/workspace/quality_goal.h"
#include "viewer/evaluation/truth.h"
#include "viewer/plan/picture_text.h"

namespace volumen {

/// The time and the error against the reference of a quality level.
struct MeasuredLevel {
  PictureLevel level;
  std::optional<double> ms;  ///< median of the drawn frames; empty if not measured yet
  PictureError error;        ///< at the well-conditioned pixels of the reference; valid if `ms` is set
  bool front = false;        ///< true if no finer level is faster
  Picture pixels;            ///< the pixels of the reference as this level draws them
  std::shared_ptr<const Plan> plan;
  std::string failure;  ///< a sentence if it could not be drawn

  bool done() const { return ms || !failure.empty(); }
};

/// The levels of a scene on screen, as far as they are measured.
struct MeasuredLevels {
  std::shared_ptr<const Truth> truth;  ///< null if not computed yet
  std::vector<MeasuredLevel> levels;   ///< coarsest first
};

/// Returns the available levels, coarsest first.
const std::vector<PictureLevel>& pictureLevels();

/// Returns a name: "standard", "draft 1/4".
std::string levelName(PictureLevel level);

/// Returns the level for a goal, or nothing while too little is measured. If no level is fast (or accurate)
/// enough, returns the fastest (or most accurate).
std::optional<PictureLevel> levelFor(const QualityGoal& goal, const std::vector<MeasuredLevel>& levels);

/// Marks the levels without a faster finer level.
void markFront(std::vector<MeasuredLevel>& levels);

/// Returns the error stated for a level, which is at least that of a finer level with a closer promise.
/// At the few measured pixels a coarser level may come out better by chance.
PictureError statedError(const std::vector<MeasuredLevel>& levels, std::size_t level);

/// Returns the measured error of exactly the picture that this plan draws.
std::optional<MeasuredError> measuredError(const MeasuredLevels& measured, const Plan& plan);

}  // namespace volumen
