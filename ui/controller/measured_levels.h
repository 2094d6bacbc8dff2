#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ui/workspace/quality_goal.h"
#include "viewer/evaluation/truth.h"
#include "viewer/plan/picture_text.h"

namespace volumen {

/// What a picture at a level takes, and how far it is from the reference.
struct MeasuredLevel {
  PictureLevel level;
  std::optional<double> ms;  ///< median of the frames drawn; none: not measured yet
  PictureError error;        ///< at the reference's well-conditioned pixels; where ms is there
  bool front = false;        ///< no finer level is faster
  Picture pixels;            ///< the reference's pixels as this level draws them
  std::shared_ptr<const Plan> plan;
  std::string failure;  ///< a sentence where it could not be drawn

  bool done() const { return ms || !failure.empty(); }
};

/// The levels of a scene on screen, as far as they are measured.
struct MeasuredLevels {
  std::shared_ptr<const Truth> truth;  ///< null: not computed yet
  std::vector<MeasuredLevel> levels;   ///< from the coarsest on
};

/// The levels to choose from, from the coarsest on.
const std::vector<PictureLevel>& pictureLevels();

/// "standard", "draft 1/4".
std::string levelName(PictureLevel level);

/// The level that a goal means; none as long as too little is measured to tell. Where no level is fast (or
/// accurate) enough, the fastest (most accurate).
std::optional<PictureLevel> levelFor(const QualityGoal& goal, const std::vector<MeasuredLevel>& levels);

/// Marks the levels of which no finer one is faster.
void markFront(std::vector<MeasuredLevel>& levels);

/// Returns the error that is stated of a level: no smaller than that of a finer one, whose promise is closer.
/// At the few pixels that are measured a coarser level may come out nearer by chance.
PictureError statedError(const std::vector<MeasuredLevel>& levels, std::size_t level);

/// What was measured of exactly the picture that this plan draws.
std::optional<MeasuredError> measuredError(const MeasuredLevels& measured, const Plan& plan);

}  // namespace volumen
