#include "ui/controller/measured_levels.h"

#include <algorithm>

#include "viewer/evaluation/accuracy_study.h"

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
      // The finer ones take longer still.
      if (*l.ms > goal.frameMs) return best ? best->level : l.level;
      best = &l;
    }
  }
  return best ? std::optional(best->level) : std::nullopt;
}

void markFront(std::vector<MeasuredLevel>& levels) {
  std::vector<glm::dvec2> points;
  for (const MeasuredLevel& l : levels)
    if (l.ms) points.emplace_back(*l.ms, l.error.rmse);
  const std::vector<bool> front = paretoFront(points);
  std::size_t n = 0;
  for (MeasuredLevel& l : levels) l.front = l.ms && front[n++];
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
