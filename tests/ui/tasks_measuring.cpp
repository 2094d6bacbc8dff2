// Tasks of tasks.md: measuring.
#include <QClipboard>
#include <QDockWidget>
#include <QToolButton>

#include "tests/ui/frames_window.h"
#include "tests/ui/hand.h"
#include "tests/ui/measure_window.h"

namespace volumen::tests {

namespace {

// A slice that has the keyboard focus.
struct Measuring {
  MeasureWindow w;
  Hand hand{w.window};

  Measuring() { w.view()->setFocus(); }
  bool drew(ShapeKind kind) { return w.all().size() == 1 && w.last().shape.kind == kind; }
};

int length() {
  Measuring m;
  m.hand.key(Qt::Key_D);
  m.hand.drag(m.w.view(), {60, 60}, {120, 90});
  DONE(m.drew(ShapeKind::length));
  return m.hand.steps();
}

int angle() {
  Measuring m;
  m.hand.key(Qt::Key_A);
  m.hand.drag(m.w.view(), {60, 60}, {120, 90});
  m.hand.click(m.w.view(), {100, 150});
  DONE(m.drew(ShapeKind::angle));
  return m.hand.steps();
}

int ellipse() {
  Measuring m;
  m.hand.key(Qt::Key_E);
  m.hand.drag(m.w.view(), {60, 60}, {120, 110});
  DONE(m.drew(ShapeKind::ellipse) && m.w.measured(m.w.last())->values);
  return m.hand.steps();
}

int exportNumbers() {
  Measuring m;
  m.w.draw(ShapeKind::length, {{60, 60}, {120, 90}});
  m.w.child<QDockWidget>("measurementsDock")->raise();
  QCoreApplication::processEvents();
  auto* copy = m.w.child<QToolButton>("measurementCopy");
  m.hand.menuOf(copy, "copyMeasurementsCsv");
  DONE(QGuiApplication::clipboard()->text().contains(QStringLiteral("length")));
  return m.hand.steps();
}

int lengthOnUltrasound() {
  Frames w({clipFile});
  DONE(w.shows());
  w.view()->setFocus();
  Hand hand(w.window);
  hand.key(Qt::Key_D);
  hand.drag(w.view(), {300, 300}, {360, 340});
  DONE(w.workspace().measurements.size() == 1);
  return hand.steps();
}

}  // namespace

std::vector<Task> measuringTasks() {
  return {{32, lengthOnUltrasound}, {34, length}, {35, angle}, {36, ellipse}, {37, exportNumbers}};
}

}  // namespace volumen::tests
