#pragma once

#include <QString>
#include <utility>

#include "results/series/loaded_series.h"

namespace volumen {

/// Sets the unit in which PET is shown. Like hideNames(), one switch serves all numbers on screen. Volumes,
/// scenes and sessions keep the units of the file.
void showPetIn(PetUnit unit);
PetUnit shownPetUnit();

/// Returns the scale from stored values of a series to displayed numbers.
ValueScale shownScale(const Series& series);

/// Returns a note on the unit, " (no SUV: PatientWeight (0010,1030) is missing)"; empty if there is none.
QString unitNote(const Series& series);

/// Returns a displayed value with its unit and the note on it: "5.23 SUVbw".
QString valueText(const LoadedSeries& shown, double value);

/// Returns how many decimals distinguish the displayed numbers of a series.
int valueDecimals(const LoadedSeries& shown);

/// Returns a number with `digits` digits, or an integer if it has more before the point: never "1.3e+06".
QString digitsText(double number, int digits);

/// Returns a window or a range in displayed units. storedWindow() converts it back.
Window shownWindow(const Window& window, const Series& series);
/// Returns a name with displayed width and centre: "Bone (2000 / 400)".
QString namedWindowText(const QString& name, const Window& stored, const Series& series);
Window storedWindow(const Window& shown, const Series& series);

/// Returns width and centre for people: four digits of the width, as many decimals of the centre. Drops zeros
/// at the end of both. Uses no exponent up to 1e9.
std::pair<QString, QString> windowNumbers(const Window& window);

/// Returns "W 400 L 40"; for PET with the unit.
QString windowText(const Window& window, const Series& series);

}  // namespace volumen
