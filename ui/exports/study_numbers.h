#pragma once

#include <memory>
#include <vector>

#include "ui/derivations/measured_numbers.h"
#include "ui/derivations/segment_reports.h"
#include "ui/overlays/page_tables.h"

namespace volumen {

/// A measurement of a report, as it was when that was requested.
struct ReportedMeasurement {
  Measurement measurement;
  std::shared_ptr<const Series> series;
  std::shared_ptr<const Series> over;  ///< overlaid on it; null: none
  QString timePoint;
  MeasuredPtr measured;  ///< null: not measured yet
};

/// The segments of one series of a report, as they were when that was requested.
struct ReportedSegments {
  std::shared_ptr<const Series> series;
  QString timePoint;
  ValueScale scale;
  SegmentReportsKey key;  ///< for voxelReportsOf()
  QString whyNot;         ///< a sentence why they cannot be measured; empty if they can
};

/// What a report states of one study.
struct ReportedStudy {
  std::shared_ptr<const Series> series;  ///< names patient and study
  std::size_t pictures = 0;
  std::vector<ReportedMeasurement> measurements{};
  std::vector<ReportedSegments> segments{};
};

/// Returns the index of the study of a series; adds it if it is not there.
std::size_t studyOf(std::vector<ReportedStudy>& studies, const std::shared_ptr<const Series>& series);

/// Adds the session's measurements that have numbers, and its segments. Those of series that are not listed
/// are left out.
void addNumbers(std::vector<ReportedStudy>& studies, const Session& session, MeasuredNumbers& measurer);

/// Returns the number of measurements, and of segments, of all studies.
int measurementCount(const std::vector<ReportedStudy>& studies);
int segmentCount(const std::vector<ReportedStudy>& studies);

/// Returns the table of measurements, with numbers as in the panel and their uncertainty.
PageTable measurementTable(const std::vector<ReportedMeasurement>& measurements);
/// Returns the table of segments, with numbers as in their table in the window. `reports` is empty if they
/// cannot be measured.
PageTable segmentTable(const ReportedSegments& segments, const std::vector<SegmentReport>& reports);

}  // namespace volumen
