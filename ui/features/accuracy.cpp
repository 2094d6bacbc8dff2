#include <QDockWidget>
#include <QMenu>

#include "ui/controller/qt_gl_context.h"
#include "ui/features/feature.h"
#include "ui/panels/accuracy_panel.h"
#include "ui/panels/effects_panel.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

// Shows the accuracy, time and effects of 3D pictures and chooses their quality.
class Accuracy : public Feature {
 public:
  explicit Accuracy(Workbench& bench);

 private:
  void connectMeter();
  void addCommands(QMenu* more);
  void applyLevel();
  void setResampler(Resampler resampler);

  DrawService& drawService_;
  AccuracyMeter& meter_;
  AccuracyPanel* panel_;
  EffectsPanel* effects_;
  bool isEstimated_ = false;  // true if the error of the picture on screen is estimated
};

Accuracy::Accuracy(Workbench& bench)
    : Feature(bench),
      drawService_(bench.document.drawService),
      meter_(bench.document.meter),
      panel_(new AccuracyPanel(session_)),
      effects_(new EffectsPanel) {
  bench_.addDock(
      {"effects", tr("Effects"), effects_, {Qt::RightDockWidgetArea, 90, false, Workbench::About::scene}});
  const QDockWidget* dock = bench_.addDock({"accuracy",
                                            tr("Quality and speed"),
                                            Workbench::scrolling(panel_),
                                            {Qt::RightDockWidgetArea, 100, false, Workbench::About::scene}});
  connect(dock, &QDockWidget::visibilityChanged, &meter_, &AccuracyMeter::setWatched);
  bench_.addAction({"openGlResampler",
                    tr("Use OpenGL (usually slower without a GPU)"),
                    {},
                    "",
                    true,
                    [this](bool on) { setResampler(on ? Resampler::gl : Resampler::cpu); },
                    {{"sceneMenu", 50}}});
  QAction* showError =
      bench_.addAction({"showError", tr("Show error map"), {}, "", true, {}, {{"sceneMenu", 50, 10}}});
  connect(panel_, &AccuracyPanel::errorWanted, showError, &QAction::setChecked);
  connect(showError, &QAction::toggled, panel_, &AccuracyPanel::setErrorWanted);
  connect(showError, &QAction::toggled, &grid_, &ViewGrid::setErrorShown);
  connect(showError, &QAction::toggled, this, [this](bool on) {
    drawService_.setErrorWanted(on);
    if (on && !isEstimated_) grid_.requestPictures();
  });
  connect(&bench_, &Workbench::drawn, panel_, [this](const ScreenPicture& drawn) {
    panel_->showEstimate(drawn);
    isEstimated_ = drawn.estimated.has_value();
    if (!drawn.draft()) effects_->showPlan(*drawn.plan, drawn.stats);
  });
  const DrawnScenes& drawn = bench_.document.drawn;
  const auto showNotDrawn = [this, &drawn] {
    effects_->showNotDrawn(notDrawnText(drawn.segmentsNotDrawn(sceneViewOf(session_.workspace()))));
  };
  whenChanged(session_, effects_, showNotDrawn, showsOther, &Workspace::segmentMaps);
  connect(&drawn, &DrawnScenes::changed, effects_, showNotDrawn);
  connect(&bench_, &Workbench::commandsOpen, this, &Accuracy::addCommands);
  connectMeter();
}

// Adds the quality levels that the panel's slider offers, by name.
void Accuracy::addCommands(QMenu* more) {
  if (!session_.series()) return;
  QMenu* menu = more->addMenu(tr("Quality of 3D pictures"));
  for (const PictureLevel level : pictureLevels())
    menu->addAction(tr("Quality %1").arg(QString::fromStdString(levelName(level))), this, [this, level] {
      session_.endGesture();
      QualityGoal goal = session_.goal();
      goal.aim = Aim::level;
      goal.level = level;
      session_.setGoal(tr("Quality level"), goal);
    });
}

void Accuracy::connectMeter() {
  connect(&meter_, &AccuracyMeter::changed, panel_, [this] {
    panel_->showMeasured(meter_.measured());
    applyLevel();
  });
  connect(&meter_, &AccuracyMeter::progressed, panel_, &AccuracyPanel::showProgress);
  connect(&session_, &Session::changed, panel_,
          [this](const SessionState& before, const SessionState& after) {
            if (before.goal != after.goal) applyLevel();
            if (before.series != after.series || before.scene != after.scene) meter_.forget();
          });
  connect(&bench_, &Workbench::drawnAtRest, &meter_,
          [this](const ScreenPicture& drawn, const Scene& complete) {
            meter_.show(drawn.volume, complete, drawn.image.size());
          });
}

void Accuracy::applyLevel() {
  meter_.setNeeded(session_.goal().aim != Aim::level);
  const auto level = levelFor(session_.goal(), meter_.measured().levels);
  if (!level || *level == drawService_.level(sceneViewId)) return;
  for (ViewId id = 0; id < viewCount; ++id) drawService_.setLevel(id, *level);
  panel_->showLevel(*level);
  grid_.requestPictures();
}

void Accuracy::setResampler(Resampler resampler) {
  // If Qt has no OpenGL without a window, EGL is tried when the picture is drawn.
  if (resampler == Resampler::gl) makeOffscreenGlSurface();
  drawService_.setResampler(resampler);
  meter_.forget();
  grid_.requestPictures();
}

}  // namespace

std::unique_ptr<Feature> makeAccuracy(Workbench& bench) { return std::make_unique<Accuracy>(bench); }

}  // namespace volumen
