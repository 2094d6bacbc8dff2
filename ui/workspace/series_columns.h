#pragma once

#include <QStringList>
#include <vector>

namespace volumen {

struct Series;
struct Shape;

/// What tells the numbers of one series from those of another in a table that leaves the program. A column:
/// its name for programs, and its head for people.
struct SeriesColumn {
  const char* key;
  const char* head;
};

/// Patient, patient ID, study date, series, its number and UID, time point.
const std::vector<SeriesColumn>& seriesColumns();
/// What stands in them, as spreadsheets take it; a field that is not known, or of names that are hidden
/// (hideNames()), is empty. `timePoint`: which volume of its series it is, in words.
QStringList seriesFields(const Series& series, const QString& timePoint);

/// The same of a volume that stands alone: "phase 40 %"; mostly empty.
QString timePointOf(const Series& series);

/// The number of the slice, from 1, of all points of a shape; empty where they lie on none, or on several.
QString sliceNumberText(const Shape& shape, const Series& series);

}  // namespace volumen
