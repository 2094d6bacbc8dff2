// Guards the segment scissors, by real events. What is outlined in 3D or in a slice is removed from the
// current segment only. It is one undo step and a repeatable recipe step.
#include <cmath>

#include "tests/ui/cut_window.h"
#include "tests/ui/frames_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

using CutAct = void (*)(CutWindow& w);

}  // namespace

Q_DECLARE_METATYPE(CutAct)

class TestSegmentScissors : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsDrawnAroundInThreeDGoes_data();
  void whatIsDrawnAroundInThreeDGoes();
  void whatIsDrawnAroundInSlicesGoes_data();
  void whatIsDrawnAroundInSlicesGoes();
  void theDepthIsThatOfThePage();
  void twoInARowAreTwoSteps();
  void framesAreNotCut();
  void whatIsGivenUpCutsNothing_data();
  void whatIsGivenUpCutsNothing();
  void theOutlineIsSeenInThreeD();
  void escPutsTheToolAway_data();
  void escPutsTheToolAway();
};

void TestSegmentScissors::whatIsDrawnAroundInThreeDGoes_data() {
  QTest::addColumn<bool>("perspective");
  QTest::addColumn<bool>("keeps");
  QTest::newRow("parallel, inside") << false << false;
  QTest::newRow("parallel, outside by Ctrl") << false << true;
  QTest::newRow("perspective, inside") << true << false;
  QTest::newRow("perspective, outside by Ctrl") << true << true;
}

void TestSegmentScissors::whatIsDrawnAroundInThreeDGoes() {
  QFETCH(bool, perspective);
  QFETCH(bool, keeps);
  CutWindow w;
  QVERIFY(w.begin());
  w.session().setFocus(sceneViewId);
  if (perspective)
    w.session().edit(QStringLiteral("Perspective"), [&](Scene& s) {
      s.camera = withProjection(w.scene()->camera(), Projection::perspective);
      s.camera->direction = {0.3, 0.9, 0.2};
    });
  w.session().endGesture();
  const BitMask own = w.mask(1), core = w.mask(2);
  const Workspace before = w.workspace();
  const int steps = w.steps();
  const std::vector<QPoint> corners = outlineAt(w.scenePixel({-9, -5, -5}), 40);
  const SeenPart seen = w.seenInScene(corners);
  w.drawIn(w.scene(), corners, keeps ? Qt::ControlModifier : Qt::NoModifier);
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + 1);
  QVERIFY(seen.inside.count() > 50 && seen.inside != own);
  QVERIFY(seen.leaves(w.mask(1), keeps ? seen.inside : subtracted(own, seen.inside)));
  QVERIFY2(w.mask(2) == core, "others stay");
  QVERIFY(w.session().maskOf(w.series()).lassos.empty());
  QCOMPARE(&w.inHand(), &toolNamed("segmentScissors"));
  QVERIFY(w.isRecorded());
  const Workspace after = w.workspace();
  w.undo();
  QVERIFY(w.workspace() == before);
  w.redo();
  QVERIFY(w.workspace() == after);
}

void TestSegmentScissors::whatIsDrawnAroundInSlicesGoes_data() {
  QTest::addColumn<bool>("clicks");
  QTest::addColumn<bool>("keeps");
  QTest::addColumn<bool>("oblique");
  QTest::newRow("drag") << false << false << false;
  QTest::newRow("clicks") << true << false << false;
  QTest::newRow("drag, outside by Ctrl") << false << true << false;
  QTest::newRow("clicks, outside by Ctrl") << true << true << false;
  QTest::newRow("drag, oblique") << false << false << true;
  QTest::newRow("clicks, oblique, outside by Ctrl") << true << true << true;
}

