#pragma once

#include <QStringList>
#include <vector>

namespace volumen {

struct Series;
struct Shape;

/// A column that identifies the series of numbers in an exported table: its name for programs, its heading
/// for people.
struct SeriesColumn {
  const char* key;
  const char* head;
};

/// Returns patient, patient ID, study date, series, its number and UID, time point.
const std::vector<SeriesColumn>& seriesColumns();
/// Returns the fields of these columns, harmless to spreadsheets. Unknown fields are empty, and so are names
/// while they are hidden (hideNames()). `timePoint` says in words which volume of its series it is.
QStringList seriesFields(const Series& series, const QString& timePoint);

/// Returns the series for files that name it: without patient, date and UIDs while names are hidden.
Series asNamedInFiles(Series series);

/// Returns the time point of a volume that stands alone: "phase 40 %"; mostly empty.
QString timePointOf(const Series& series);

/// Returns the number (from 1) of the slice with all points of a shape; empty if they lie on none or several.
QString sliceNumberText(const Shape& shape, const Series& series);

}  // namespace volumen
