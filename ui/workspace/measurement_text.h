#pragma once

#include <QString>
#include <QStringList>

#include "ui/data/loaded_series.h"
#include "ui/workspace/measurement.h"
#include "viewer/measure/measure.h"

namespace volumen {

/// "Length", "Cobb angle": of a tool.
QString kindText(ShapeKind kind);

/// The name, else what it is and its number: "Length 3".
QString nameText(const Measurement& measurement);

/// That a region holds nothing to take a mean of.
QString noneInsideText(const Measured& measured);

/// A number as people read it: three digits of what is small, one decimal of what is large, whole numbers as
/// they are; never with an exponent.
QString shortNumberText(double number);

/// A measured number with its unit, and of regions what the voxels inside say, a line each: "23.4 mm";
/// "Area 12.3 mm²", "Mean 45.2, SD 3.1 HU", "Min -5, max 99 HU", "123 voxels"; where a second series lies
/// over the first, the values of each behind its name. Where there is no number, why.
QStringList measuredLines(const Shape& shape, const Result<Measured>& measured);

/// The same in one line, for lists.
QString measuredText(const Shape& shape, const Result<Measured>& measured);

/// How sure the number is and what it was taken from: "23.4 ± 0.6 mm, from CT Chest (3)".
QString detailText(const Measurement& measurement, const Result<Measured>& measured, const Series& series);

/// The series that it was taken from, and which frame of it: "CR Chest, frame 1".
QString sourceText(const Measurement& measurement, const Series& series);

/// A measurement and its numbers, as far as they are known.
struct MeasuredRow {
  Measurement measurement;
  const Result<Measured>* measured;  ///< null: not yet
  const Series* series;              ///< null: unknown
  QString timePoint{};               ///< which volume of its series it is, in words
};

/// Where it was drawn: "slice 12 of 31", "frame 3", else the place of its middle in mm.
QString whereText(const Measurement& measurement, const Series& series);

/// Name, numbers, series, place, patient and study date, a line each.
QString measurementsAsText(const std::vector<MeasuredRow>& rows);
/// RFC 4180, with a line of headings; numbers of seven digits, positions in patient mm, of frames in pixels.
QString measurementsAsCsv(const std::vector<MeasuredRow>& rows);

}  // namespace volumen