void TestSegmentScissors::whatIsDrawnAroundInSlicesGoes() {
  QFETCH(bool, clicks);
  QFETCH(bool, keeps);
  QFETCH(bool, oblique);
  CutWindow w;
  QVERIFY(w.begin());
  w.show(oblique ? obliquely() : throughMiddle());
  const BitMask own = w.mask(1), core = w.mask(2);
  const Workspace before = w.workspace();
  const int steps = w.steps();
  const std::vector<QPoint> corners = outlineAt(w.pixelOf({-8, -5, -5}, axialViewId), 50);
  const SeenPart seen = w.seenInSlice(corners);
  const Qt::KeyboardModifiers keys = keeps ? Qt::ControlModifier : Qt::NoModifier;
  if (clicks) {
    for (const QPoint p : corners) QTest::mouseClick(w.view(), Qt::LeftButton, keys, p);
    QVERIFY2(w.workspace() == before, "not closed yet");
    QTest::keyClick(w.view(), Qt::Key_Return);
  } else {
    w.stroke(corners, axialViewId, keys);
  }
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + 1);
  QVERIFY(seen.inside.count() > 50 && seen.inside != own);
  QVERIFY(seen.leaves(w.mask(1), keeps ? seen.inside : subtracted(own, seen.inside)));
  QVERIFY2(w.mask(2) == core, "others stay");
  QVERIFY(w.view()->drawnMeasurements().empty() && w.all().empty());
  QVERIFY(w.isRecorded());
  const Workspace after = w.workspace();
  w.undo();
  QVERIFY(w.workspace() == before);
  w.redo();
  QVERIFY(w.workspace() == after);
}

void TestSegmentScissors::theDepthIsThatOfThePage() {
  CutWindow w;
  QVERIFY(w.makeBoth());
  w.click("segmentPaint");
  w.click("segmentCut");
  QCOMPARE(&w.inHand(), &toolNamed("segmentScissors"));
  auto* mm = w.child<QDoubleSpinBox>("cutMm");
  QCOMPARE(mm->text(), QStringLiteral("All slices"));
  mm->setValue(3);
  w.show(throughMiddle());
  const BitMask own = w.mask(1);
  const std::vector<QPoint> corners = outlineAt(w.pixelOf({-8, -5, -5}, axialViewId), 50);
  const SeenPart seen = w.seenInSlice(corners);
  const BitMask within = w.partOf(1, [](glm::dvec3 p) { return std::abs(p.z + 4.5) < 3.5; });
  const BitMask both = intersected(seen.inside, within);
  QVERIFY(!both.empty() && both != seen.inside && both != within);
  w.stroke(corners);
  QVERIFY(w.idle());
  QVERIFY(seen.leaves(w.mask(1), subtracted(own, both)));
  w.undo();
  w.stroke(corners, axialViewId, Qt::ControlModifier);
  QVERIFY(w.idle());
  QVERIFY2(seen.leaves(w.mask(1), subtracted(own, subtracted(within, seen.inside))), "slices beyond it stay");
  w.undo();
  const QRect all = w.scene()->rect().adjusted(2, 2, -2, -2);
  w.drawIn(w.scene(), {all.topLeft(), all.topRight(), all.bottomRight(), all.bottomLeft()});
  QVERIFY(w.idle());
  QVERIFY2(w.mask(1).empty(), "in 3D through all of it");
}

// The second cut is drawn while the first is being computed.
void TestSegmentScissors::twoInARowAreTwoSteps() {
  CutWindow w;
  QVERIFY(w.begin());
  const BitMask own = w.mask(1);
  const int steps = w.steps();
  const std::vector<QPoint> one = outlineAt(w.scenePixel({-9, -5, -5}), 30),
                            other = outlineAt(w.scenePixel({2, -5, -2}), 30);
  const SeenPart first = w.seenInScene(one), second = w.seenInScene(other);
  w.drawIn(w.scene(), one);
  w.drawIn(w.scene(), other);
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + 2);
  const BitMask onLine = united(first.onLine, second.onLine), uncut = subtracted(own, first.inside);
  QVERIFY(uncut != own && subtracted(uncut, second.inside) != uncut);
  QVERIFY(subtracted(w.mask(1), onLine) == subtracted(subtracted(uncut, second.inside), onLine));
  w.undo();
  QVERIFY(first.leaves(w.mask(1), uncut));
}

void TestSegmentScissors::framesAreNotCut() {
  NEED_FILES();
  Frames w({"cr-hip-mono2-jpeg12.dcm"});
  QVERIFY(w.shows());
  const Workspace before = w.workspace();
  w.child<QAction>("segmentScissorsTool")->trigger();
  const QPoint at = w.view()->rect().center();
  for (const QPoint p : outlineAt(at, 40)) QTest::mouseClick(w.view(), Qt::LeftButton, {}, p);
  QTest::keyClick(w.view(), Qt::Key_Return);
  QVERIFY(w.workspace() == before);
  QVERIFY(w.child<Banner>("banner")->sentence().contains(QStringLiteral("cannot be cut on frames")));
}

