#include "ui/workspace/measurement_text.h"

#include <QLocale>
#include <cmath>

#include "ui/workspace/measurements.h"
#include "ui/workspace/text.h"
#include "ui/workspace/value_text.h"

namespace volumen {

namespace {

// A unit as it stands behind a number: an angle's sign touches it.
QString unitText(const std::string& unit) {
  if (unit == "degrees") return QStringLiteral("\u00b0");
  if (unit == "mm^2") return QStringLiteral(" mm\u00b2");
  if (unit == "px^2") return QStringLiteral(" px\u00b2");
  return unit.empty() ? QString() : QLatin1Char(' ') + shownText(unit);
}

// An area below a hundredth of a mm^2 is still no 0.
QString withUnit(double number, const std::string& unit) {
  if (unit == "degrees") return QString::number(number, 'f', 1) + unitText(unit);
  return shortNumberText(number) + unitText(unit);
}

// Lengths and areas with the word that says what is true of their mm.
QString extentText(const Measured& m) {
  const QString text = withUnit(m.number, m.unit);
  return m.frame && !m.frame->calibration.empty() ? tr("%1 (%2)").arg(text, shownText(m.frame->calibration))
                                                  : text;
}

QString noneInside(const Measured& m) { return m.frame ? tr("no pixel inside") : tr("no voxel inside"); }

QString countText(const Measured& m) {
  const QString number = QLocale().toString(qlonglong(m.values->n));
  if (m.values->n == 1) return m.frame ? tr("1 pixel") : tr("1 voxel");
  return m.frame ? tr("%1 pixels").arg(number) : tr("%1 voxels").arg(number);
}

// In a region of ultrasound that counts something else than cm: "0.502 s, 12 cm/s".
QString readingText(const FrameReading& frame) {
  QStringList parts;
  for (const std::optional<AxisReading>& reading : {frame.across, frame.down})
    if (reading) parts << QString::number(reading->number, 'g', 3) + unitText(reading->unit);
  return parts.join(QStringLiteral(", "));
}

// Behind a length with its +-: " (at detector), 0.502 s".
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

QStringList regionLines(const Measured& m) {
  QStringList lines{tr("Area %1").arg(extentText(m))};
  if (m.frame && m.frame->colour) return lines;
  if (!m.values) return lines << noneInside(m);
  const QString unit = unitText(m.valueUnit);
  lines << tr("Mean %1, SD %2%3").arg(shortNumberText(m.values->mean), shortNumberText(m.values->sd), unit);
  lines << tr("Min %1, max %2%3").arg(shortNumberText(m.values->min), shortNumberText(m.values->max), unit);
  return lines << countText(m);
}

// A field between quotation marks where it needs them.
QString csvField(QString text) {
  if (!text.contains(QLatin1Char(',')) && !text.contains(QLatin1Char('"')) &&
      !text.contains(QLatin1Char('\n')))
    return text;
  return QLatin1Char('"') + text.replace(QLatin1Char('"'), QStringLiteral("\"\"")) + QLatin1Char('"');
}

QString exact(double number) { return QString::number(number, 'g', QLocale::FloatingPointShortest); }

// number, unit, +-, mean, SD, min, max, voxels, unit of the values, problem, calibration.
QStringList csvNumbers(const Result<Measured>* measured) {
  QStringList fields(11, QString());
  if (!measured)
    fields[9] = tr("not measured yet");
  else if (!*measured)
    fields[9] = QString::fromStdString(measured->message());
  if (!measured || !*measured) return fields;
  const Measured& m = **measured;
  fields[0] = exact(m.number);
  fields[1] = QString::fromStdString(m.unit);
  if (m.plusMinus) fields[2] = exact(*m.plusMinus);
  if (m.values) {
    const double numbers[] = {m.values->mean, m.values->sd, m.values->min, m.values->max};
    for (int n = 0; n < 4; ++n) fields[3 + n] = exact(numbers[n]);
    fields[7] = QString::number(m.values->n);
    fields[8] = QString::fromStdString(m.valueUnit);
  }
  if (m.unit.ends_with("^2") && !m.values && !(m.frame && m.frame->colour)) fields[9] = noneInside(m);
  if (m.frame && m.frame->rgb) fields[0].clear();
  if (m.frame) fields[10] = QString::fromStdString(m.frame->calibration);
  return fields;
}

}  // namespace

QString kindText(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::length:
      return tr("Length");
    case ShapeKind::polyline:
      return tr("Polyline");
    case ShapeKind::angle:
      return tr("Angle");
    case ShapeKind::cobb:
      return tr("Cobb angle");
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

QString shortNumberText(double number) {
  if (number == std::round(number) && std::abs(number) < 1e7) return QString::number(qlonglong(number));
  const double size = std::abs(number);
  const int decimals = size >= 10 || size == 0 ? 1 : std::min(12, 2 - int(std::floor(std::log10(size))));
  return QString::number(number, 'f', decimals);
}

QStringList measuredLines(const Shape& shape, const Result<Measured>& measured) {
  if (shape.kind == ShapeKind::arrow) return {};
  if (!measured) return {shownText(measured.message())};
  if (ruleOf(shape.kind).region) return regionLines(*measured);
  QStringList lines{extentText(*measured)};
  if (measured->frame) lines = frameLines(*measured->frame, std::move(lines));
  if (measured->voxel && measured->voxel->padding) lines << tr("padding");
  if (measured->drawn) lines << tr("%1 as drawn").arg(withUnit(*measured->drawn, measured->unit));
  return lines;
}

QString measuredText(const Shape& shape, const Result<Measured>& measured) {
  return measuredLines(shape, measured).join(QStringLiteral(", "));
}

QString detailText(const Measurement& measurement, const Result<Measured>& measured, const Series& series) {
  QString text = nameText(measurement);
  if (measured && measured->plusMinus)
    text += QStringLiteral(": %1 \u00b1 %2%3")
                .arg(shortNumberText(measured->number), shortNumberText(*measured->plusMinus),
                     unitText(measured->unit)) +
            wordsBehind(*measured);
  else if (const QString numbers = measuredText(measurement.shape, measured); !numbers.isEmpty())
    text += QStringLiteral(": ") + numbers;
  if (measured && measured->voxel && measured->frame)
    text += tr(", pixel %1, %2").arg(measured->voxel->index.x).arg(measured->voxel->index.y);
  else if (measured && measured->voxel)
    text += tr(", voxel %1, %2, %3")
                .arg(measured->voxel->index.x)
                .arg(measured->voxel->index.y)
                .arg(measured->voxel->index.z);
  if (measured && (measured->unit == "px" || measured->unit == "px^2")) text += tr(", not calibrated");
  if (measured && (measured->values || measured->voxel)) text += unitNote(series);
  return measurement.shape.kind == ShapeKind::arrow
             ? text
             : tr("%1, from %2").arg(text, sourceText(measurement, series));
}

QString sourceText(const Measurement& measurement, const Series& series) {
  const QString text = seriesText(series);
  const auto frame = measurement.shape.frame ? frameMeant(series, *measurement.shape.frame) : std::nullopt;
  return frame ? tr("%1, frame %2").arg(text).arg(*frame + 1) : text;
}

QString measurementsAsText(const std::vector<MeasuredRow>& rows) {
  QString text;
  for (const MeasuredRow& row : rows) {
    text += nameText(row.measurement);
    const QString numbers = row.measured ? measuredText(row.measurement.shape, *row.measured) : QString();
    if (!numbers.isEmpty()) text += QStringLiteral(": ") + numbers;
    if (row.series) text += QStringLiteral(" (%1)").arg(sourceText(row.measurement, *row.series));
    text += QLatin1Char('\n');
  }
  return text;
}

QString measurementsAsCsv(const std::vector<MeasuredRow>& rows) {
  QString text = QStringLiteral(
      "name,kind,number,unit,plus_minus,mean,sd,min,max,voxels,value_unit,problem,series,points_mm,"
      "calibration,"
      "frame_instance,frame_number,points_px\r\n");
  for (const MeasuredRow& row : rows) {
    const std::optional<ShapeFrame>& frame = row.measurement.shape.frame;
    QStringList points;
    for (const glm::dvec3 p : row.measurement.shape.points)
      points << (frame ? QStringLiteral("%1 %2").arg(exact(p.x), exact(p.y))
                       : QStringLiteral("%1 %2 %3").arg(exact(p.x), exact(p.y), exact(p.z)));
    const QString places = points.join(QStringLiteral("; "));
    QStringList fields{nameText(row.measurement), QLatin1String(ruleOf(row.measurement.shape.kind).name)};
    fields += csvNumbers(row.measurement.shape.kind == ShapeKind::arrow ? nullptr : row.measured);
    const QString calibration = fields.takeLast();
    if (row.measurement.shape.kind == ShapeKind::arrow) fields.last().clear();
    fields << (row.series ? seriesText(*row.series) : QString()) << (frame ? QString() : places)
           << calibration;
    if (frame)
      fields << QString::fromStdString(frame->instance) << QString::number(frame->number) << places;
    else
      fields << QString() << QString() << QString();
    for (QString& field : fields) field = csvField(field);
    text += fields.join(QLatin1Char(',')) + QStringLiteral("\r\n");
  }
  return text;
}

}  // namespace volumen
