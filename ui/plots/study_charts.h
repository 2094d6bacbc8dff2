#pragma once

#include <QImage>

#include "ui/plots/chart.h"
#include "viewer/evaluation/accuracy_study.h"

namespace volumen {

/// One colour a method, the same in all charts; told apart by people who see colours otherwise, too.
QColor methodColour(const std::string& method);

/// Error (RMSE, /255) against time (median ms) of all rows, the front marked and named.
Chart errorAgainstTime(const AccuracyStudy& study, const StudyTitle& title);

/// The same, a panel a knob: its rows named and joined, all others pale behind them.
QImage knobPanels(const AccuracyStudy& study, const StudyTitle& title);

/// Every row's difference from the reference, magnified, with its settings and errors beneath; the reference
/// first.
QImage contactSheet(const AccuracyStudy& study, const StudyTitle& title);

}  // namespace volumen
