#pragma once

#include <QString>
#include <utility>

#include "ui/data/loaded_series.h"

namespace volumen {

/// What PET is shown in from now on: one switch behind all numbers on screen, as hideNames() is. Volumes,
/// scenes and sessions stay in the units of the file.
void showPetIn(PetUnit unit);
PetUnit shownPetUnit();

/// From the values of a series to the numbers on screen.
ValueScale shownScale(const Series& series);

/// " (no SUV: PatientWeight (0010,1030) is missing)"; empty where nothing is to be said of the unit.
QString unitNote(const Series& series);

/// A value as it stands on screen, with its unit and what is to be said of that: "5.23 SUVbw".
QString valueText(const LoadedSeries& shown, double value);

/// How many decimals tell the numbers of a series apart.
int valueDecimals(const LoadedSeries& shown);

/// Of so many digits, whole where it has more before the point: never "1.3e+06".
QString digitsText(double number, int digits);

/// A window or a range in the numbers on screen, and back.
Window shownWindow(const Window& window, const Series& series);
/// "Bone (2000 / 400)": a name, with width and centre as they are shown.
QString namedWindowText(const QString& name, const Window& stored, const Series& series);
Window storedWindow(const Window& shown, const Series& series);

/// Width and centre as they are read: four digits of the width, as many decimals of the centre, no zeros that
/// both end with, no exponent up to 1e9.
std::pair<QString, QString> windowNumbers(const Window& window);

/// "W 400 L 40"; of PET with the unit.
QString windowText(const Window& window, const Series& series);

}  // namespace volumen
