#include "ui/controller/mask_jobs.h"
#include "ui/controller/segment_jobs.h"
#include "ui/features/feature.h"
#include "ui/panels/segment_panel.h"
#include "ui/views/view_grid.h"

namespace volumen {

namespace {

// Segments by a range of values, and what is taken away from a volume: its table, what the scissors cut.
class Segmenting : public Feature {
 public:
  explicit Segmenting(Workbench& bench);

 private:
  void connectSegmenter();
  void take(const SegmentMap& made);

  SegmentJobs segmenter_;
  MaskJobs masker_;
  SegmentPanel* panel_;
};

Segmenting::Segmenting(Workbench& bench)
    : Feature(bench),
      segmenter_(bench.document.jobs),
      masker_(session_, bench.document.jobs),
      panel_(new SegmentPanel(session_)) {
  bench_.addDock({"segment",
                  tr("Segment"),
                  bench_.ofScene(Workbench::scrolling(panel_)),
                  {Qt::RightDockWidgetArea, 30}});
  for (QAction* action : {masker_.tableAction(), masker_.resetAction()}) {
    action->setParent(&bench_.window);
    bench_.addAction(action, {{"editMenu", 20}});
  }
  panel_->setTableAction(masker_.tableAction());
  connect(&masker_, &MaskJobs::failed, this, [this](const QString& sentence) { warn(sentence); });
  bench_.forEachVolumeView(
      [this](VolumeView* view) { connect(view, &VolumeView::lassoDrawn, &masker_, &MaskJobs::cut); });
  connectSegmenter();
}

void Segmenting::connectSegmenter() {
  connect(panel_, &SegmentPanel::segmentRequested, &segmenter_, &SegmentJobs::segment);
  connect(panel_, &SegmentPanel::saveRequested, &segmenter_, &SegmentJobs::save);
  connect(panel_, &SegmentPanel::previewChanged, &grid_, &ViewGrid::showSegment);
  connect(panel_, &SegmentPanel::measureRequested, &segmenter_, &SegmentJobs::measure);
  connect(&segmenter_, &SegmentJobs::segmented, this, &Segmenting::take);
  connect(&segmenter_, &SegmentJobs::measured, panel_, &SegmentPanel::showMeasured);
  connect(&segmenter_, &SegmentJobs::saved, this, [this](const QString& path, const SegmentMap& map) {
    tell(tr("Saved %1").arg(path));
    HandWork work;
    work.segmentMaps = {map};
    bench_.document.files.savedApart(work);
  });
  connect(&segmenter_, &SegmentJobs::failed, this, [this](const QString& sentence) {
    warn(sentence);
    panel_->showSegment();
  });
}

// One step; nothing where the series was closed meanwhile.
void Segmenting::take(const SegmentMap& made) {
  const Workspace& workspace = session_.workspace();
  if (!workspace.series.contains(made.series)) return;
  session_.endGesture();
  session_.change(tr("Segment"), withSegmentMap(workspace, made));
  session_.endGesture();
  panel_->showSegment();  // it may be what it was
}

}  // namespace

std::unique_ptr<Feature> makeSegmenting(Workbench& bench) { return std::make_unique<Segmenting>(bench); }

}  // namespace volumen
