#pragma once

#include <QString>
#include <vector>

#include "ui/workspace/workspace.h"

namespace volumen {

/// How many steps there are, by what they are: "451 directions", "12 time points"; empty of one alone.
QString stepsText(const std::vector<const Series*>& steps);

/// What all steps have in common: the first of them without what varies, and with the warnings that all have.
Series commonOf(const std::vector<const Series*>& steps);

/// Which of the steps of its series it is, by the name of what varies: "b 50 (2 of 3)", "echo 2 of 7: 31 ms",
/// "direction 12 (12 of 30)"; of the only one its label: "component x", mostly empty.
QString timePointText(const Workspace& workspace, const SeriesKey& series);
/// All of them: "b = 0, 50, 800"; empty where there is one, or nothing is given that varies.
QString timeAxisText(const std::vector<const Series*>& steps);

/// Where each of the steps stands along what varies: "b (s/mm²)", "Echo time (ms)", "Time (s)" since the
/// first acquisition; where that is not given for all, or not in order, their numbers from 1: "Volume".
struct StepAxis {
  QString title;
  std::vector<double> at;
};
StepAxis stepAxisOf(const std::vector<const Series*>& steps);

}  // namespace volumen
