#include <QMenu>
#include <QPointer>
#include <algorithm>
#include <utility>

#include "io/export/export_segments.h"
#include "ui/controller/curve_follower.h"
#include "ui/controller/segment_target.h"
#include "ui/derivations/masking.h"
#include "ui/features/segments_from_files.h"
#include "ui/features/segments_to_files.h"
#include "ui/panels/segment_numbers_dialog.h"
#include "ui/panels/segments_panel.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

bool areCutAlike(const Workspace& a, const Workspace& b) {
  const auto maskOfEntry = [](const auto& entry) { return entry.second.mask; };
  return std::ranges::equal(a.series, b.series, {}, maskOfEntry, maskOfEntry);
}

// Segments of a volume, and its masking by table removal and scissors.
class Segmenting : public Feature {
 public:
  explicit Segmenting(Workbench& bench);
  ~Segmenting() override { delete numbersDialog_; }  // refers to the painter

 private:
  void connectMasks();
  void makeExport();
  void connectPanel();
  void connectAxis();
  void showExport();
  void show(const SegmentAnswer& answer);
  void showNumbers();
  void tellSaved(const QStringList& files, const QStringList& notes, const std::vector<SegmentMap>& maps);

  SegmentEditing& editing_;
  CurveFollower follower_;
  SegmentNumbers numbers_;
  Masking masker_;
  SegmentsPanel* panel_;
  SegmentsFromFiles fromFiles_;
  SegmentsToFiles toFiles_;
  QAction* export_;
  QPointer<SegmentNumbersDialog> numbersDialog_;
};

Segmenting::Segmenting(Workbench& bench)
    : Feature(bench),
      editing_(bench.document.segments),
      follower_(session_, editing_.painter(), bench.document.jobs),
      numbers_(segmentNumbersRule(session_, editing_.painter()), session_, &bench.document.jobs),
      masker_(session_, bench.document.jobs),
      panel_(new SegmentsPanel(editing_, numbers_)),
      fromFiles_(bench, *panel_),
      toFiles_(bench) {
  bench_.addDock({"segment",
                  tr("Segments"),
                  bench_.ofScene(Workbench::scrolling(panel_)),
                  {Qt::RightDockWidgetArea, 30}});
  connectMasks();
  makeExport();
  connectPanel();
  connectAxis();
  bench_.menus.addMenu(panel_->recipeMenu(), {});
  connect(&bench_, &Workbench::made, this, [this] { panel_->setToolActions(bench_.toolActions); });
}

void Segmenting::connectMasks() {
  for (QAction* action : {masker_.tableAction(), masker_.resetAction()}) {
    action->setParent(&bench_.window);
    bench_.addAction(action, {{"editMenu", 20}, {"sceneMenu", 30}});
  }
  panel_->setTableAction(masker_.tableAction());
  connect(&bench_, &Workbench::sceneMenuOpens, this, [this](QMenu* menu) {
    menu->addActions({masker_.tableAction(), masker_.resetAction()});
  });
  connect(&masker_, &Masking::failed, this, [this](const QString& sentence) { warnUntilDone(sentence); });
  DrawnScenes& drawn = bench_.document.drawn;
  connect(&drawn, &DrawnScenes::failed, this, [this](const QString& sentence) { warnUntilDone(sentence); });
  connect(&drawn, &DrawnScenes::cancelled, this, [this](const QString& sentence) { tell(sentence); });
  bench_.forEachVolumeView([this, &drawn](VolumeView* view) {
    connect(view, &VolumeView::lassoDrawn, &masker_, &Masking::cut);
    connect(view, &VolumeView::drawn, &drawn, [view, &drawn](const ScreenPicture& picture) {
      if (picture.atRest && view->series()) drawn.noteDrawn(keyOf(view->series()->series));
    });
  });
}

void Segmenting::makeExport() {
  export_ = bench_.addAction({"exportSegments",
                              tr("Export segments..."),
                              {},
                              "",
                              false,
                              [this](bool) { toFiles_.ask(); },
                              {{"fileMenu", 40, 20}, {"segmentsMenu", 30}}});
  panel_->setExportAction(export_);
  showExport();
}

