#include "results/text/text.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QStringList>
#include <algorithm>
#include <atomic>
#include <cmath>

#include "io/study/iso_date.h"
#include "io/study/study.h"
#include "io/zip_archive.h"
#include "results/text/value_text.h"

namespace volumen {

QString tr(const char* text) { return QCoreApplication::translate("volumen", text); }

namespace {

// Returns whether a character is invisible and would reorder its neighbours.
bool reorders(QChar c) {
  const char16_t u = c.unicode();
  return u == 0x061c || (u >= 0x200e && u <= 0x200f) || (u >= 0x202a && u <= 0x202e) ||
         (u >= 0x2066 && u <= 0x2069);
}

std::atomic<bool> hidden = false;

}  // namespace

void hideNames(bool on) { hidden = on; }

bool namesHidden() { return hidden; }

QString shownText(const std::string& utf8) {
  QString text;
  for (const QChar c : QString::fromStdString(utf8)) {
    if (reorders(c)) continue;
    text += c.category() == QChar::Other_Control ? QLatin1Char(' ') : c;
  }
  return text.simplified();
}

QString personText(const std::string& name) {
  for (const QString& group : shownText(name).split(QLatin1Char('='))) {
    QStringList parts;
    for (const QString& part : group.split(QLatin1Char('^')))
      if (const QString word = part.trimmed(); !word.isEmpty()) parts << word;
    if (parts.size() == 1) return parts[0];
    if (!parts.isEmpty()) return parts[0] + QStringLiteral(", ") + parts.mid(1).join(QLatin1Char(' '));
  }
  return {};
}

namespace {

QString patientText(const SeriesIdentity& whose, bool isDicom) {
  const QString name = personText(whose.patientName);
  const QString id = shownText(whose.patientId);
  if (hidden && (isDicom || !name.isEmpty() || !id.isEmpty())) return tr("(name hidden)");
  if (name.isEmpty() && id.isEmpty()) return isDicom ? tr("(no name)") : QString();
  if (id.isEmpty() || id == name) return name;
  return name.isEmpty() ? id : QStringLiteral("%1 (%2)").arg(name, id);
}

}  // namespace

QString patientText(const Series& series) { return patientText(series, series.format == "DICOM"); }

QString patientText(const DerivedObject& object) { return patientText(object, true); }

QString seriesText(const Series& series) {
  QStringList parts;
  if (!series.modality.empty()) parts << shownText(series.modality);
  QString description = shownText(series.description);
  const bool isFile = series.format != "DICOM" && series.format != "phantom" && !series.curved;
  if (isFile && hidden && description.isEmpty()) description = tr("(file name hidden)");
  // A description that programs write into a file is rarely its name.
  if (isFile ? !hidden : description.isEmpty() && series.format == "phantom")
    description = QFileInfo(QString::fromStdString(series.path)).fileName();
  if (!description.isEmpty()) parts << description;
  if (!series.seriesNumber.empty()) parts << QStringLiteral("(%1)").arg(shownText(series.seriesNumber));
  if (parts.isEmpty()) parts << (hidden ? tr("(ID hidden)") : shownText(series.id));
  return parts.join(QLatin1Char(' '));
}

QString studyText(const Series& series) {
  QStringList parts{dateText(series.studyDate), shownText(series.studyDescription)};
  if (parts[0].isEmpty() && series.format == "DICOM") parts[0] = tr("(no date)");
  parts.removeAll(QString());
  return parts.join(QLatin1Char(' '));
}

QString unreadText(const Study& study) {
  const std::size_t refused = study.refused.size(), others = study.other.size();
  if (refused == 0)
    return others == 0   ? QString()
           : others == 1 ? tr("1 file is not an image.")
                         : tr("%1 files are not images.").arg(others);
  const QString text =
      refused == 1 ? tr("1 file could not be read") : tr("%1 files could not be read").arg(refused);
  return others == 0   ? tr("%1.").arg(text)
         : others == 1 ? tr("%1; 1 other is not an image.").arg(text)
                       : tr("%1; %2 others are not images.").arg(text).arg(others);
}

QStringList refusedTexts(const std::vector<Refused>& refused) {
  QStringList texts;
  for (const Refused& each : refused)
    texts << pathText(each.path) + QStringLiteral(": ") + shownText(each.reason);
  return texts;
}

QString noVolumesText(const Study& study) {
  const std::size_t images = study.images.size();
  QStringList sentences{unreadText(study)};
  if (images == 1) sentences << tr("1 picture is no volume.");
  if (images > 1) sentences << tr("%1 pictures are no volumes.").arg(images);
  sentences.removeAll(QString());
  return sentences.join(QLatin1Char(' '));
}

QString viewText(const QString& name) { return tr("%1 view").arg(name.left(1).toUpper() + name.mid(1)); }

QString unitSuffix(const Series& series) {
  const QString unit = shownText(shownScale(series).unit);
  return unit.isEmpty() ? unit : QLatin1Char(' ') + unit;
}

int valueDecimals(const Histogram& histogram) {
  const double range = std::max(1e-9, histogram.high - histogram.low);
  return std::clamp(int(std::ceil(4 - std::log10(range))), 1, 6);
}

QString pathText(const std::string& path) {
  return hidden ? tr("(path hidden)") : shownText(lastingPath(path));
}

QString dateText(const std::string& dicomDate) {
  if (hidden) return dicomDate.empty() ? QString() : tr("(date hidden)");
  return shownText(isoDate(dicomDate));
}

QString timeText(const std::string& dicomTime) {
  const QString t = shownText(dicomTime).section(QLatin1Char('.'), 0, 0);
  if (t.size() == 4) return QStringLiteral("%1:%2").arg(t.left(2), t.mid(2, 2));
  if (t.size() != 6) return t;
  return QStringLiteral("%1:%2:%3").arg(t.left(2), t.mid(2, 2), t.mid(4, 2));
}

}  // namespace volumen
