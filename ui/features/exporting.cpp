#include "ui/features/exporting.h"

#include <QBoxLayout>
#include <QPrintDialog>
#include <QPrinter>
#include <QStandardPaths>

#include "results/text/text.h"

namespace volumen {

ExportFeature::ExportFeature(Workbench& bench, const QString& unsaved)
    : Feature(bench), exports_(bench.document.jobs), unsaved_(unsaved) {
  connect(&exports_, &Exports::done, this, [this](const QString& sentence) { tell(sentence); });
  connect(&exports_, &Exports::failed, this, [this](const QString& sentence) { warnUntilDone(sentence); });
}

void ExportFeature::askForPath(PathQuestion question, const std::function<void(const QString& path)>& then) {
  const QString pictures = QStandardPaths::writableLocation(QStandardPaths::PicturesLocation);
  if (question.folder.isEmpty() && QFileInfo(pictures).isDir()) question.folder = pictures;
  connect(openPathDialog(bench_.dialogParent(), question), &QFileDialog::fileSelected, this, then);
}

void ExportFeature::askForPrinter(const char* name, QWidget* option,
                                  const std::function<void(const std::shared_ptr<QPrinter>&)>& then) {
  const auto printer = std::make_shared<QPrinter>(QPrinter::HighResolution);
  auto* dialog = new QPrintDialog(printer.get(), bench_.dialogParent());
  dialog->setObjectName(QLatin1String(name));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  // The option stands beside the printer, as the options below are collapsed.
  if (option) qobject_cast<QBoxLayout*>(dialog->layout())->insertWidget(1, option);
  connect(dialog, &QDialog::accepted, this, [printer, then] { then(printer); });
  connect(dialog, &QObject::destroyed, this, [printer] {});  // the dialog uses the printer until then
  dialog->open();
}

SnapshotSeen ExportFeature::sceneNow(bool namesHidden) const {
  const ViewId view = sceneViewOf(session_.workspace());
  const DrawnScenes& drawn = bench_.document.drawn;
  const TissueLeft::Entry* tissue = drawn.tissue(view);
  return {drawn.series(view), bench_.sceneInView(),
          segmentsInPicture(drawn.segments(view), tissue ? tissue->key.shown : TissueShown{}), namesHidden};
}

PictureMakerPtr ExportFeature::picturesOf(const SnapshotRequest& request) const {
  return scenePictures(bench_.document.drawService, request, [this](const Plan& plan) {
    return measuredError(bench_.document.meter.measured(), plan);
  });
}

QString ExportFeature::pictureFilters() { return tr("PNG pictures (*.png);;JPEG pictures (*.jpg *.jpeg)"); }

QString ExportFeature::fileName(const Series& series) {
  constexpr int longest = 80;
  return seriesText(series).replace(QLatin1Char('/'), QLatin1Char('_')).left(longest);
}

}  // namespace volumen
