// Guards the brush in slices. Strokes by real events are compared with reference models of the covered
// voxels. Each is one undo step. Covers erasing, locked segments, limits and the brush settings.
#include <QCheckBox>
#include <QComboBox>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/ui/frames_window.h"
#include "tests/ui/paint_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentPaint : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aStrokeIsAStep_data();
  void aStrokeIsAStep();
  void theSliceShowsTheStrokeWhileItIsDrawn();
  void ctrlAndThePageErase_data();
  void ctrlAndThePageErase();
  void lockedSegmentsStayAsTheyAre();
  void limitsSayWhereIsPainted();
  void framesHaveNoSegments_data();
  void framesHaveNoSegments();
  void keysAndThePageSetTheBrush();
  void theBrushIsDrawnAtThePointer();
  void randomStrokesAreThoseOfATwin_data();
  void randomStrokesAreThoseOfATwin();
};

void TestSegmentPaint::aStrokeIsAStep_data() {
  QTest::addColumn<bool>("ball");
  QTest::addColumn<ViewId>("id");
  QTest::addColumn<bool>("oblique");
  QTest::newRow("disc, axial") << false << axialViewId << false;
  QTest::newRow("ball, axial") << true << axialViewId << false;
  QTest::newRow("disc, coronal") << false << coronalViewId << false;
  QTest::newRow("ball, sagittal") << true << sagittalViewId << false;
  QTest::newRow("disc, oblique") << false << axialViewId << true;
  QTest::newRow("ball, oblique") << true << axialViewId << true;
}

void TestSegmentPaint::aStrokeIsAStep() {
  QFETCH(bool, ball);
  QFETCH(ViewId, id);
  QFETCH(bool, oblique);
  PaintWindow w;
  w.setBrush(ball, 7);
  w.show(oblique ? obliquely() : throughMiddle());
  w.take("paintTool");
  w.session().setFocus(id);  // as the press does
  const Workspace before = w.workspace();
  const int steps = w.steps();
  const QPoint middle = w.pixelOf(glm::dvec3(-5), id);
  const std::vector<QPoint> way{middle - QPoint(60, 10), middle - QPoint(20, -5), middle + QPoint(45, 30)};
  w.stroke(way, id);
  QCOMPARE(w.steps(), steps + 1);
  QCOMPARE(w.count(), std::size_t(1));
  const BitMask expected = w.covered(way, id);
  QVERIFY(expected.count() > 40);
  QVERIFY(w.mask(1) == expected);
  QCOMPARE(w.session().undoStack().undoText(), QStringLiteral("Paint"));
  // A second stroke is added, as a separate undo step.
  const std::vector<QPoint> other{middle + QPoint(0, 50)};
  const Workspace one = w.workspace();
  w.stroke(other, id);
  QCOMPARE(w.steps(), steps + 2);
  QVERIFY(w.mask(1) == united(expected, w.covered(other, id)));
  QVERIFY(w.idle());
  const Workspace after = w.workspace();
  w.undo();
  QVERIFY(w.workspace() == one);
  w.undo();
  QVERIFY(w.workspace() == before);
  w.redo(), w.redo();
  QVERIFY(w.workspace() == after);
  QCOMPARE(&w.inHand(), &toolNamed("paint"));
  QTest::keyClick(w.view(id), Qt::Key_Escape);
  QVERIFY(&w.inHand() != &toolNamed("paint"));
}

void TestSegmentPaint::theSliceShowsTheStrokeWhileItIsDrawn() {
  PaintWindow w;
  w.show(throughMiddle());
  w.take("paintTool");
  const std::vector<QPoint> way = w.pixelsOf({{0, 5, -5}, {6, 5, -5}}, axialViewId);
  const auto colour = [&](QPoint at) { return w.view()->picture().pixelColor(at); };
  const auto isGrey = [](QColor c) { return c.red() == c.green() && c.green() == c.blue(); };
  QTRY_VERIFY(!w.view()->picture().isNull() && isGrey(colour(way[0])) && isGrey(colour(way[1])));
  w.press(way[0]);
  QTRY_VERIFY(!isGrey(colour(way[0])));
  QVERIFY(isGrey(colour(way[1])));
  w.move(way[1]);
  QTRY_VERIFY(!isGrey(colour(way[1])));
  w.release(way[1]);
}

void TestSegmentPaint::ctrlAndThePageErase_data() {
  QTest::addColumn<bool>("byPage");
  QTest::newRow("Ctrl") << false;
  QTest::newRow("the page") << true;
}