void Segmenting::showExport() {
  const QString why = whyNoSegments(session_);
  const bool isThere = segmentsShown(session_) != nullptr;
  export_->setEnabled(isThere);
  export_->setToolTip(toolTipOf(isThere          ? tr("Save the segments of this series in a file.")
                                : !why.isEmpty() ? why
                                                 : tr("There is no segment yet.")));
}

void Segmenting::connectPanel() {
  connect(panel_, &SegmentsPanel::numbersWanted, this, &Segmenting::showNumbers);
  connect(panel_, &SegmentsPanel::recipeChosen, &bench_, &Workbench::recipeWanted);
  connect(panel_, &SegmentsPanel::previewChanged, &grid_, &ViewGrid::showSegment);
  connect(&editing_, &SegmentEditing::answered, this, &Segmenting::show);
  connect(&editing_.jobs(), &SegmentJobs::saved, this, &Segmenting::tellSaved);
  // Messages about segments or cuts no longer hold once these have changed.
  whenChanged(session_, this, &Segmenting::takeBack, &Workspace::segmentMaps, std::not_fn(areCutAlike));
  whenChanged(session_, this, &Segmenting::showExport, &Workspace::series, &Workspace::segmentMaps);
  connect(&session_, &Session::changed, this, &Segmenting::showExport);
  // From the event loop, because Esc undoes the steps since the press once the stroke has ended.
  connect(
      &editing_.painter(), &SegmentPainter::ended, this, [this] { numbers_.update(); }, Qt::QueuedConnection);
  panel_->showSegments();
}

void Segmenting::show(const SegmentAnswer& answer) {
  switch (answer.kind) {
    case SegmentAnswer::Kind::done:
      return tell(answer.sentence);
    case SegmentAnswer::Kind::refused:
      return warn(answer.sentence);
    case SegmentAnswer::Kind::noted:
    case SegmentAnswer::Kind::failed:
      return warnUntilDone(answer.sentence);
  }
}

// Shows the range's ends on the axis of the curve. While one is dragged, 3D shows only values in the range.
void Segmenting::connectAxis() {
  connect(panel_, &SegmentsPanel::rangeShown, this, [this](const std::optional<ValueRange>& range) {
    Q_EMIT bench_.rangeShown(range);
    if (!range) grid_.showOnly({});
  });
  connect(&bench_, &Workbench::rangeDragged, this, [this](const ValueRange& range, bool ended) {
    editing_.choose([&](SegmentOptions& options) { options.range = range; });
    grid_.showOnly(ended ? std::nullopt
                         : std::optional(VolumeRange{session_.series()->volume, editing_.options().range}));
  });
  connect(&bench_, &Workbench::curvePulled, &follower_, &CurveFollower::follow);
  connect(&follower_, &CurveFollower::answered, this, &Segmenting::show);
}

void Segmenting::showNumbers() {
  if (!numbersDialog_)
    numbersDialog_ =
        new SegmentNumbersDialog(session_, bench_.document.jobs, editing_.painter(), bench_.dialogParent());
  numbersDialog_->show();
  numbersDialog_->raise();
  numbersDialog_->activateWindow();
}

// A surface is no segment, so saving it does not count as saving manual work.
void Segmenting::tellSaved(const QStringList& files, const QStringList& notes,
                           const std::vector<SegmentMap>& maps) {
  tell((QStringList(tr("Saved %1").arg(files.join(QStringLiteral(", ")))) + notes).join(QLatin1Char(' ')));
  const auto format = segmentFormatOf(files.front().toStdString());
  if (!format || (*format)->isSurface) return;
  HandWork work;
  work.segmentMaps = maps;
  bench_.document.files.savedApart(work);
}

}  // namespace

std::unique_ptr<Feature> makeSegmenting(Workbench& bench) { return std::make_unique<Segmenting>(bench); }

}  // namespace volumen
