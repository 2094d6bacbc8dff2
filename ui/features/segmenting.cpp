#include <QPointer>
#include <algorithm>
#include <utility>

#include "io/export/export_segments.h"
#include "ui/controller/curve_follower.h"
#include "ui/controller/segment_cutting.h"
#include "ui/controller/segment_preview.h"
#include "ui/controller/segment_target.h"
#include "ui/derivations/masking.h"
#include "ui/features/segments_from_files.h"
#include "ui/features/segments_to_files.h"
#include "ui/panels/segment_numbers_dialog.h"
#include "ui/panels/segments_panel.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/plain_text.h"

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
  void makeExport();
  void connectSegmenter();
  void connectAxis();
  void connectGrowth();
  void showExport();
  void takePart(const PartClick& click);
  void connectPainter();
  void paint(const SegmentStroke& stroke);
  void cutSegment(const SegmentCut& cut);
  void showNumbers();
  void tellIfAny(const QString& sentence);
  void tellSaved(const QStringList& files, const QStringList& notes, const std::vector<SegmentMap>& maps);

  SegmentPainter& painter_;
  SegmentJobs segmenter_;
  CurveFollower follower_;
  SegmentNumbers numbers_;
  SegmentPreview preview_;
  Masking masker_;
  SegmentsPanel* panel_;
  SegmentsFromFiles fromFiles_;
  SegmentsToFiles toFiles_;
  QAction* export_;
  QPointer<SegmentNumbersDialog> numbersDialog_;
};