void TestSegmentPaint::ctrlAndThePageErase() {
  QFETCH(bool, byPage);
  PaintWindow w;
  QVERIFY(w.makeBoth());
  w.show(throughMiddle());
  if (byPage) {
    w.click("segmentPaint");
    w.child<QCheckBox>("paintErases")->click();
  }
  w.take("paintTool");
  const BitMask own = w.mask(1), core = w.mask(2);
  const std::vector<QPoint> way = w.pixelsOf(throughBall, axialViewId);
  w.stroke(way, axialViewId, byPage ? Qt::NoModifier : Qt::ControlModifier);
  QCOMPARE(w.session().undoStack().undoText(), QStringLiteral("Erase"));
  QVERIFY(w.mask(1) == subtracted(own, w.covered(way)));
  QVERIFY(w.mask(1) != own && w.mask(2) == core);
}

void TestSegmentPaint::lockedSegmentsStayAsTheyAre() {
  PaintWindow w;
  QVERIFY(w.makeBoth());
  w.show(throughMiddle());
  w.tick(1, 1);
  QVERIFY(w.segment(1).locked && w.choose(0));
  const BitMask own = w.mask(1), core = w.mask(2);
  const std::vector<QPoint> way = w.pixelsOf(throughBall, axialViewId);
  w.take("paintTool");
  w.stroke(way);
  QVERIFY(!intersected(w.covered(way), core).empty());
  QVERIFY(w.mask(2) == core);
  QVERIFY(w.mask(1) == united(own, subtracted(w.covered(way), core)));
  // A locked segment itself does not change either.
  QVERIFY(w.choose(1));
  const Workspace before = w.workspace();
  w.stroke(way);
  w.stroke(way, axialViewId, Qt::ControlModifier);
  QVERIFY(w.workspace() == before);
  QVERIFY(w.said().contains(QStringLiteral("is locked")));
}

void TestSegmentPaint::limitsSayWhereIsPainted() {
  PaintWindow w;
  QVERIFY(w.makeBoth());
  w.show(throughMiddle());
  w.child<QDoubleSpinBox>("segmentLow")->setValue(-10);
  w.child<QDoubleSpinBox>("segmentHigh")->setValue(600);
  w.click("segmentPaint");
  w.child<QCheckBox>("paintInRange")->click();
  QVERIFY(!w.child<QComboBox>("paintOther")->isEnabled());
  w.child<QComboBox>("paintBeside")->setCurrentIndex(2);
  QVERIFY(w.child<QComboBox>("paintOther")->isEnabled());
  w.take("paintTool");
  const BitMask own = w.mask(1), core = w.mask(2);
  const std::vector<QPoint> way = w.pixelsOf(throughBall, axialViewId);
  w.stroke(way);
  const BitMask expected = subtracted(intersected(w.covered(way), w.valuesFrom(-10, 600)), core);
  QVERIFY(!expected.empty() && expected != w.covered(way));
  QVERIFY(w.mask(1) == united(own, expected));
  QVERIFY(w.mask(2) == subtracted(core, expected));
}

void TestSegmentPaint::framesHaveNoSegments_data() {
  QTest::addColumn<QByteArray>("file");
  for (const char* file : {"cr-hip-mono2-jpeg12.dcm", clipFile, "xa-96frames.dcm"})
    QTest::newRow(file) << QByteArray(file);
}

void TestSegmentPaint::framesHaveNoSegments() {
  QFETCH(QByteArray, file);
  NEED_FILES();
  Frames w({file.constData()});
  QVERIFY(w.shows());
  const Workspace before = w.workspace();
  constexpr const char* unpainted = "Frames cannot be painted on";
  for (const auto& [tool, says] : {std::pair("paintTool", unpainted),
                                   {"outlineTool", unpainted},
                                   {"levelTraceTool", unpainted},
                                   {"smartBrushTool", unpainted},
                                   {"lesionTool", "A lesion cannot be found on frames"},
                                   {"partTool", "Frames have no connected parts"}}) {
    w.child<QAction>(tool)->trigger();
    auto* banner = w.child<Banner>("banner");
    banner->hide();
    const QPoint at = w.view()->rect().center();
    drag(w.view(), at, at + QPoint(40, 40));
    QVERIFY2(w.workspace() == before, tool);
    QVERIFY2(banner->isVisible() && banner->sentence().contains(QLatin1String(says)), tool);
  }
}

