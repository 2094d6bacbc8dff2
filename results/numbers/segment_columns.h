#pragma once

#include <QStringList>
#include <span>
#include <string>
#include <vector>

#include "io/study/suv.h"
#include "results/numbers/segment_report.h"

namespace volumen {

/// A number of a segment, or several that belong together. It is a column of the table, a member of the JSON,
/// and one or more columns of CSV.
struct SegmentColumn {
  enum class Unit { none, voxels, ml, mm2, mm, value, valueMl };

  const char* key;                                  ///< in JSON
  const char* head;                                 ///< in tables
  const char* suvHead;                              ///< in tables of PET in SUV
  Unit unit;                                        ///< voxel counts are integers
  std::vector<const char*> parts;                   ///< names of the numbers if there are several
  std::vector<double> (*of)(const SegmentReport&);  ///< as many numbers as parts (1 without), or none
};

/// Returns all columns in display order. A new number is a new row there.
const std::vector<SegmentColumn>& segmentColumns();

/// Returns the numbers of a segment in a column, values times `factor`; empty if there are none.
std::vector<double> segmentNumbers(const SegmentColumn& column, const SegmentReport& report, double factor);

/// Returns the heading, values with the unit of `scale`: "Surface area (mm^2)", "SUVmax (SUVbw)".
QString columnHead(const SegmentColumn& column, const ValueScale& scale);
/// Returns the numbers for people, in four to six digits; "-" if there are none.
QString columnText(const SegmentColumn& column, const SegmentReport& report, double factor);

/// Returns segments as CSV (RFC 4180, UTF-8), one row each, with numbers of seven digits and names harmless
/// to spreadsheets. `ofSeries` identifies the series (seriesFields()). The last column says how each was
/// made.
QString segmentsAsCsv(std::span<const SegmentReport> all, const ValueScale& scale,
                      const QStringList& ofSeries = {});

}  // namespace volumen
