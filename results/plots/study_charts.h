#pragma once

#include <QImage>

#include "results/plots/chart.h"
#include "viewer/evaluation/accuracy_study.h"

namespace volumen {

/// Returns the colour of a method, the same in all charts; colour-blind people can distinguish them.
QColor methodColour(const std::string& method);

/// Returns a chart of error (RMSE, /255) against time (median ms) of all rows, with the front marked and
/// named.
Chart errorAgainstTime(const AccuracyStudy& study, const StudyTitle& title);

/// Returns a panel for each knob: its rows are named and joined, all others pale behind them.
QImage knobPanels(const AccuracyStudy& study, const StudyTitle& title);

/// Returns every row's difference from the reference, magnified, with settings and errors below; the
/// reference comes first.
QImage contactSheet(const AccuracyStudy& study, const StudyTitle& title);

}  // namespace volumen
