#include "results/numbers/series_columns.h"

#include <cmath>

#include "io/study/series.h"
#include "results/numbers/csv.h"
#include "results/series/series_facts.h"
#include "results/text/text.h"
#include "viewer/measure/shape.h"

namespace volumen {

const std::vector<SeriesColumn>& seriesColumns() {
  static const std::vector<SeriesColumn> columns{
      {"patient", "Patient"},      {"patient_id", "Patient ID"},       {"study_date", "Study date"},
      {"series", "Series"},        {"series_number", "Series number"}, {"series_uid", "Series UID"},
      {"time_point", "Time point"}};
  return columns;
}

QStringList seriesFields(const Series& series, const QString& timePoint) {
  const auto unlessHidden = [](const QString& text) { return namesHidden() ? QString() : text; };
  QStringList fields{unlessHidden(personText(series.patientName)),
                     unlessHidden(shownText(series.patientId)),
                     unlessHidden(dateText(series.studyDate)),
                     seriesText(series),
                     shownText(series.seriesNumber),
                     unlessHidden(shownText(series.seriesUid)),
                     timePoint};
  for (QString& field : fields) field = harmlessName(field);
  return fields;
}

Series asNamedInFiles(Series series) {
  if (!namesHidden()) return series;
  for (std::string* text : {&series.patientName, &series.patientId, &series.studyDate, &series.seriesUid})
    text->clear();
  return series;
}

QString timePointOf(const Series& series) {
  QStringList words;
  for (const SplitBy& by : series.splitBy) words << shownText(by.words);
  if (words.isEmpty()) words << shownText(series.label);
  return words.join(QStringLiteral(", "));
}

QString sliceNumberText(const Shape& shape, const Series& series) {
  constexpr double near = 0.01;  // relative to the distance between slices
  if (shape.frame || shape.points.empty() || series.curved || series.acquired.size.z < 2) return {};
  const VoxelGeometry& grid = drawnGeometry(series);
  std::optional<int> slice;
  for (const glm::dvec3& p : shape.points) {
    const double k = grid.voxelFromPatient(p).z, whole = std::round(k);
    if (std::abs(k - whole) > near || whole < 0 || whole >= grid.size.z) return {};
    if (slice.value_or(int(whole)) != int(whole)) return {};
    slice = int(whole);
  }
  const int acquired = series.regular ? series.regular->copies[std::size_t(*slice)] : *slice;
  return acquired < 0 ? QString() : QString::number(acquired + 1);
}

}  // namespace volumen
