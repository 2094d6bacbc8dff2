#pragma once

#include <QString>
#include <QStringList>
#include <string>

#include "viewer/measure/measure.h"

namespace volumen {

/// Returns a unit as it follows a number: " mm²". A degree sign follows without a space.
QString unitText(const std::string& unit);

/// Returns a number for people: three digits if small, one decimal if large, integers unchanged, never an
/// exponent.
QString shortNumberText(double number);
/// Returns the same with its unit; angles have one decimal.
QString withUnit(double number, const std::string& unit);

/// Returns the readings in an ultrasound region with units other than cm: "0.502 s, 12 cm/s".
QString readingText(const FrameReading& frame);

/// Returns the message that a region holds nothing to average.
QString noneInsideText(const Measured& measured);

/// Returns a measured number with its unit, or the reason why there is none: "23.4 mm". Regions add the
/// statistics of their voxels, one per line: "Area 12.3 mm²", "Mean 45.2, SD 3.1 HU", "Min -5, max 99 HU",
/// "123 voxels". With an overlay, the values of each series follow its name.
QStringList measuredLines(const Shape& shape, const Result<Measured>& measured);

/// Returns the same in one line, for lists.
QString measuredText(const Shape& shape, const Result<Measured>& measured);

}  // namespace volumen
