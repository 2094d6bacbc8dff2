// Tasks of tasks.md: projection images and clips.
#include "tests/fixtures/fixtures.h"
#include "tests/ui/frames_window.h"
#include "tests/ui/hand.h"
#include "tests/ui/hung_studies.h"
#include "tests/ui/measure_window.h"
#include "ui/workspace/flat_plane.h"

namespace volumen::tests {

namespace {

// A radiograph that has the keyboard focus.
struct Radiograph {
  Frames w{{"cr-hip-mono2-jpeg12.dcm"}};
  Hand hand{w.window};

  bool isShown() {
    if (!w.shows()) return false;
    w.view()->setFocus();
    return true;
  }
};

int turned(Qt::Key key, PictureTurn turn) {
  Radiograph r;
  DONE(r.isShown());
  r.hand.key(key, Qt::ControlModifier);
  DONE(r.w.look().turn == turn);
  return r.hand.steps();
}

int flip() { return turned(Qt::Key_H, {0, true}); }
int rotate() { return turned(Qt::Key_R, {1, false}); }

int ownPixels() {
  Radiograph r;
  DONE(r.isShown());
  r.hand.key(Qt::Key_O);
  DONE(std::abs(r.w.view()->plane()->mmPerPixel / r.w.view()->ownPixelMm() - 1) < 1e-6);
  return r.hand.steps();
}

int trueSize() {
  MeasureWindow w;
  w.view()->setFocus();
  Hand hand(w.window);
  const double before = w.view()->plane()->mmPerPixel;
  hand.key(Qt::Key_O, Qt::ShiftModifier);
  DONE(w.view()->plane()->mmPerPixel != before);
  return hand.steps();
}

int playStack() {
  MeasureWindow w;
  w.view()->setFocus();
  Hand hand(w.window);
  const glm::dvec3 before = crosshairOf(w.session().workspace(), *w.session().series()).at;
  hand.key(Qt::Key_C);
  SOON(crosshairOf(w.session().workspace(), *w.session().series()).at != before);
  QTest::keyClick(w.view(), Qt::Key_C);
  return hand.steps();
}

int playClip() {
  Frames w({clipFile});
  DONE(w.shows());
  w.view()->setFocus();
  Hand hand(w.window);
  hand.key(Qt::Key_C);
  SOON(frameIn(w.view()) && frameIn(w.view())->key.index > 3);
  QTest::keyClick(w.view(), Qt::Key_C);
  return hand.steps();
}

int mammograms() {
  const Mammograms data;
  DONE(data.write());
  Journey w({data.folder.path()});
  Hand hand(w.window);
  const Workspace& workspace = w.window.session().workspace();
  SOON(workspace.layout == Layout::four);
  for (int n = 0; n < 4; ++n) DONE(seriesIn(workspace, firstComparedId + n));
  return hand.steps();
}

int magnify() {
  Radiograph r;
  DONE(r.isShown());
  r.hand.key(Qt::Key_V);
  const QPoint middle = r.w.view()->rect().center();
  const QImage before = r.w.view()->grab().toImage();
  QTest::mousePress(r.w.view(), Qt::LeftButton, {}, middle);
  SOON(r.w.view()->grab().toImage() != before);
  QTest::mouseRelease(r.w.view(), Qt::LeftButton, {}, middle);
  return r.hand.steps() + 1;  // plus the drag
}

}  // namespace

std::vector<Task> frameTasks() {
  return {{19, playStack}, {25, mammograms}, {26, magnify}, {31, playClip},
          {27, ownPixels}, {28, trueSize},   {29, flip},    {30, rotate}};
}

}  // namespace volumen::tests
