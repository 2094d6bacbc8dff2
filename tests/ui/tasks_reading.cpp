// Tasks of tasks.md: reading a CT.
#include <QTemporaryDir>
#include <QUrl>

#include "io/export/dicom_series.h"
#include "tests/fixtures/ct_with_table.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/ui/hand.h"
#include "tests/ui/measure_window.h"
#include "ui/workspace/flat_plane.h"

namespace volumen::tests {

namespace {

// A CT in planes whose axial view has the keyboard focus.
struct Reading {
  MeasureWindow w;
  Hand hand{w.window};

  explicit Reading(const LoadedSeriesPtr& series = ballSeries(32, 10, {3, -2, 4})) : w(series) {
    w.view()->setFocus();
  }
  Session& session() { return w.session(); }
  FlatLook look() { return flatLookOf(session().workspace().view(axialViewId)); }
  std::optional<Window> window() {
    return session().workspace().series.at(session().workspace().view(axialViewId).series).window;
  }
  Crosshair crosshair() { return crosshairOf(session().workspace(), *session().series()); }
  StackPlace place() {
    return stackPlace(session().series()->volume->geometry(), ViewKind::axial, crosshair());
  }
};

int openFolder() {
  Journey w;
  Hand hand(w.window);
  QMimeData files;
  files.setUrls(
      {QUrl::fromLocalFile(QString::fromStdString(dataPath("dicom-geometry/ct-tiny-23x38x3/image")))});
  hand.drop(files, &w.window);
  SOON(!w.window.session().workspace().series.empty());
  return hand.steps();
}

int goToSlice() {
  Reading r;
  r.hand.key(Qt::Key_G);
  r.hand.type(QStringLiteral("7"));
  DONE(std::abs(r.session().series()->volume->geometry().voxelFromPatient(r.crosshair().at).z - 6) < 1e-6);
  return r.hand.steps();
}

int scrollFast() {
  Reading r;
  const int before = r.place().index;
  r.hand.wheel(r.w.view(), -1, Qt::ShiftModifier);
  DONE(r.place().index == before + 10);
  return r.hand.steps();
}

// Works with and without windows in the file.
int windowOfKey(Qt::Key key, Window window) {
  const LoadedSeriesPtr ball = ballSeries(32, 10, {3, -2, 4});
  auto withWindows = std::make_shared<LoadedSeries>(*ball);
  VolumeParts parts{ball->volume->geometry(), ball->volume->stored(), 1, 0, {}};
  parts.attributes.windows = {{35, 350}, {-450, 2000}};
  withWindows->volume = volumeFrom(std::move(parts));
  int steps = 0;
  for (const LoadedSeriesPtr& series : {ball, LoadedSeriesPtr(withWindows)}) {
    Reading r(series);
    r.hand.key(key);
    DONE(r.window() == window);
    steps = r.hand.steps();
  }
  return steps;
}

int lungWindow() { return windowOfKey(Qt::Key_6, {-600, 1500}); }
int boneWindow() { return windowOfKey(Qt::Key_5, {400, 2000}); }

int windowByDrag() {
  Reading r;
  r.hand.drag(r.w.view(), {50, 50}, {90, 50});
  DONE(r.window().has_value());
  return r.hand.steps();
}

int windowOfRegion() {
  Reading r;
  r.hand.menu({"toolsMenu"}, "regionWindowTool");
  const QPointF middle(r.w.view()->rect().center());
  r.hand.drag(r.w.view(), middle - QPointF(50, 50), middle + QPointF(50, 50));  // from the ball to air
  DONE(r.window().has_value());
  return r.hand.steps();
}

int invert() {
  Reading r;
  r.hand.key(Qt::Key_I);
  DONE(r.look().inverted);
  return r.hand.steps();
}

int threePlanes() {
  Reading r;
  for (const ViewId id : {axialViewId, coronalViewId, sagittalViewId}) DONE(r.w.view(id)->isVisible());
  return r.hand.steps();
}

int obliquePlane() {
  Reading r;
  // Drags a handle of the coronal plane's line in the axial view.
  const FlatView* view = r.w.view();
  const QPointF middle(view->rect().center());
  const double reach = 0.32 * std::min(view->width(), view->height());
  r.hand.drag(r.w.view(), middle + QPointF(reach, 0), middle + QPointF(reach * 0.9, reach * 0.43));
  DONE(r.crosshair().turned());
  return r.hand.steps();
}

int slab() {
  Reading r;
  r.hand.wheel(r.w.view(), 10, Qt::AltModifier);  // 1 mm a notch
  DONE(r.look().slabMm == 10 && r.look().slabMode == SlabMode::max);
  return r.hand.steps();
}

int volumeRendering() {
  Reading r;
  DONE(r.w.window.view()->isVisible());
  return r.hand.steps();
}

int removeTable() {
  QTemporaryDir dir;
  DONE(writeDicomSeries(*CtWithTable::ofCt(true), {}, dir.path().toStdString()));
  Journey w({dir.path()});
  Hand hand(w.window);
  const DrawnScenes& drawn = w.window.document().drawn;
  SOON(w.window.session().series() && drawn.tissue(sceneViewId));
  DONE(drawn.tissue(sceneViewId)->value->patient);
  return hand.steps();
}

int pointEverywhere() {
  Reading r;
  const glm::dvec3 there = r.w.patient({100, 80});
  r.hand.moveHolding(Qt::ShiftModifier, r.w.view(), {100, 80});
  DONE(glm::length(r.crosshair().at - there) < 1e-6);
  return r.hand.steps();
}

}  // namespace

std::vector<Task> readingTasks() {
  return {{1, openFolder},   {2, goToSlice},       {3, scrollFast},     {4, lungWindow},
          {5, boneWindow},   {6, windowByDrag},    {7, windowOfRegion}, {8, invert},
          {9, threePlanes},  {10, obliquePlane},   {11, slab},          {12, volumeRendering},
          {13, removeTable}, {14, pointEverywhere}};
}

}  // namespace volumen::tests
