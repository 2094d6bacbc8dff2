#include "ui/controller/measured_levels.h"

#include <algorithm>

namespace volumen {

const std::vector<PictureLevel>& pictureLevels() {
  static const std::vector<PictureLevel> levels{{Quality::draft, 4}, {Quality::draft, 2},
                                                {Quality::draft, 1}, {Quality::standard, 1},
                                                {Quality::high, 1},  {Quality::exact, 1}};
  return levels;
}

std::string levelName(PictureLevel level) {
  const std::string name = qualityName(level.quality);
  return level.edge == 1 ? name : name + " 1/" + std::to_string(level.edge);
}

std::optional<PictureLevel> levelFor(const QualityGoal& goal, const std::vector<MeasuredLevel>& levels) {
  if (goal.aim == Aim::level) return goal.level;
  const MeasuredLevel* best = nullptr;
  for (const MeasuredLevel& l : levels) {
    if (!l.done()) return std::nullopt;
    if (!l.ms) continue;
    if (goal.aim == Aim::error) {
      best = &l;
      if (l.error.percentile99 <= goal.errorOf255) return l.level;
    } else {
      // Finer levels take even longer.
      if (*l.ms > goal.frameMs) return best ? best->level : l.level;
      best = &l;
    }
  }
  return best ? std::optional(best->level) : std::nullopt;
}

void markFront(std::vector<MeasuredLevel>& levels) {
  std::optional<double> fastest;  // of the finer levels
  for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
    level->front = level->ms && (!fastest || *level->ms <= *fastest);
    if (level->ms) fastest = std::min(*level->ms, fastest.value_or(*level->ms));
  }
}

PictureError statedError(const std::vector<MeasuredLevel>& levels, std::size_t level) {
  PictureError stated = levels[level].error;
  for (std::size_t finer = level + 1; finer < levels.size(); ++finer) {
    if (!levels[finer].ms) continue;
    const PictureError& error = levels[finer].error;
    stated.percentile99 = std::max(stated.percentile99, error.percentile99);
    stated.maximum = std::max(stated.maximum, error.maximum);
  }
  return stated;
}

std::optional<MeasuredError> measuredError(const MeasuredLevels& measured, const Plan& plan) {
  for (const MeasuredLevel& l : measured.levels)
    if (l.ms && l.plan && *l.plan == plan) {
      const Truth& truth = *measured.truth;
      return MeasuredError{l.error, truth.pixels.size() - truth.illConditioned(),
                           std::size_t(truth.size.x) * std::size_t(truth.size.y)};
    }
  return std::nullopt;
}

}  // namespace volumen
