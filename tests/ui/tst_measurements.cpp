// Guards measurements: edited, moved and deleted by hand, shown in every view to which they belong, undone
// and redone.
#include <QCheckBox>
#include <QLineEdit>
#include <QRandomGenerator>
#include <numbers>

#include "results/text/measured_text.h"
#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;
using enum ShapeKind;

namespace {

QPointF middleOf(QPointF a, QPointF b) { return (a + b) / 2; }

}  // namespace

class TestMeasurements : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void handlesMoveTheirPoint();
  void aCornerKeepsTheOppositeOne();
  void anOutlineIsPulled();
  void aLineMovesTheShape();
  void aTextIsMoved();
  void escapeGivesUpAnEdit();
  void deleteRemovesTheSelected();
  void twoHundredStepsBackAndForth();
  void otherPlanesShowTheCut();
  void aShapeStaysOnItsSlice();
  void seriesOfOneFrameShareThem();
  void theViewsSeriesIsMeasured();
  void hoverTellsHowSure();
};

void TestMeasurements::handlesMoveTheirPoint() {
  MeasureWindow w;
  w.draw(length, {{50, 50}, {130, 90}});
  const Shape before = w.last().shape;
  const int steps = w.session().undoStack().index();
  drag(w.view(), {130, 90}, {110, 140});
  QVERIFY(w.last().shape.points[0] == before.points[0]);
  QVERIFY(glm::length(w.last().shape.points[1] - w.patient({110, 140})) < 1e-9);
  QCOMPARE(w.session().undoStack().index(), steps + 1);
  w.undo();
  QVERIFY(w.last().shape == before);
}

void TestMeasurements::aCornerKeepsTheOppositeOne() {
  for (const ShapeKind kind : {ellipse, rectangle}) {
    MeasureWindow w;
    w.draw(kind, {{60, 60}, {120, 110}});
    drag(w.view(), {60, 110}, {40, 140});  // the lower left corner
    const DrawnMeasurement drawn = w.drawn(w.last().id);
    QRectF box;
    for (const auto& handle : drawn.handles) box |= QRectF(handle.at, QSizeF(1e-9, 1e-9));
    QVERIFY(glm::length(glm::dvec2(box.left() - 40, box.top() - 60)) < 1e-6);
    QVERIFY(glm::length(glm::dvec2(box.right() - 120, box.bottom() - 140)) < 1e-6);
    const double mm = w.view()->plane()->mmPerPixel;
    const double area = (kind == ellipse ? std::numbers::pi / 4 : 1) * 80 * 80 * mm * mm;
    QVERIFY(std::abs(w.measured(w.last())->number - area) < 1e-9 * area);
  }
}

void TestMeasurements::anOutlineIsPulled() {
  MeasureWindow w;
  std::vector<QPointF> circle;
  for (int n = 0; n < 60; ++n)
    circle.push_back(
        {100 + 40 * std::cos(n * std::numbers::pi / 30), 100 + 40 * std::sin(n * std::numbers::pi / 30)});
  w.draw(freehand, circle);
  const Shape before = w.last().shape;
  const double area = w.measured(w.last())->number;
  const DrawnMeasurement drawn = w.drawn(w.last().id);
  QVERIFY(drawn.handles.size() > 6 && drawn.handles.size() <= 12);
  const QPointF at = drawn.handles[3].at;
  drag(w.view(), at, at + (at - QPointF(100, 100)) / 2);
  QVERIFY(w.measured(w.last())->number > area * 1.02);
  int moved = 0;
  for (std::size_t n = 0; n < before.points.size(); ++n)
    moved += w.last().shape.points[n] != before.points[n];
  QVERIFY2(moved > 3 && moved < int(before.points.size()) / 3, "its neighbours, not all of them");
}

void TestMeasurements::aLineMovesTheShape() {
  for (const ShapeKind kind : drawnKinds) {
    MeasureWindow w;
    const std::vector<QPointF> places = placesOf(kind);
    w.draw(kind, places);
    if (auto* field = w.view()->findChild<QLineEdit*>(QStringLiteral("measurementName")))
      QTest::keyClick(field, Qt::Key_Return);
    const Measurement before = w.last();
    w.session().select(0);  // without handles, so that a drag at the ends takes the line
    QPointF on = kind == probe ? places[0] : middleOf(places[0], places[1]);
    if (kind == ellipse || kind == rectangle) on = {middleOf(places[0], places[1]).x(), places[0].y()};
    drag(w.view(), on, on + QPointF(13, 7));
    QCOMPARE(w.session().workspace().selected, before.id);
    const glm::dvec3 mm = w.patient({13, 7}) - w.patient({0, 0});
    for (std::size_t n = 0; n < before.shape.points.size(); ++n)
      QVERIFY2(glm::length(w.last().shape.points[n] - before.shape.points[n] - mm) < 1e-9, ruleOf(kind).name);
    if (before.shape.plane)
      QVERIFY(glm::length(w.last().shape.plane->centre - before.shape.plane->centre - mm) < 1e-9);
    w.undo();
    QVERIFY(w.last() == before);
  }
}