void TestSegmentScissors::whatIsGivenUpCutsNothing_data() {
  QTest::addColumn<CutAct>("act");
  QTest::newRow("a click in 3D") << CutAct(
      [](CutWindow& w) { QTest::mouseClick(w.scene(), Qt::LeftButton, {}, w.scenePixel(glm::dvec3(-5))); });
  QTest::newRow("two points in a slice") << CutAct([](CutWindow& w) {
    const QPoint at = w.view()->rect().center();
    QTest::mouseClick(w.view(), Qt::LeftButton, {}, at);
    QTest::mouseClick(w.view(), Qt::LeftButton, {}, at + QPoint(30, 0));
    QTest::keyClick(w.view(), Qt::Key_Return);
  });
  QTest::newRow("Esc in 3D") << CutAct([](CutWindow& w) {
    const auto corners = outlineAt(w.scenePixel(glm::dvec3(-5)), 40);
    w.drawIn(w.scene(), corners, {}, false);
    QTest::keyClick(w.scene(), Qt::Key_Escape);
    QTest::mouseRelease(w.scene(), Qt::LeftButton, {}, corners.back());
  });
  QTest::newRow("Esc in a slice") << CutAct([](CutWindow& w) {
    const auto corners = outlineAt(w.view()->rect().center(), 50);
    w.drawIn(w.view(), corners, {}, false);
    QTest::keyClick(w.view(), Qt::Key_Escape);
    QTest::mouseRelease(w.view(), Qt::LeftButton, {}, corners.back());
  });
  QTest::newRow("another tool in 3D") << CutAct([](CutWindow& w) {
    const auto corners = outlineAt(w.scenePixel(glm::dvec3(-5)), 40);
    w.drawIn(w.scene(), corners, {}, false);
    w.take("partTool");
    QTest::mouseRelease(w.scene(), Qt::LeftButton, {}, corners.back());
    w.take("segmentScissorsTool");
  });
}

void TestSegmentScissors::whatIsGivenUpCutsNothing() {
  QFETCH(CutAct, act);
  CutWindow w;
  QVERIFY(w.begin());
  w.show(throughMiddle());
  const Workspace before = w.workspace();
  act(w);
  QVERIFY(w.idle());
  QVERIFY(w.isAs(before));
  QCOMPARE(&w.inHand(), &toolNamed("segmentScissors"));
  // The tool is ready again.
  w.drawIn(w.scene(), outlineAt(w.scenePixel(glm::dvec3(-5)), 40));
  QVERIFY(w.idle());
  QVERIFY(!w.isAs(before));
}

void TestSegmentScissors::theOutlineIsSeenInThreeD() {
  CutWindow w;
  QVERIFY(w.begin());
  QVERIFY(w.settle());
  const auto corners = outlineAt(w.scenePixel(glm::dvec3(-5)), 40);
  // First brings the view into focus.
  w.drawIn(w.scene(), corners, {}, false);
  QTest::keyClick(w.scene(), Qt::Key_Escape);
  QTest::mouseRelease(w.scene(), Qt::LeftButton, {}, corners.back());
  const QImage before = w.scene()->grab().toImage();
  w.drawIn(w.scene(), corners, {}, false);
  QVERIFY(w.scene()->grab().toImage() != before);
  w.shot("segment-scissors-outline");
  QTest::keyClick(w.scene(), Qt::Key_Escape);
  QVERIFY(w.scene()->grab().toImage() == before);
}

void TestSegmentScissors::escPutsTheToolAway_data() {
  QTest::addColumn<bool>("inScene");
  QTest::newRow("slice") << false;
  QTest::newRow("3D") << true;
}

void TestSegmentScissors::escPutsTheToolAway() {
  QFETCH(bool, inScene);
  CutWindow w;
  const Tool& before = w.inHand();
  w.take("segmentScissorsTool");
  QCOMPARE(&w.inHand(), &toolNamed("segmentScissors"));
  QTest::keyClick(inScene ? static_cast<QWidget*>(w.scene()) : w.view(), Qt::Key_Escape);
  QCOMPARE(&w.inHand(), &before);
}

VOLUMEN_TEST(TestSegmentScissors);
#include "tst_segment_scissors.moc"
