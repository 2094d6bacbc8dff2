#include "ui/exports/study_numbers.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "results/numbers/segment_columns.h"
#include "results/segments/segments.h"
#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/controller/segment_target.h"
#include "ui/workspace/corner_text.h"
#include "ui/workspace/measurement_text.h"
#include "ui/workspace/series_segments.h"

namespace volumen {

namespace {

// Columns of segmentColumns() by key.
constexpr std::array reportedColumns{"voxels", "millilitres", "mean", "sd", "min", "max"};

bool areOneStudy(const Series& a, const Series& b) {
  return a.patientId == b.patientId && a.patientName == b.patientName && a.studyUid == b.studyUid;
}

std::vector<SegmentColumn> columnsOfReport() {
  std::vector<SegmentColumn> columns;
  for (const SegmentColumn& column : segmentColumns())
    if (std::ranges::find(reportedColumns, std::string_view(column.key)) != reportedColumns.end())
      columns.push_back(column);
  return columns;
}

ReportedSegments segmentsNow(const Session& session, const SeriesKey& key,
                             const std::vector<const SegmentMap*>& maps) {
  const Workspace& workspace = session.workspace();
  ReportedSegments now;
  now.series = workspace.series.at(key).series;
  now.timePoint = stepText(workspace, key);
  now.key.maps = copiesOf(maps);
  now.scale = shownScale(*now.series);
  LoadedSeriesPtr held = session.seriesWith(key, {});
  if (!held) held = session.seriesNamed(key);
  if (missesSegments(workspace, key))
    now.whyNot = tr("The segments were not found with their session: put their file beside it.");
  else if (!held)
    now.whyNot = tr("The series is not in memory: show it, then make the report again.");
  else if (std::ranges::all_of(maps, [&](const auto* map) { return isOn(*map, held->volume->geometry()); }))
    now.key.volume = held->volume;
  else
    now.whyNot = tr("The segments lie on another grid than their series.");
  return now;
}

// Names the series as shown now, which says "hidden" or not.
Result<Measured> withNames(const ReportedMeasurement& row) {
  Result<Measured> measured = *row.measured;
  if (!measured && namesHidden()) return Error{tr("not measured").toStdString()};  // it may name a file
  if (measured && measured->other && row.over) {
    measured->source = seriesText(*row.series).toStdString();
    measured->other->source = seriesText(*row.over).toStdString();
  }
  return measured;
}

QString seriesAndStep(const Series& series, const QString& timePoint) {
  const QString text = seriesText(series);
  return timePoint.isEmpty() ? text : QStringLiteral("%1, %2").arg(text, timePoint);
}

}  // namespace

std::size_t studyOf(std::vector<ReportedStudy>& studies, const std::shared_ptr<const Series>& series) {
  const auto same = std::ranges::find_if(
      studies, [&](const ReportedStudy& study) { return areOneStudy(*study.series, *series); });
  const auto n = std::size_t(same - studies.begin());
  if (same == studies.end()) studies.push_back({series});
  return n;
}

void addNumbers(std::vector<ReportedStudy>& studies, const Session& session, MeasuredNumbers& measurer) {
  const Workspace& workspace = session.workspace();
  for (const Measurement& m : workspace.measurements) {
    const auto state = workspace.series.find(m.series);
    if (state == workspace.series.end() || ruleOf(m.shape.kind).numberless) continue;
    const std::shared_ptr<const Series>& series = state->second.series;
    ReportedMeasurement row{m, series, nullptr, stepText(workspace, m.series), measurer.exactNumbersOf(m)};
    if (const auto over = seriesOver(workspace, m.series))
      row.over = workspace.series.at(over->series).series;
    studies[studyOf(studies, series)].measurements.push_back(std::move(row));
  }
  for (const auto& [key, state] : workspace.series)
    if (const auto maps = segmentMapsOf(workspace, key); !maps.empty())
      studies[studyOf(studies, state.series)].segments.push_back(segmentsNow(session, key, maps));
}

int measurementCount(const std::vector<ReportedStudy>& studies) {
  std::size_t count = 0;
  for (const ReportedStudy& study : studies) count += study.measurements.size();
  return int(count);
}

int segmentCount(const std::vector<ReportedStudy>& studies) {
  std::size_t count = 0;
  for (const ReportedStudy& study : studies)
    for (const ReportedSegments& segments : study.segments)
      for (const SegmentMap& map : segments.key.maps) count += map.segments.size();
  return int(count);
}

PageTable measurementTable(const std::vector<ReportedMeasurement>& measurements) {
  PageTable table{tr("Measurements"),
                  {},
                  {{tr("Name"), 30},
                   {tr("Number"), 32},
                   {tr("Values"), 45},
                   {tr("Series"), 33},
                   {tr("Place"), 23},
                   {tr("Study date"), 23}},
                  {}};
  for (const ReportedMeasurement& row : measurements) {
    const Measurement& m = row.measurement;
    QStringList lines = row.measured ? reportedLines(m, withNames(row), *row.series)
                                     : QStringList(tr("not measured: its series is not in memory"));
    const QString number = lines.isEmpty() ? QString() : lines.takeFirst();
    table.rows.push_back({nameText(m), number, lines.join(QLatin1Char('\n')),
                          seriesAndStep(*row.series, row.timePoint), whereText(m, *row.series),
                          dateText(row.series->studyDate)});
  }
  return table;
}

PageTable segmentTable(const ReportedSegments& segments, const std::vector<SegmentReport>& reports) {
  const QString series = seriesAndStep(*segments.series, segments.timePoint);
  PageTable table{tr("Segments of %1").arg(series),
                  (dateText(segments.series->studyDate) + unitNote(*segments.series)).trimmed(),
                  {{tr("Name"), 50}},
                  {}};
  if (!segments.whyNot.isEmpty())
    table.note =
        table.note.isEmpty() ? segments.whyNot : QStringLiteral("%1. %2").arg(table.note, segments.whyNot);
  const std::vector<SegmentColumn> columns = columnsOfReport();
  for (const SegmentColumn& column : columns)
    table.columns.push_back({columnHead(column, segments.scale), 22});
  for (const SegmentReport& report : reports) {
    QStringList row{shownText(report.segment.label)};
    for (const SegmentColumn& column : columns) row << columnText(column, report, segments.scale.factor);
    table.rows.push_back(row);
  }
  if (reports.empty())
    for (const SegmentMap& map : segments.key.maps)
      for (const Segment& segment : map.segments) table.rows.push_back({shownText(segment.label)});
  return table;
}

}  // namespace volumen