void TestMeasurements::aTextIsMoved() {
  MeasureWindow w;
  w.draw(ellipse, {{60, 60}, {120, 110}});
  const Measurement before = w.last();
  const QRectF text = w.drawn(before.id).textRect;
  QVERIFY2(!text.intersects(QRectF(60, 60, 60, 50)), "beside its shape");
  drag(w.view(), text.center(), text.center() + QPointF(-20, 40));
  QVERIFY(w.last().shape == before.shape && w.last().textOffset);
  // A press is on a whole pixel, but the text's centre need not be.
  QVERIFY(QLineF(w.drawn(before.id).textRect.center(), text.center() + QPointF(-20, 40)).length() < 1.5);
  const QPointF at = w.drawn(before.id).textRect.center();
  drag(w.view(), {90, 60}, {100, 70});  // drags the shape, and its text moves with it
  QVERIFY(QLineF(w.drawn(before.id).textRect.center(), at + QPointF(10, 10)).length() < 1e-6);
  w.undo();
  w.undo();
  QVERIFY(w.last() == before);
}

void TestMeasurements::escapeGivesUpAnEdit() {
  MeasureWindow w;
  w.draw(length, {{50, 50}, {130, 90}});
  const Workspace before = w.session().workspace();
  QTest::mousePress(w.view(), Qt::LeftButton, {}, {130, 90});
  QTest::mouseEvent(QTest::MouseMove, w.view(), Qt::LeftButton, {}, {110, 140});
  QVERIFY(w.session().workspace() != before);
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QVERIFY(w.session().workspace() == before);
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, {110, 140});
}

void TestMeasurements::deleteRemovesTheSelected() {
  MeasureWindow w;
  w.draw(length, {{50, 50}, {130, 90}});
  w.draw(probe, {{100, 130}});
  const SharedList<Measurement> before = w.all();
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, {90, 70});
  QCOMPARE(w.session().workspace().selected, before[0].id);
  QTest::keyClick(w.view(), Qt::Key_Delete);
  QCOMPARE(w.all().size(), std::size_t(1));
  QVERIFY(w.last() == before[1]);
  QTest::keyClick(w.view(), Qt::Key_Delete);
  QCOMPARE(w.all().size(), std::size_t(1));  // nothing is selected any more
  w.undo();
  QVERIFY(w.all() == before);
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, {20, 160});
  QVERIFY2(w.session().workspace().selected == 0, "a press beside all of them selects none");
}

// Draws, moves, renames and deletes at random. Undo and redo restore every state.
void TestMeasurements::twoHundredStepsBackAndForth() {
  MeasureWindow w;
  QRandomGenerator random(11);
  const int first = w.session().undoStack().index();
  std::vector<Workspace> states{w.session().workspace()};
  while (states.size() <= 200) {
    const int before = w.session().undoStack().index();
    const auto at = [&] { return QPointF(random.bounded(30, 170), random.bounded(30, 170)); };
    const int what = random.bounded(10);
    if (what < 4 || w.all().empty()) {
      // Leaves out the arrow, which asks for a text.
      const ShapeKind kind = drawnKinds[random.bounded(quint32(drawnKinds.size() - 1))];
      std::vector<QPointF> places = placesOf(kind);
      const QPointF by = at() / 4;
      for (QPointF& p : places) p += by;
      w.draw(kind, places);
    } else if (what < 8) {
      const QPointF from = at();
      drag(w.view(), from, from + QPointF(9, 5));  // moves a shape or a text, or changes the window
    } else if (what == 8) {
      renameMeasurement(w.session(), w.last().id, QString::number(states.size()));
    } else {
      deleteMeasurement(w.session(), w.all()[random.bounded(quint32(w.all().size()))].id);
    }
    if (w.session().undoStack().index() > before) states.push_back(w.session().workspace());
  }
  QCOMPARE(w.session().undoStack().index(), first + 200);
  const auto sameAs = [&](Workspace wanted) {
    wanted.selected = w.session().workspace().selected;  // selecting is no undo step
    return w.session().workspace() == wanted;
  };
  for (std::size_t n = 200; n-- > 0;) {
    w.undo();
    QVERIFY(sameAs(states[n]));
  }
  for (std::size_t n = 1; n <= 200; ++n) {
    w.redo();
    QVERIFY(sameAs(states[n]));
  }
}

