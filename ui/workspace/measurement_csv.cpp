#include <string_view>

#include "results/numbers/csv.h"
#include "results/numbers/series_columns.h"
#include "results/text/measured_text.h"
#include "results/text/text.h"
#include "ui/workspace/measurement_text.h"

namespace volumen {

namespace {

// Formats a position in mm.
QString exactPlace(glm::dvec3 p) {
  return QStringLiteral("%1 %2 %3").arg(csvNumber(p.x), csvNumber(p.y), csvNumber(p.z));
}

// Returns number, unit, +-, mean, SD, min, max, voxels, unit of the values, problem and calibration.
QStringList csvNumbers(const Result<Measured>* measured) {
  QStringList fields(11, QString());
  if (!measured)
    fields[9] = tr("not measured yet");
  else if (!*measured)
    fields[9] = QString::fromStdString(measured->message());
  if (!measured || !*measured) return fields;
  const Measured& m = **measured;
  fields[0] = csvNumber(m.number);
  fields[1] = QString::fromStdString(m.unit);
  if (m.plusMinus) fields[2] = csvNumber(*m.plusMinus);
  if (m.values) {
    const double numbers[] = {m.values->mean, m.values->sd, m.values->min, m.values->max};
    for (int n = 0; n < 4; ++n) fields[3 + n] = csvNumber(numbers[n]);
    fields[7] = QString::number(m.values->n);
    fields[8] = QString::fromStdString(m.valueUnit);
  }
  if (m.unit.ends_with("^2") && !m.values && !(m.frame && m.frame->colour)) fields[9] = noneInsideText(m);
  if (m.frame && m.frame->rgb) fields[0].clear();
  if (m.frame) fields[10] = QString::fromStdString(m.frame->calibration);
  return fields;
}

// Columns that only some kinds fill.
constexpr const char* furtherColumns =
    "first_length,second_length,length_unit,product,suv_peak,suv_peak_mm,other_series,other_mean,other_sd,"
    "other_min,other_max,other_voxels,other_unit,other_suv_peak,hka,bend";

// Returns the bend as a program reads it; empty if the side is unknown.
QString bendName(LegAxis::Bend bend) {
  return bend == LegAxis::Bend::varus    ? QStringLiteral("varus")
         : bend == LegAxis::Bend::valgus ? QStringLiteral("valgus")
                                         : QString();
}

constexpr int suvPeakPlace = 5;  // index of suv_peak_mm

QStringList furtherNumbers(const Result<Measured>* measured) {
  QStringList fields(16, QString());
  if (!measured || !*measured) return fields;
  const Measured& m = **measured;
  if (m.lines) {
    fields[0] = csvNumber(m.lines->first);
    fields[1] = csvNumber(m.lines->second);
    fields[2] = QString::fromStdString(m.lines->unit);
    if (m.plusMinus) fields[3] = csvNumber(m.lines->first * m.lines->second);
  }
  if (m.peak) {
    fields[4] = csvNumber(m.peak->mean);
    fields[suvPeakPlace] = exactPlace(m.peak->centre);
  }
  if (m.leg) {
    fields[14] = csvNumber(m.leg->hka);
    fields[15] = bendName(m.leg->bend);
  }
  if (!m.other) return fields;
  fields[6] = QString::fromStdString(m.other->source);
  if (const auto& values = m.other->values) {
    const double numbers[] = {values->mean, values->sd, values->min, values->max};
    for (int n = 0; n < 4; ++n) fields[7 + n] = csvNumber(numbers[n]);
    fields[11] = QString::number(values->n);
    fields[12] = QString::fromStdString(m.other->unit);
  }
  if (m.other->peak) fields[13] = csvNumber(m.other->peak->mean);
  return fields;
}

// Returns how a shape was drawn or chosen.
QString howText(const Shape& shape) {
  if (shape.kind == ShapeKind::volume)
    return tr("values from %1 to %2").arg(csvNumber(shape.range.low), csvNumber(shape.range.high));
  if (shape.softMm) return tr("points picked in 3D");
  return shape.frame ? tr("drawn on a frame") : tr("drawn in slices");
}

// Returns patient, study, series, time point, slice and how. "series" already has its column.
QStringList identityFields(const MeasuredRow& row) {
  QStringList fields;
  const QStringList of = row.series ? seriesFields(*row.series, row.timePoint) : QStringList();
  for (std::size_t n = 0; n < seriesColumns().size(); ++n)
    if (seriesColumns()[n].key != std::string_view("series")) fields << of.value(qsizetype(n));
  return fields << (row.series ? sliceNumberText(row.measurement.shape, *row.series) : QString())
                << howText(row.measurement.shape);
}

QString identityNames() {
  QString names;
  for (const SeriesColumn& column : seriesColumns())
    if (column.key != std::string_view("series")) names += QLatin1Char(',') + QLatin1String(column.key);
  return names + QStringLiteral(",slice,how");
}

}  // namespace

QString measurementsAsCsv(const std::vector<MeasuredRow>& rows) {
  QString text = QStringLiteral(
      "name,kind,number,unit,plus_minus,mean,sd,min,max,voxels,value_unit,problem,series,points_mm,"
      "calibration,"
      "frame_instance,frame_number,points_px,");
  text += QLatin1String(furtherColumns) + identityNames() + QStringLiteral("\r\n");
  for (const MeasuredRow& row : rows) {
    const std::optional<ShapeFrame>& frame = row.measurement.shape.frame;
    QStringList points;
    for (const glm::dvec3 p : row.measurement.shape.points)
      points << (frame ? QStringLiteral("%1 %2").arg(csvNumber(p.x), csvNumber(p.y)) : exactPlace(p));
    const QString places = points.join(QStringLiteral("; "));
    const bool isCurved = row.series && row.series->curved;  // its positions are not patient space
    QStringList fields{nameText(row.measurement), QLatin1String(ruleOf(row.measurement.shape.kind).name)};
    const bool numberless = ruleOf(row.measurement.shape.kind).numberless;
    fields += csvNumbers(numberless ? nullptr : row.measured);
    const QString calibration = fields.takeLast();
    if (numberless) fields.last().clear();
    fields << (row.series ? seriesText(*row.series) : QString()) << (frame || isCurved ? QString() : places)
           << calibration;
    if (frame)
      fields << QString::fromStdString(frame->instance) << QString::number(frame->number) << places;
    else
      fields << QString() << QString() << QString();
    QStringList further = furtherNumbers(row.measured);
    if (isCurved) further[suvPeakPlace].clear();
    fields += further + identityFields(row);
    fields.front() = harmlessName(fields.front());
    for (QString& field : fields) field = csvField(field);
    text += fields.join(QLatin1Char(',')) + QStringLiteral("\r\n");
  }
  return text;
}

}  // namespace volumen
