#pragma once

#include <QString>
#include <vector>

#include "io/study/series.h"

namespace volumen {

/// Returns whether two volumes are time points of one series. They have the same patient, series and grid,
/// and differ in time, echo, diffusion weighting or direction, or they are volumes of one file.
bool areTimePoints(const Series& a, const Series& b);

/// Sorts time points by the attribute that varies.
void sortTimePoints(std::vector<const Series*>& steps);

/// Returns the number of time points by what they are: "451 directions", "12 time points"; empty for a single
/// one.
QString stepsText(const std::vector<const Series*>& steps);

/// Returns the first of `steps` without what varies among them, and with the warnings that all have.
Series commonOf(const std::vector<const Series*>& steps);

/// Returns which of these time points `step` is, by the attribute that varies. Examples: "b 50 (2 of 3)",
/// "echo 2 of 7: 31 ms", "direction 12 (12 of 30)". A single one has its label: "component x", mostly empty.
QString timePointText(const std::vector<const Series*>& steps, const Series& step);
/// Returns all values of that attribute: "b = 0, 50, 800"; empty for a single one, or if no attribute varies.
QString timeAxisText(const std::vector<const Series*>& steps);

/// The positions of time points along the attribute that varies: "b (s/mm²)", "Echo time (ms)", or "Time (s)"
/// since the first acquisition. If it is not given for all, or not in order, their numbers from 1: "Volume".
struct StepAxis {
  QString title;
  std::vector<double> at;
};
StepAxis stepAxisOf(const std::vector<const Series*>& steps);

}  // namespace volumen
