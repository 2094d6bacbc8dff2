#pragma once

#include <QString>

#include "results/series/loaded_series.h"
#include "ui/workspace/measurement.h"
#include "viewer/measure/measure.h"

namespace volumen {

/// Returns the name of a tool: "Length", "Cobb angle".
QString kindText(ShapeKind kind);

/// Returns the name, else kind and number: "Length 3".
QString nameText(const Measurement& measurement);

/// Returns measuredLines() for a report: with the uncertainty that is stated ("23.4 ± 0.6 mm"), and last what
/// else is to be known of the number ("not calibrated").
QStringList reportedLines(const Measurement& measurement, const Result<Measured>& measured,
                          const Series& series);

/// Returns the number with uncertainty and source: "23.4 ± 0.6 mm, from CT Chest (3)".
QString detailText(const Measurement& measurement, const Result<Measured>& measured, const Series& series);

/// Returns the source series, and which frame of it: "CR Chest, frame 1".
QString sourceText(const Measurement& measurement, const Series& series);

/// A measurement with its numbers, as far as known.
struct MeasuredRow {
  Measurement measurement;
  const Result<Measured>* measured;  ///< null: not measured yet
  const Series* series;              ///< null: unknown
  QString timePoint{};               ///< volume of its series, in words
};

/// Returns where it was drawn: "slice 12 of 31", "frame 3", else the position of its middle in mm.
QString whereText(const Measurement& measurement, const Series& series);

/// Returns name, numbers, series, position, patient and study date, one line per measurement.
QString measurementsAsText(const std::vector<MeasuredRow>& rows);
/// Returns CSV (RFC 4180) with a header. Numbers have seven digits. Positions are patient mm, or pixels of
/// frames.
QString measurementsAsCsv(const std::vector<MeasuredRow>& rows);

}  // namespace volumen
