#include "ui/session/text.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QStringList>
#include <algorithm>
#include <cmath>

namespace volumen {

namespace {

QString tr(const char* text) { return QCoreApplication::translate("volumen", text); }

// Invisible characters that would reorder what stands beside them.
bool reorders(QChar c) {
  const char16_t u = c.unicode();
  return u == 0x061c || (u >= 0x200e && u <= 0x200f) || (u >= 0x202a && u <= 0x202e) ||
         (u >= 0x2066 && u <= 0x2069);
}

}  // namespace

QString shownText(const std::string& utf8) {
  QString text;
  for (const QChar c : QString::fromStdString(utf8)) {
    if (reorders(c)) continue;
    text += c.category() == QChar::Other_Control ? QLatin1Char(' ') : c;
  }
  return text.simplified();
}

QString patientText(const Series& series) {
  QString name = shownText(series.patientName);
  const QStringList parts = name.section(QLatin1Char('='), 0, 0).split(QLatin1Char('^'), Qt::SkipEmptyParts);
  if (parts.size() > 1)
    name = parts[0] + QStringLiteral(", ") + parts.mid(1).join(QLatin1Char(' '));
  else if (!parts.isEmpty())
    name = parts[0];
  const QString id = shownText(series.patientId);
  if (name.isEmpty() && id.isEmpty()) return series.format == "DICOM" ? tr("unknown patient") : QString();
  if (id.isEmpty() || id == name) return name;
  return name.isEmpty() ? id : QStringLiteral("%1 (%2)").arg(name, id);
}

QString studyText(const Series& series) {
  QStringList study{dateText(series.studyDate), shownText(series.studyDescription)};
  study.removeAll(QString());
  if (study.isEmpty() && series.format == "DICOM") return tr("(no date)");
  return study.join(QLatin1Char(' '));
}

QString seriesText(const Series& series) {
  QStringList parts;
  if (!series.modality.empty()) parts << shownText(series.modality);
  QString description = shownText(series.description);
  if (description.isEmpty() && series.format != "DICOM")
    description = QFileInfo(QString::fromStdString(series.path)).fileName();
  if (!description.isEmpty()) parts << description;
  if (!series.seriesNumber.empty()) parts << QStringLiteral("(%1)").arg(shownText(series.seriesNumber));
  if (parts.isEmpty()) parts << shownText(series.id);
  return parts.join(QLatin1Char(' '));
}

QString valueUnit(const Volume& volume) {
  return volume.attributes().modality == "CT" ? QStringLiteral("HU") : QString();
}

int valueDecimals(const Histogram& histogram) {
  const double range = std::max(1e-9, histogram.high - histogram.low);
  return std::clamp(int(std::ceil(4 - std::log10(range))), 1, 6);
}

QString dateText(const std::string& dicomDate) {
  if (dicomDate.size() != 8) return shownText(dicomDate);
  const QString d = QString::fromStdString(dicomDate);
  return QStringLiteral("%1-%2-%3").arg(d.left(4), d.mid(4, 2), d.mid(6, 2));
}

QString timeText(const std::string& dicomTime) {
  const QString t = shownText(dicomTime).section(QLatin1Char('.'), 0, 0);
  if (t.size() != 6) return t;
  return QStringLiteral("%1:%2:%3").arg(t.left(2), t.mid(2, 2), t.mid(4, 2));
}

}  // namespace volumen