void TestMeasurements::otherPlanesShowTheCut() {
  MeasureWindow w;
  w.draw(rectangle, {{60, 60}, {140, 120}});
  const int id = w.last().id;
  const glm::dvec3 a = w.last().shape.points[0], b = w.last().shape.points[1];
  moveCrosshair(w.session(), axialViewId, *w.session().series(), QStringLiteral("Crosshair"), (a + b) / 2.0);
  const DrawnMeasurement cut = w.drawn(id, coronalViewId);
  QVERIFY(!cut.whole && cut.text.isEmpty() && cut.handles.empty());
  QCOMPARE(cut.lines.size(), qsizetype(1));
  const SlicePlane plane = *w.view(coronalViewId)->plane();
  const double width = QLineF(cut.lines[0].front(), cut.lines[0].back()).length() * plane.mmPerPixel;
  QVERIFY(std::abs(width - std::abs(b.x - a.x)) < 1e-9);
  // A press on the cut selects the measurement and moves nothing.
  const Measurement before = w.last();
  w.session().select(0);
  const QPointF on = middleOf(cut.lines[0].front(), cut.lines[0].back());
  drag(w.view(coronalViewId), on, on + QPointF(20, 20));
  QCOMPARE(w.session().workspace().selected, id);
  QVERIFY(w.last() == before);
}

void TestMeasurements::aShapeStaysOnItsSlice() {
  MeasureWindow w;
  w.draw(length, {{50, 50}, {130, 90}});
  const int id = w.last().id;
  w.view()->scroll(1);
  QVERIFY(w.drawn(id).lines.empty());
  w.view()->scroll(-1);
  QVERIFY(w.drawn(id).whole);
  w.child<QCheckBox>("measurementsShown")->click();
  QVERIFY(w.drawn(id).lines.empty());
  w.draw(probe, {{100, 130}});
  QVERIFY2(w.drawn(id).whole, "whoever draws wants to see them");
}

void TestMeasurements::seriesOfOneFrameShareThem() {
  auto first = std::make_shared<LoadedSeries>(*ballSeries()),
       same = std::make_shared<LoadedSeries>(*ballSeries());
  first->series.frameOfReferenceUid = same->series.frameOfReferenceUid = "1.2.3";
  MeasureWindow w(first);
  w.draw(length, {{50, 50}, {130, 90}});
  const int id = w.last().id;
  w.session().show(same);
  QVERIFY(w.drawn(id).whole);
  QVERIFY(w.last().series == keyOf(first->series));
  w.session().show(ballSeries());
  QVERIFY(w.drawn(id).lines.empty());
  w.session().show(first);
  QVERIFY(w.drawn(id).whole);
  w.session().close({keyOf(first->series)});
  QVERIFY(w.all().empty());
}

void TestMeasurements::theViewsSeriesIsMeasured() {
  MeasureWindow w;
  const LoadedSeriesPtr other = ballSeries(16, 4);
  w.child<QAction>("layoutTwo")->trigger();
  w.session().show(other, firstComparedId + 1);
  QCoreApplication::processEvents();
  w.draw(length, {{50, 50}, {130, 90}}, firstComparedId + 1);
  QVERIFY(w.last().series == keyOf(other->series));
  QVERIFY(w.drawn(w.last().id, firstComparedId + 1).whole);
  QVERIFY(w.drawn(w.last().id, firstComparedId).lines.empty());
}

void TestMeasurements::hoverTellsHowSure() {
  MeasureWindow w;
  w.draw(length, {{50, 50}, {130, 90}});
  QSignalSpy hovered(w.view(), &View::hovered);
  hover(w.view(), {90, 70});
  const Measured m = *w.measured(w.last());
  QCOMPARE(hovered.last().value(0).toString(),
           QStringLiteral("Length 1: %1 \u00b1 %2 mm, from CT Ball")
               .arg(shortNumberText(m.number), shortNumberText(*m.plusMinus)));
  QCOMPARE(w.view()->cursor().shape(), Qt::SizeAllCursor);
  hover(w.view(), {50, 50});
  QCOMPARE(w.view()->cursor().shape(), Qt::PointingHandCursor);
  hover(w.view(), {30, w.view()->height() * 0.75});
  QCOMPARE(w.view()->cursor().shape(), Qt::ArrowCursor);
  QVERIFY(!hovered.last().value(0).toString().contains(QStringLiteral("Length")));
}

VOLUMEN_TEST(TestMeasurements);
#include "tst_measurements.moc"
