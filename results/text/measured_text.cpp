#include "results/text/measured_text.h"

#include <QLocale>
#include <algorithm>
#include <cmath>

#include "results/text/text.h"

namespace volumen {

namespace {

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

}  // namespace

QString unitText(const std::string& unit) {
  if (unit == "degrees") return QStringLiteral("\u00b0");
  if (unit == "mm^2") return QStringLiteral(" mm\u00b2");
  if (unit == "px^2") return QStringLiteral(" px\u00b2");
  return unit.empty() ? QString() : QLatin1Char(' ') + shownText(unit);
}

QString withUnit(double number, const std::string& unit) {
  if (unit == "degrees") return QString::number(number, 'f', 1) + unitText(unit);
  return shortNumberText(number) + unitText(unit);
}

QString readingText(const FrameReading& frame) {
  QStringList parts;
  for (const std::optional<AxisReading>& reading : {frame.across, frame.down})
    if (reading) parts << QString::number(reading->number, 'g', 3) + unitText(reading->unit);
  return parts.join(QStringLiteral(", "));
}

QString noneInsideText(const Measured& m) { return m.frame ? tr("no pixel inside") : tr("no voxel inside"); }

QString shortNumberText(double number) {
  if (number == std::round(number) && std::abs(number) < 1e7) return QString::number(qlonglong(number));
  const double size = std::abs(number);  // an area below 0.01 mm^2 must not read as 0
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

}  // namespace volumen