void TestSegmentPaint::keysAndThePageSetTheBrush() {
  PaintWindow w;
  const auto mm = [&] { return w.session().preferences().brush.diameterMm; };
  auto* field = w.child<QDoubleSpinBox>("brushMm");
  w.click("segmentPaint");
  w.click("segmentBrush");
  QCOMPARE(&w.inHand(), &toolNamed("paint"));
  QTest::keyClick(w.view(), Qt::Key_Plus);
  QCOMPARE(mm(), 12.0);
  QCOMPARE(field->value(), 12.0);
  QTest::keyClick(w.view(), Qt::Key_Minus);
  QCOMPARE(mm(), 10.0);
  for (int n = 0; n < 40; ++n) QTest::keyClick(w.view(), Qt::Key_Minus);
  QCOMPARE(mm(), Brush::leastMm);
  field->setValue(25);
  QCOMPARE(mm(), 25.0);
  QTest::keyClick(w.child<QComboBox>("brushShape"), Qt::Key_Down);
  QVERIFY(w.session().preferences().brush.ball);
  QVERIFY(storedPreferences().brush == w.session().preferences().brush);
  // With another tool the keys do not change the brush.
  w.click("segmentOutline");
  QTest::keyClick(w.view(), Qt::Key_Plus);
  QCOMPARE(mm(), 25.0);
}

void TestSegmentPaint::theBrushIsDrawnAtThePointer() {
  PaintWindow w;
  w.show(throughMiddle());
  QTRY_VERIFY(!w.view()->picture().isNull());
  const QPoint at = w.view()->rect().center() + QPoint(37, 21);
  const double radius = 5 / w.view()->plane()->mmPerPixel;
  const auto ring = [&](double r) {
    return w.view()->grab().toImage().pixelColor(at + QPoint(int(std::lround(r)), 0));
  };
  const auto edge = [&](double r) {
    int brightest = 0;
    for (const int off : {-1, 0, 1}) brightest = std::max(brightest, ring(r + off).green());
    return brightest;
  };
  hover(w.view(), at);
  const int before = edge(radius);
  w.take("paintTool");
  hover(w.view(), at);
  QVERIFY(before < 200);
  QVERIFY(edge(radius) > before + 50);
  QTest::keyClick(w.view(), Qt::Key_Plus);
  QVERIFY(edge(1.2 * radius) > before + 50);
}

void TestSegmentPaint::randomStrokesAreThoseOfATwin_data() {
  QTest::addColumn<int>("seed");
  const Seeds seeds = seedsOf(1, 5);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) QTest::addRow("seed %d", seed) << seed;
}

// Strokes in any plane, by any brush, painted and erased, then undone and redone.
void TestSegmentPaint::randomStrokesAreThoseOfATwin() {
  QFETCH(int, seed);
  Chance chance{std::uint64_t(seed)};
  PaintWindow w;
  QVERIFY(w.make(800, 1200));
  w.take("paintTool");
  BitMask twin = w.mask(1);
  const int first = w.steps();
  std::vector<Workspace> states{w.workspace()};
  for (int n = 0; n < 60; ++n) {
    Crosshair crosshair = chance.oneIn(2) ? throughMiddle() : obliquely();
    crosshair.at = 15.0 * chance.vector();
    if (chance.oneIn(4)) w.show(crosshair);
    if (w.steps() - first == int(states.size())) states.push_back(w.workspace());
    w.setBrush(chance.oneIn(2), chance.between(1, 15));
    const ViewId id = axialViewId + chance.below(3);
    const bool erases = chance.oneIn(3);
    std::vector<QPoint> way;
    for (int points = 1 + chance.below(4); points > 0; --points)
      way.push_back(w.view(id)->rect().center() + QPoint(chance.below(200) - 100, chance.below(200) - 100));
    const BitMask covered = w.covered(way, id);
    w.stroke(way, id, erases ? Qt::ControlModifier : Qt::NoModifier);
    twin = erases ? subtracted(twin, covered) : united(twin, covered);
    QVERIFY2(w.mask(1) == twin, qPrintable(QString::number(n)));
    if (w.steps() - first == int(states.size())) states.push_back(w.workspace());
    QCOMPARE(w.steps() - first + 1, int(states.size()));
  }
  QVERIFY(states.size() > 40);
  for (int n = int(states.size()) - 1; n-- > 0;) {
    w.undo();
    QVERIFY2(w.isAs(states[std::size_t(n)]), qPrintable(QString::number(n)));
  }
  for (std::size_t n = 1; n < states.size(); ++n) {
    w.redo();
    QVERIFY2(w.isAs(states[n]), qPrintable(QString::number(n)));
  }
  QVERIFY(w.idle());
}

VOLUMEN_TEST(TestSegmentPaint);
#include "tst_segment_paint.moc"
