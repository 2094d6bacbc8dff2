#include "ui/features/segments_from_files.h"

#include <QDropEvent>

#include "results/text/text.h"
#include "ui/controller/segment_import.h"
#include "ui/controller/segment_target.h"
#include "ui/widgets/path_dialog.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/dropped_files.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

SegmentsFromFiles::SegmentsFromFiles(Workbench& bench, QWidget& panel) : Feature(bench) {
  import_ = bench_.addAction({"importSegments",
                              tr("Import segments..."),
                              {},
                              "",
                              false,
                              [this](bool) { ask(); },
                              {{"fileMenu", 40, 20}, {"segmentsMenu", 30}}});
  panel.setAcceptDrops(true);
  panel.installEventFilter(this);
  connect(&bench_, &Workbench::segmentsRequested, this, &SegmentsFromFiles::take);
  whenChanged(session_, this, &SegmentsFromFiles::showAction, &Workspace::series, &Workspace::segmentMaps);
  connect(&session_, &Session::changed, this, &SegmentsFromFiles::showAction);
  showAction();
}

void SegmentsFromFiles::showAction() {
  const QString why = whyNoSegments(session_);
  import_->setEnabled(why.isEmpty());
  import_->setToolTip(toolTipOf(
      why.isEmpty() ? tr("Add the segments of a file to those of this series: a DICOM segmentation, a "
                         ".seg.nrrd, or an image of labels.")
                    : why));
}

void SegmentsFromFiles::take(const QStringList& paths) {
  const QString why = whyNoSegments(session_);
  if (!why.isEmpty()) return warn(why);
  if (!sceneIsOfFocus(session_.workspace())) return warn(isOfOtherSeries());
  for (const QString& path : paths)
    bench_.document.segments.change(importOf(path, session_.series()->series, wholeVolume(session_),
                                             [this](const QStringList& sentences) {
                                               tell(sentences.front());
                                               if (sentences.size() > 1)
                                                 warnUntilDone(sentences.join(QLatin1Char(' ')));
                                             }));
}

void SegmentsFromFiles::ask() {
  const auto* dialog =
      openPathDialog(bench_.dialogParent(),
                     {"segmentImportDialog", tr("Import segments"), {}, {}, QFileDialog::ExistingFiles});
  connect(dialog, &QFileDialog::filesSelected, this, &SegmentsFromFiles::take);
}

bool SegmentsFromFiles::eventFilter(QObject* panel, QEvent* event) {
  if (event->type() != QEvent::DragEnter && event->type() != QEvent::Drop)
    return Feature::eventFilter(panel, event);
  auto* drop = static_cast<QDropEvent*>(event);
  const QStringList files = localFiles(*drop->mimeData());
  if (files.isEmpty()) return Feature::eventFilter(panel, event);
  drop->acceptProposedAction();
  if (event->type() == QEvent::Drop) take(files);
  return true;
}

}  // namespace volumen
