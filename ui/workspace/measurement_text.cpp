#include "ui/workspace/measurement_text.h"

#include <QLocale>
#include <cmath>

#include "results/numbers/series_columns.h"
#include "results/series/loaded_frame.h"
#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/workspace/measurements.h"
#include "viewer/measure/lengths.h"
#include "viewer/measure/shape_cut.h"

namespace volumen {

namespace {

// Returns a unit as it follows a number. A degree sign follows without a space.
QString unitText(const std::string& unit) {
  if (unit == "degrees") return QStringLiteral("\u00b0");
  if (unit == "mm^2") return QStringLiteral(" mm\u00b2");
  if (unit == "px^2") return QStringLiteral(" px\u00b2");
  return unit.empty() ? QString() : QLatin1Char(' ') + shownText(unit);
}

// An area below 0.01 mm^2 must not read as 0.
QString withUnit(double number, const std::string& unit) {
  if (unit == "degrees") return QString::number(number, 'f', 1) + unitText(unit);
  return shortNumberText(number) + unitText(unit);
}

QString placeText(const ValuePeak& peak) {
  const glm::dvec3 p = peak.centre;
  return QStringLiteral("%1, %2, %3").arg(shortNumberText(p.x), shortNumberText(p.y), shortNumberText(p.z));
}

// Appends the calibration word to lengths and areas.
QString extentText(const Measured& m) {
  const QString text = withUnit(m.number, m.unit);
  return m.frame && !m.frame->calibration.empty() ? tr("%1 (%2)").arg(text, shownText(m.frame->calibration))
                                                  : text;
}

QString countText(std::int64_t n, bool ofPixels) {
  const QString number = QLocale().toString(qlonglong(n));
  if (n == 1) return ofPixels ? tr("1 pixel") : tr("1 voxel");
  return ofPixels ? tr("%1 pixels").arg(number) : tr("%1 voxels").arg(number);
}

// Returns the readings in an ultrasound region with units other than cm: "0.502 s, 12 cm/s".
QString readingText(const FrameReading& frame) {
  QStringList parts;
  for (const std::optional<AxisReading>& reading : {frame.across, frame.down})
    if (reading) parts << QString::number(reading->number, 'g', 3) + unitText(reading->unit);
  return parts.join(QStringLiteral(", "));
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

QStringList frameLines(const FrameReading& frame, QStringList lines) {
  if (frame.rgb)
    lines[0] = QStringLiteral("R %1 G %2 B %3").arg(frame.rgb->x).arg(frame.rgb->y).arg(frame.rgb->z);
  if (const QString reading = readingText(frame); !reading.isEmpty()) lines << reading;
  return lines;
}

// Returns "Mean 45.2, SD 3.05 HU".
QString meanText(const ValueStatistics& values, const QString& unit) {
  return tr("Mean %1, SD %2%3").arg(shortNumberText(values.mean), shortNumberText(values.sd), unit);
}

// Returns "Min -5, max 99 HU"; for SUV, by the field's names: "SUVmax 8.1, SUVpeak 6.2, min 0.3 SUVbw".
QString limitsText(const ValueStatistics& values, const std::optional<ValuePeak>& peak, const QString& unit) {
  const QString least = shortNumberText(values.min), most = shortNumberText(values.max);
  if (!peak) return tr("Min %1, max %2%3").arg(least, most, unit);
  return tr("SUVmax %1, SUVpeak %2, min %3%4").arg(most, shortNumberText(peak->mean), least, unit);
}

// Returns the two lines of one of two series, which begin with its name.
QStringList linesOfSource(const std::string& source, const std::optional<ValueStatistics>& values,
                          const std::optional<ValuePeak>& peak, const std::string& valueUnit) {
  const QString name = shownText(source), unit = unitText(valueUnit);
  if (!values) return {tr("%1: no voxel inside").arg(name)};
  return {QStringLiteral("%1: %2").arg(name, meanText(*values, unit)),
          QStringLiteral("%1, %2").arg(limitsText(*values, peak, unit), countText(values->n, false))};
}

QStringList regionLines(const Measured& m) {
  QStringList lines{tr("Area %1").arg(extentText(m))};
  if (m.frame && m.frame->colour) return lines;
  if (m.other)
    return lines << linesOfSource(m.source, m.values, m.peak, m.valueUnit)
                 << linesOfSource(m.other->source, m.other->values, m.other->peak, m.other->unit);
  if (!m.values) return lines << noneInsideText(m);
  const QString unit = unitText(m.valueUnit);
  return lines << meanText(*m.values, unit) << limitsText(*m.values, m.peak, unit)
               << countText(m.values->n, m.frame.has_value());
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

// Returns "23.4 × 12.1 mm (283.1 mm²)", or "Ratio 0.48", "Heart 130.2, thorax 271 mm".
QStringList twoLinesText(ShapeKind kind, const Measured& m) {
  const TwoLines& lines = *m.lines;
  const QString first = shortNumberText(lines.first), second = withUnit(lines.second, lines.unit);
  QString word;
  if (m.frame && !m.frame->calibration.empty()) word = tr(" (%1)").arg(shownText(m.frame->calibration));
  if (kind == ShapeKind::cardiothoracic)
    return {tr("Ratio %1").arg(QString::number(m.number, 'f', 2)),
            tr("Heart %1, thorax %2").arg(first, second) + word};
  return {
      tr("%1 \u00d7 %2 (%3)").arg(first, second, withUnit(lines.first * lines.second, lines.unit + "^2")) +
      word};
}

// Returns "5.8° varus", "HKA 174.2°". An angle that reads as straight is neither varus nor valgus.
QStringList legAxisText(const Measured& m) {
  constexpr double straight = 0.05;
  const QString number = withUnit(m.number, m.unit);
  const bool isNamed = m.leg->bend != LegAxis::Bend::unknown && m.number >= straight;
  const QString bent = !isNamed                              ? number
                       : m.leg->bend == LegAxis::Bend::varus ? tr("%1 varus").arg(number)
                                                             : tr("%1 valgus").arg(number);
  return {bent, tr("HKA %1").arg(withUnit(m.leg->hka, m.unit))};
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

QString noneInsideText(const Measured& m) { return m.frame ? tr("no pixel inside") : tr("no voxel inside"); }

QString shortNumberText(double number) {
  if (number == std::round(number) && std::abs(number) < 1e7) return QString::number(qlonglong(number));
  const double size = std::abs(number);
  const int decimals = size >= 10 || size == 0 ? 1 : std::min(12, 2 - int(std::floor(std::log10(size))));
  return QString::number(number, 'f', decimals);
}

QStringList measuredLines(const Shape& shape, const Result<Measured>& measured) {
  if (ruleOf(shape.kind).numberless) return {};
  if (!measured) return {shownText(measured.message())};
  if (ruleOf(shape.kind).region) return regionLines(*measured);
  if (measured->leg) return legAxisText(*measured);
  if (measured->lines) return twoLinesText(shape.kind, *measured);
  QStringList lines{extentText(*measured)};
  if (measured->frame) lines = frameLines(*measured->frame, std::move(lines));
  if (measured->voxel && measured->voxel->padding) lines << tr("padding");
  if (measured->drawn) lines << tr("%1 as drawn").arg(withUnit(*measured->drawn, measured->unit));
  return lines;
}

QString measuredText(const Shape& shape, const Result<Measured>& measured) {
  return measuredLines(shape, measured).join(QStringLiteral(", "));
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
