#include "ui/features/segments_to_files.h"

#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <algorithm>

#include "io/export/export_segments.h"
#include "results/text/text.h"
#include "ui/controller/segment_target.h"
#include "ui/controller/segments_on_slices.h"
#include "ui/panels/surface_dialog.h"
#include "ui/widgets/path_dialog.h"

namespace volumen {

namespace {

// Returns one file filter per format, such as "Segmentations of 3D Slicer (*.seg.nrrd)".
QString exportFilters() {
  QStringList filters;
  for (const SegmentFormat& format : segmentFormats())
    filters << QStringLiteral("%1 (*%2)").arg(QLatin1String(format.noun), QLatin1String(format.ending));
  return filters.join(QStringLiteral(";;"));
}

// Returns files that exist already, except the typed one, about which the file dialog has asked.
QStringList replacedBeside(const QString& typed, const std::vector<std::string>& files) {
  QStringList replaced;
  for (const std::string& file : files) {
    const QString path = QString::fromStdString(file);
    if (path != typed && QFileInfo::exists(path)) replaced << path;
  }
  return replaced;
}

// Returns the first ten names and the number of others.
QString namesText(const QStringList& files) {
  constexpr qsizetype most = 10;
  QStringList names;
  for (const QString& file : files.first(std::min(most, files.size())))
    names << shownText(QFileInfo(file).fileName().toStdString());
  const QString text = names.join(QStringLiteral(", "));
  return files.size() > most ? SegmentsToFiles::tr("%1 and %2 more").arg(text).arg(files.size() - most)
                             : text;
}

}  // namespace

SegmentsToFiles::SegmentsToFiles(Workbench& bench) : Feature(bench) {}

// Exports the segments as they are now, whatever happens while dialogs are open.
void SegmentsToFiles::ask() {
  const std::vector<SegmentMap> maps = copiesOf(allSegmentsShown(session_));
  if (maps.empty()) return;
  const QString usual = QLatin1String(segmentFormats().front().ending + 1);
  auto* dialog = openPathDialog(
      bench_.dialogParent(),
      {"segmentDialog", tr("Export segments"), exportFilters(), QStringLiteral("segmentation.") + usual});
  dialog->setDefaultSuffix(usual);
  connect(
      dialog, &QFileDialog::fileSelected, this,
      [this, maps, series = session_.series()->series](const QString& path) { save(maps, series, path); });
}

void SegmentsToFiles::save(const std::vector<SegmentMap>& maps, const Series& series, const QString& path) {
  const auto format = segmentFormatOf(path.toStdString());
  if (format && (*format)->isSurface) return chooseSurfaces(maps, series, path);
  writeTo(path, filesOfExport(path.toStdString(), segmentedOf(maps)),
          [this, maps, series, path](const std::vector<std::string>&) {
            bench_.document.segments.jobs().save(maps, series, path);
          });
}

void SegmentsToFiles::chooseSurfaces(const std::vector<SegmentMap>& maps, const Series& series,
                                     const QString& path) {
  auto* dialog = new SurfaceDialog(maps, bench_.document.jobs, bench_.dialogParent());
  connect(dialog, &QDialog::accepted, this, [this, dialog, maps, series, path] {
    writeTo(path, filesOfExport(path.toStdString(), segmentedOf(maps), dialog->writing()),
            [this, surfaces = dialog->surfaces(), series](const std::vector<std::string>& files) {
              bench_.document.segments.jobs().saveSurfaces(surfaces, series, files);
            });
  });
  dialog->open();
}

void SegmentsToFiles::writeTo(const QString& path, const Result<std::vector<std::string>>& files,
                              const std::function<void(const std::vector<std::string>& files)>& write) {
  if (!files) return warnUntilDone(QString::fromStdString(files.message()));
  const QStringList replaced = replacedBeside(path, *files);
  if (replaced.isEmpty()) return write(*files);
  askBeforeReplacing(replaced, [write, files = *files] { write(files); });
}

void SegmentsToFiles::askBeforeReplacing(const QStringList& files, const std::function<void()>& replace) {
  auto* box =
      new QMessageBox(QMessageBox::Question, QStringLiteral("volumen"),
                      files.size() == 1 ? tr("Replace a file that is there already?")
                                        : tr("Replace %1 files that are there already?").arg(files.size()),
                      QMessageBox::Cancel, bench_.dialogParent());
  box->setObjectName(QStringLiteral("replaceBox"));
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setTextFormat(Qt::PlainText);
  box->setInformativeText(namesText(files));
  box->setDefaultButton(QMessageBox::Cancel);
  connect(box->addButton(tr("Replace"), QMessageBox::DestructiveRole), &QPushButton::clicked, this, replace);
  box->open();
}

}  // namespace volumen
