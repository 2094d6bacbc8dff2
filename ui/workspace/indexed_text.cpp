#include "ui/workspace/indexed_text.h"

#include <QLocale>

#include "results/text/text.h"

namespace volumen {

namespace {

QString offlineText() {
  return tr(
      "Not there now: connect the disk or network folder that holds its files, or import the folder "
      "from where they are.");
}

// Returns one component group of a DICOM person name.
QString groupText(const std::string& name, int group) {
  const QString text = shownText(name).section(QLatin1Char('='), group, group);
  return text.split(QLatin1Char('^'), Qt::SkipEmptyParts).join(QLatin1Char(' ')).simplified();
}

}  // namespace

QString patientNameText(const std::string& name) {
  if (namesHidden()) return tr("(name hidden)");
  const QString first = personText(name), second = groupText(name, 1);
  if (first.isEmpty()) return tr("(no name)");
  return second.isEmpty() ? first : QStringLiteral("%1  %2").arg(first, second);
}

QString idText(const std::string& id) {
  return namesHidden() && !id.empty() ? tr("(ID hidden)") : shownText(id);
}

QString institutionText(const std::string& institution) {
  return namesHidden() && !institution.empty() ? tr("(institution hidden)") : shownText(institution);
}

QString seriesNameText(const IndexedSeries& series) {
  const QString number = shownText(series.number);
  return number.isEmpty() ? tr("Series") : tr("Series %1").arg(number);
}

QString contentText(const IndexedSeries& series) {
  QStringList parts{shownText(series.description), shownText(series.label)};
  parts.removeAll(QString());
  return parts.join(QStringLiteral(", "));
}

QString countText(int count) { return count < 0 ? QString() : QLocale().toString(count); }

QString imagesText(const IndexedSeries& series) {
  if (series.images < 0) return {};
  const QString images = series.images == 1 ? tr("1 image") : tr("%1 images").arg(countText(series.images));
  return series.frames > series.images ? tr("%1, %2 frames").arg(images, countText(series.frames)) : images;
}

QStringList everythingOf(const IndexedSeries& series) {
  const bool isKnownAsFrames = !series.isVolume && series.frames >= 0;
  QStringList lines{seriesNameText(series) + QLatin1Char(' ') + shownText(series.modality),
                    contentText(series), imagesText(series),
                    isKnownAsFrames ? tr("Shown as frames, not in 3D") : QString(), dateText(series.date)};
  if (!namesHidden()) lines << timeText(series.time);
  for (const std::string& warning : series.warnings) lines << QStringLiteral("! ") + shownText(warning);
  if (series.offline) lines << offlineText();
  lines.removeAll(QString());
  return lines;
}

QStringList everythingOf(const IndexedStudy& study) {
  QStringList lines{patientNameText(study.patientName), idText(study.patientId)};
  if (!namesHidden()) {
    if (!study.birthDate.empty()) lines << tr("Born %1").arg(dateText(study.birthDate));
    lines << shownText(study.sex);
  }
  lines << dateText(study.date) + QLatin1Char(' ') + shownText(study.description);
  if (!namesHidden() && !study.accessionNumber.empty())
    lines << tr("Accession number %1").arg(shownText(study.accessionNumber));
  if (!namesHidden()) lines << shownText(study.institution);
  if (study.series >= 0)
    lines << (study.series == 1 ? tr("1 series") : tr("%1 series").arg(countText(study.series)));
  lines << warningsText(study.warnings);
  if (study.offline) lines << offlineText();
  lines.removeAll(QString());
  return lines;
}

QString warningsText(int warnings) {
  if (warnings == 0) return {};
  return warnings == 1 ? tr("! 1 warning: hover over the series to read it")
                       : tr("! %1 warnings: hover over the series to read them").arg(countText(warnings));
}

QString importText(const ImportReport& report) {
  const int read = report.added + report.changed;
  QStringList parts{read == 1 ? tr("1 image imported") : tr("%1 images imported").arg(countText(read))};
  if (report.unchanged > 0) parts << tr("%1 were in the list already").arg(countText(report.unchanged));
  if (report.gone > 0) parts << tr("%1 are no longer there and left the list").arg(countText(report.gone));
  const QString text = parts.join(QStringLiteral("; ")) + QLatin1Char('.');
  return report.cancelled ? tr("Import cancelled. %1 Import the folder again to go on.").arg(text) : text;
}

}  // namespace volumen