Segmenting::Segmenting(Workbench& bench)
    : Feature(bench),
      painter_(bench.document.painter),
      segmenter_(session_, painter_, bench.document.jobs),
      follower_(session_, painter_, bench.document.jobs),
      numbers_(segmentNumbersRule(session_, painter_), &bench.document.jobs, session_.sharedPool()),
      preview_(session_, bench.document.jobs),
      masker_(session_, bench.document.jobs),
      panel_(new SegmentsPanel(session_, numbers_)),
      fromFiles_(bench, segmenter_, *panel_),
      toFiles_(bench, segmenter_) {
  bench_.addDock({"segment",
                  tr("Segments"),
                  bench_.ofScene(Workbench::scrolling(panel_)),
                  {Qt::RightDockWidgetArea, 30}});
  for (QAction* action : {masker_.tableAction(), masker_.resetAction()}) {
    action->setParent(&bench_.window);
    bench_.addAction(action, {{"editMenu", 20}, {"sceneMenu", 30}});
  }
  panel_->setTableAction(masker_.tableAction());
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
  makeExport();
  connectSegmenter();
  connectAxis();
  connectPainter();
  connectGrowth();
  connect(&grid_, &ViewGrid::partClicked, this, &Segmenting::takePart);
  connect(&bench_, &Workbench::made, this, [this] {
    panel_->setPartAction(bench_.action("partTool"));
    panel_->setPaintActions(bench_.action("paintTool"), bench_.action("outlineTool"),
                            bench_.action("segmentScissorsTool"));
    panel_->growPage().setToolActions(bench_.action("lesionTool"), bench_.action("levelTraceTool"),
                                      bench_.action("smartBrushTool"));
    panel_->setRecipeActions(
        {bench_.action("openRecipe"), bench_.action("saveRecipe"), bench_.action("recipeSteps")});
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

void Segmenting::connectSegmenter() {
  connect(panel_, &SegmentsPanel::workWanted, &segmenter_, &SegmentJobs::change);
  connect(panel_, &SegmentsPanel::told, this, [this](const QString& sentence) { warnUntilDone(sentence); });
  connect(panel_, &SegmentsPanel::numbersWanted, this, &Segmenting::showNumbers);
  connect(&bench_, &Workbench::segmentWorkWanted, &segmenter_, &SegmentJobs::change);
  connect(panel_, &SegmentsPanel::recipeChosen, &bench_, &Workbench::recipeWanted);
  connect(panel_, &SegmentsPanel::previewChanged, &grid_, &ViewGrid::showSegment);
  connect(&segmenter_, &SegmentJobs::ended, panel_, &SegmentsPanel::showSegments);
  connect(&segmenter_, &SegmentJobs::changed, this, &Segmenting::tellIfAny);
  connect(&segmenter_, &SegmentJobs::saved, this, &Segmenting::tellSaved);
  connect(&segmenter_, &SegmentJobs::failed, this,
          [this](const QString& sentence) { warnUntilDone(sentence); });
  // Messages about segments or cuts no longer hold once these have changed.
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            if (before.segmentMaps != after.segmentMaps || !areCutAlike(before, after)) takeBack();
            numbers_.update();
            showExport();
          });
  // From the event loop, because Esc undoes the steps since the press once the stroke has ended.
  connect(
      &painter_, &SegmentPainter::ended, this, [this] { numbers_.update(); }, Qt::QueuedConnection);
  panel_->showSegments();
}

void Segmenting::tellIfAny(const QString& sentence) {
  if (!sentence.isEmpty()) tell(sentence);
}

// Shows the range's ends on the axis of the curve. While one is dragged, 3D shows only values in the range.
void Segmenting::connectAxis() {
  SegmentRange* page = &panel_->rangePage();
  connect(page, &SegmentRange::rangeShown, this, [this](const std::optional<ValueRange>& range) {
    Q_EMIT bench_.rangeShown(range);
    if (!range) grid_.showOnly({});
  });
  connect(&bench_, &Workbench::rangeDragged, this, [this, page](const ValueRange& range, bool ended) {
    page->takeDragged(range);
    grid_.showOnly(ended ? std::nullopt
                         : std::optional(VolumeRange{session_.series()->volume, page->range()}));
  });
  connect(&bench_, &Workbench::curvePulled, &follower_, &CurveFollower::follow);
  connect(&follower_, &CurveFollower::told, this, &Segmenting::tellIfAny);
  connect(&follower_, &CurveFollower::failed, this,
          [this](const QString& sentence) { warnUntilDone(sentence); });
}

void Segmenting::connectPainter() {
  connect(&grid_, &ViewGrid::strokePainted, this, &Segmenting::paint);
  connect(&grid_, &ViewGrid::segmentCut, this, &Segmenting::cutSegment);
  connect(&painter_, &SegmentPainter::failed, this,
          [this](const QString& sentence) { warnUntilDone(sentence); });
  connect(&painter_, &SegmentPainter::ended, this, &Segmenting::tellIfAny);
}

void Segmenting::paint(const SegmentStroke& stroke) {
  SegmentStroke wanted = stroke;
  wanted.erases = stroke.erases || panel_->painting().erases();
  painter_.paint(wanted, panel_->painting().limits(panel_->range().range()));
}

void Segmenting::cutSegment(const SegmentCut& cut) {
  const QString why = whyNotCut(session_, cut);
  if (!why.isEmpty()) return warn(why);
  segmenter_.change(workOf(cut, panel_->painting().cutWithinMm(), session_));
}

void Segmenting::connectGrowth() {
  SegmentGrowPage* page = &panel_->growPage();
  connect(page, &SegmentGrowPage::growthWanted, this,
          [this](const SegmentWork& work) { segmenter_.change(preview_.withMade(work)); });
  connect(page, &SegmentGrowPage::previewWanted, &preview_, &SegmentPreview::show);
  connect(page, &SegmentGrowPage::previewEnded, &preview_, &SegmentPreview::clear);
  connect(page, &SegmentGrowPage::refused, this,
          [this](const QString& sentence) { warnUntilDone(sentence); });
  connect(&preview_, &SegmentPreview::changed, &grid_, &ViewGrid::showPreview);
  connect(&preview_, &SegmentPreview::failed, page, &SegmentGrowPage::previewFailed);
  connect(&grid_, &ViewGrid::ballDrawn, page, &SegmentGrowPage::takeBall);
}

void Segmenting::showNumbers() {
  if (!numbersDialog_)
    numbersDialog_ =
        new SegmentNumbersDialog(session_, bench_.document.jobs, painter_, bench_.dialogParent());
  numbersDialog_->show();
  numbersDialog_->raise();
  numbersDialog_->activateWindow();
}

// Takes a part of the series that the panel shows. The first part creates a segment.
void Segmenting::takePart(const PartClick& click) {
  if (click.onFrame) return warn(tr("Frames have no connected parts: show the series as slices."));
  const QString why = whyNoSegments(session_);
  if (!why.isEmpty()) return warn(why);
  if (click.series != keyOf(session_.series()->series))
    return warn(tr("The panel Segments is about another series: click into a view of that one."));
  const Segment* segment = segmentShown(session_);
  const PartUse use = panel_->range().partUse(click.keys);
  if (!segment && use != PartUse::add) return warn(whyNotChanged(session_));
  const ValueRange range = panel_->range().range();
  SegmentWork work;
  work.series = click.series;
  work.volume = wholeVolume(session_);
  work.text = use == PartUse::add    ? tr("Add connected part")
              : use == PartUse::keep ? tr("Keep connected part")
                                     : tr("Remove connected part");
  work.doing = tr("Finding the connected part");
  if (segment)
    work.number = segment->number;
  else
    work.change = [made = panel_->range().segmentOf(range)](Segment& s) { s = made; };
  const PartWanted wanted{work.volume,
                          session_.maskOf(click.series),
                          range,
                          click.pPatient,
                          click.onSurface,
                          use,
                          panel_->range().leakGuardMm(),
                          panel_->range().partNeighbours()};
  work.steps = [wanted](const SegmentMap& map, int number, const CancelToken& cancel) {
    return stepsOfPart(wanted, map, number, cancel);
  };
  segmenter_.change(work);
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
