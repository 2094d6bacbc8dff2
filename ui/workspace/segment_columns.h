#pragma once

#include <QStringList>
#include <span>
#include <string>
#include <vector>

#include "io/study/suv.h"
#include "ui/workspace/segment_report.h"

namespace volumen {

/// A number of a segment, or several that belong together: a column of the table, a member of the JSON, one
/// or more columns of CSV.
struct SegmentColumn {
  enum class Unit { none, voxels, ml, mm2, mm, value, valueMl };

  const char* key;                                  ///< of JSON
  const char* head;                                 ///< of tables
  const char* suvHead;                              ///< of those of PET in SUV
  Unit unit;                                        ///< numbers of voxels are whole
  std::vector<const char*> parts;                   ///< what its numbers are called where they are several
  std::vector<double> (*of)(const SegmentReport&);  ///< as many as parts (1 without); none: there is none
};

/// All of them, in the order in which they are shown. A new number is a row there.
const std::vector<SegmentColumn>& segmentColumns();

/// The numbers of a segment in a column, those of values times `factor`; empty: there are none.
std::vector<double> segmentNumbers(const SegmentColumn& column, const SegmentReport& report, double factor);

/// "Surface area (mm^2)", "SUVmax (SUVbw)": of values with the unit of the scale.
QString columnHead(const SegmentColumn& column, const ValueScale& scale);
/// As a person reads them, four to six digits; "-" where there are none.
QString columnText(const SegmentColumn& column, const SegmentReport& report, double factor);

/// All of them as CSV (RFC 4180), a row a segment, UTF-8, numbers of seven digits; names are harmless to
/// spreadsheets. `ofSeries`: what names their series (seriesFields()); last comes how each was made.
QString segmentsAsCsv(std::span<const SegmentReport> all, const ValueScale& scale,
                      const QStringList& ofSeries = {});

}  // namespace volumen
