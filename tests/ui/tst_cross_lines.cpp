// Guards where the lines of planes can be grabbed, so that a drag meant for the picture moves no plane. The
// lines can be hidden.
#include "tests/ui/clean_settings.h"
#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"
#include "ui/workspace/flat_plane.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

struct Lines : MeasureWindow {
  glm::dvec3 cursor() { return crosshairOf(session().workspace(), axialViewId, *view()->shown()).at; }
  std::optional<Window> windowSet() { return session().workspace().series.at(view()->state().series).window; }
  QPointF crossing() {
    const glm::dvec2 at = view()->plane()->pixelFromPatient(cursor()) / view()->devicePixelRatioF();
    return {at.x, at.y};
  }
  // Returns a pixel on the upright line, `share` of the view's height below the crossing.
  QPoint below(double share) { return (crossing() + QPointF(0, share * view()->height())).toPoint(); }
};

}  // namespace

class TestCrossLines : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void onlyOuterPartsAreTakenHoldOf_data();
  void onlyOuterPartsAreTakenHoldOf();
  void theCrossingIsFreeWhereverItIs();
  void thePointerSaysWhere();
  void theCrosshairToolTakesAllOfThem();
  void hiddenTheyAreNotTakenHoldOf();
  void hidingIsKept();
  void theKeyMeansNothingElse();
};

void TestCrossLines::onlyOuterPartsAreTakenHoldOf_data() {
  QTest::addColumn<double>("share");
  QTest::addColumn<bool>("isMoved");
  QTest::newRow("near the crossing") << 0.08 << false;
  QTest::newRow("in the middle third") << 0.13 << false;
  QTest::newRow("outside it") << 0.24 << true;
  QTest::newRow("near the edge") << 0.45 << true;
}

// The crosshair is in the middle of the view. Drags that miss its lines adjust the window.
void TestCrossLines::onlyOuterPartsAreTakenHoldOf() {
  QFETCH(double, share);
  QFETCH(bool, isMoved);
  Lines w;
  const glm::dvec3 before = w.cursor();
  const QPoint on = w.below(share);
  drag(w.view(), on, on + QPoint(30, 0));
  QCOMPARE(w.cursor() != before, isMoved);
  QCOMPARE(w.windowSet().has_value(), !isMoved);
}

void TestCrossLines::theCrossingIsFreeWhereverItIs() {
  Lines w;
  QTest::mouseClick(w.view(), Qt::LeftButton, Qt::ShiftModifier, {50, 50});
  const glm::dvec3 before = w.cursor();
  const QPoint on = (w.crossing() + QPointF(0, 22)).toPoint();
  drag(w.view(), on, on + QPoint(30, 0));
  QCOMPARE(w.cursor(), before);
  QVERIFY(w.windowSet());
}

void TestCrossLines::thePointerSaysWhere() {
  Lines w;
  hover(w.view(), w.below(0.24));
  QCOMPARE(w.view()->cursor().shape(), Qt::PointingHandCursor);
  hover(w.view(), w.below(0.12));
  QCOMPARE(w.view()->cursor().shape(), Qt::ArrowCursor);
}

void TestCrossLines::theCrosshairToolTakesAllOfThem() {
  Lines w;
  w.child<QAction>("crosshairTool")->trigger();
  const glm::dvec3 before = w.cursor();
  const QPoint on = (w.crossing() + QPointF(0, 23)).toPoint();  // where other tools grab no line
  drag(w.view(), on, on + QPoint(30, 12));
  const glm::dvec3 moved = w.cursor() - before;
  QVERIFY(moved.x != 0);
  QVERIFY2(std::abs(moved.y) < 1e-9, "by its line: across it alone");
}

void TestCrossLines::hiddenTheyAreNotTakenHoldOf() {
  Lines w;
  const QImage shown = w.view()->capture();
  QTest::keyClick(w.view(), Qt::Key_H);
  QVERIFY(!w.child<QAction>("crosshairLines")->isChecked());
  QVERIFY(w.view()->capture() != shown);
  const glm::dvec3 before = w.cursor();
  drag(w.view(), w.below(0.24), w.below(0.24) + QPoint(30, 0));
  QCOMPARE(w.cursor(), before);
  QVERIFY(w.windowSet());
  w.undo();
  QTest::keyClick(w.view(), Qt::Key_H);
  QCOMPARE(w.view()->capture(), shown);
}

void TestCrossLines::hidingIsKept() {
  {
    Lines w;
    QTest::keyClick(w.view(), Qt::Key_H);
  }
  Lines w;
  QVERIFY(!w.session().preferences().crosshairLines);
  QVERIFY(!w.child<QAction>("crosshairLines")->isChecked());
}

// In 3D the key does the same and leaves the workspace unchanged.
void TestCrossLines::theKeyMeansNothingElse() {
  Lines w;
  w.session().setFocus(sceneViewId);
  const Workspace before = w.session().workspace();
  QTest::keyClick(w.window.view(), Qt::Key_H);
  QVERIFY(!w.session().preferences().crosshairLines);
  QVERIFY(w.session().workspace() == before);
}

VOLUMEN_TEST(TestCrossLines);
#include "tst_cross_lines.moc"
