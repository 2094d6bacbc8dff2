// Tasks of tasks.md: pictures as acquired, clips.
#include "tests/fixtures/fixtures.h"
#include "tests/ui/frames_window.h"
#include "tests/ui/hand.h"
#include "tests/ui/hung_studies.h"
#include "tests/ui/measure_window.h"
#include "ui/workspace/flat_plane.h"

namespace volumen::tests {

namespace {

// A radiograph that has the keys.
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

}  // namespace

std::vector<Task> frameTasks() { return {{27, ownPixels}, {28, trueSize}, {29, flip}, {30, rotate}}; }

}  // namespace volumen::tests
