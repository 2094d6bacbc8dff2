#include "ui/workspace/measurement_text.h"

#include <cmath>

#include "results/numbers/series_columns.h"
#include "results/series/loaded_frame.h"
#include "results/text/measured_text.h"
#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/workspace/measurements.h"
#include "viewer/measure/lengths.h"
#include "viewer/measure/shape_cut.h"

namespace volumen {

namespace {

QString placeText(const ValuePeak& peak) {
  const glm::dvec3 p = peak.centre;
  return QStringLiteral("%1, %2, %3").arg(shortNumberText(p.x), shortNumberText(p.y), shortNumberText(p.z));
}

// Returns the words behind a length and its +-: " (at detector), 0.502 s".
QString wordsBehind(const Measured& m) {
  if (!m.frame) return {};
  QString text;
  if (!m.frame->calibration.empty()) text += tr(" (%1)").arg(shownText(m.frame->calibration));
  if (const QString reading = readingText(*m.frame); !reading.isEmpty())
    text += QStringLiteral(", ") + reading;
  return text;
}

// The depth of points picked in 3D depends on the transfer function they were seen with.
QString surfaceText(double softMm, const Series& series) {
  constexpr double least = 0.1;  // voxel size matters more below that
  const QString unit = series.acquired.calibrated ? tr(" mm") : tr(" px");
  const double twoU = 2 * std::sqrt(depthVariance(softMm));
  const QString depth = twoU < least ? tr("within %1").arg(QString::number(least) + unit)
                                     : QStringLiteral("\u00b1 %1").arg(shortNumberText(twoU) + unit);
  return tr(", on the surface as it was seen in 3D (depth %1)").arg(depth);
}

// Returns a length with its uncertainty and the words behind it; empty if none is stated.
QString plusMinusText(const Result<Measured>& measured) {
  if (!measured || !measured->plusMinus || measured->lines) return {};
  return QStringLiteral("%1 \u00b1 %2%3")
             .arg(shortNumberText(measured->number), shortNumberText(*measured->plusMinus),
                  unitText(measured->unit)) +
         wordsBehind(*measured);
}

// Returns what else is stated of a number: ", voxel 3, 4, 5", ", not calibrated".
QString qualifyingText(const Measurement& measurement, const Result<Measured>& measured,
                       const Series& series) {
  QString text;
  if (measured && measured->voxel && measured->frame)
    text += tr(", pixel %1, %2").arg(measured->voxel->index.x).arg(measured->voxel->index.y);
  else if (measured && measured->voxel)
    text += tr(", voxel %1, %2, %3")
                .arg(measured->voxel->index.x)
                .arg(measured->voxel->index.y)
                .arg(measured->voxel->index.z);
  if (measured && measured->lines && measured->plusMinus)
    text += tr(", long axis \u00b1 %1").arg(withUnit(*measured->plusMinus, measured->unit));
  if (measured && measured->peak) text += tr(", SUVpeak of 1 ml at %1 mm").arg(placeText(*measured->peak));
  const std::string unit = !measured ? "" : measured->lines ? measured->lines->unit : measured->unit;
  if (unit == "px" || unit == "px^2") text += tr(", not calibrated");
  if (measured && (measured->values || measured->voxel)) text += unitNote(series);
  if (measurement.shape.softMm) text += surfaceText(*measurement.shape.softMm, series);
  return text;
}

}  // namespace

QString kindText(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::length:
      return tr("Length");
    case ShapeKind::polyline:
      return tr("Polyline");
    case ShapeKind::openCurve:
      return tr("Curve");
    case ShapeKind::angle:
      return tr("Angle");
    case ShapeKind::cobb:
      return tr("Cobb angle");
    case ShapeKind::bidirectional:
      return tr("Long and short axis");
    case ShapeKind::legAxis:
      return tr("Leg axis");
    case ShapeKind::cardiothoracic:
      return tr("Cardiothoracic ratio");
    case ShapeKind::ellipse:
      return tr("Ellipse");
    case ShapeKind::rectangle:
      return tr("Rectangle");
    case ShapeKind::freehand:
      return tr("Freehand");
    case ShapeKind::probe:
      return tr("Probe");
    case ShapeKind::arrow:
      return tr("Arrow");
    case ShapeKind::label:
      return tr("Label");
    case ShapeKind::volume:
      break;
  }
  return tr("Volume");
}

QString nameText(const Measurement& measurement) {
  const QString name = shownText(measurement.shape.name);
  return name.isEmpty() ? QStringLiteral("%1 %2").arg(kindText(measurement.shape.kind)).arg(measurement.id)
                        : name;
}

QStringList reportedLines(const Measurement& measurement, const Result<Measured>& measured,
                          const Series& series) {
  QStringList lines = measuredLines(measurement.shape, measured);
  if (const QString exact = plusMinusText(measured); !exact.isEmpty()) lines = {exact};
  QString qualified = qualifyingText(measurement, measured, series);
  if (qualified.startsWith(QStringLiteral(", "))) qualified.remove(0, 2);
  if (!qualified.isEmpty()) lines << qualified.trimmed();
  return lines;
}

QString detailText(const Measurement& measurement, const Result<Measured>& measured, const Series& series) {
  QString numbers = plusMinusText(measured);
  if (numbers.isEmpty()) numbers = measuredText(measurement.shape, measured);
  QString text = nameText(measurement);
  if (!numbers.isEmpty()) text += QStringLiteral(": ") + numbers;
  text += qualifyingText(measurement, measured, series);
  if (ruleOf(measurement.shape.kind).numberless) return text;
  QString source = sourceText(measurement, series);
  if (measured && measured->other) source += tr(" and %1").arg(shownText(measured->other->source));
  return tr("%1, from %2").arg(text, source);
}

QString sourceText(const Measurement& measurement, const Series& series) {
  const QString text = seriesText(series);
  const auto frame = measurement.shape.frame ? frameMeant(series, *measurement.shape.frame) : std::nullopt;
  return frame ? tr("%1, frame %2").arg(text).arg(*frame + 1) : text;
}

QString whereText(const Measurement& measurement, const Series& series) {
  const Shape& shape = measurement.shape;
  if (shape.frame) {
    const auto frame = frameMeant(series, *shape.frame);
    return frame ? tr("frame %1").arg(*frame + 1) : QString();
  }
  const QString slice = sliceNumberText(shape, series);
  if (!slice.isEmpty()) return tr("slice %1 of %2").arg(slice).arg(series.acquired.size.z);
  if (shape.points.empty() || series.curved || !series.acquired.calibrated) return {};
  const glm::dvec3 p = middleOf(shape);
  return QStringLiteral("%1, %2, %3 mm").arg(p.x, 0, 'f', 1).arg(p.y, 0, 'f', 1).arg(p.z, 0, 'f', 1);
}

QString measurementsAsText(const std::vector<MeasuredRow>& rows) {
  QString text;
  for (const MeasuredRow& row : rows) {
    text += nameText(row.measurement);
    const QString numbers = row.measured ? measuredText(row.measurement.shape, *row.measured) : QString();
    if (!numbers.isEmpty()) text += QStringLiteral(": ") + numbers;
    if (row.series) {
      QStringList source{QStringLiteral(" (%1)").arg(sourceText(row.measurement, *row.series)),
                         row.measurement.shape.frame ? QString() : whereText(row.measurement, *row.series),
                         row.timePoint, patientText(*row.series), dateText(row.series->studyDate)};
      source.removeAll(QString());
      text += source.join(QStringLiteral(", "));
    }
    text += QLatin1Char('\n');
  }
  return text;
}

}  // namespace volumen
