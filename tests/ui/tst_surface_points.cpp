// Guards measurements in 3D after drawing: which points can be moved there, what is selected, where it is
// drawn and what its text says.
#include <functional>

#include "results/text/measured_text.h"
#include "tests/ui/surface_window.h"
#include "tests/unit/suite.h"
#include "ui/workspace/flat_plane.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

LoadedSeriesPtr inFrame(const LoadedSeriesPtr& series, const char* frame) {
  auto there = std::make_shared<LoadedSeries>(*series);
  there->series.frameOfReferenceUid = frame;
  return there;
}

// Returns a series without a known voxel size.
LoadedSeriesPtr uncalibratedSeries() {
  VolumeParts parts;
  parts.geometry.size = glm::ivec3(8);
  parts.geometry.calibrated = false;
  parts.values = std::vector<float>(8 * 8 * 8);
  std::vector<std::string> warnings;
  return seriesOf(*Volume::make(std::move(parts), warnings));
}

}  // namespace

class TestSurfacePoints : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aPointIsDraggedOverTheSurface();
  void aClickOnAPointChangesNothing();
  void whatWasNotPickedThereIsNotMoved_data();
  void whatWasNotPickedThereIsNotMoved();
  void theEndThatIsSeenIsMovedAlone();
  void softnessIsThatOfWherePointsLie();
  void movedInASliceItIsNoLongerOnTheSurface_data();
  void movedInASliceItIsNoLongerOnTheSurface();
  void aClickSelectsAndDeleteRemoves();
  void itIsDrawnWhereItIsSeen_data();
  void itIsDrawnWhereItIsSeen();
  void textsAreOfTheirOwnSeries();
};

void TestSurfacePoints::aPointIsDraggedOverTheSurface() {
  SurfaceWindow w;
  w.drawLength(w.pixelOf({-6, -10, 3}), w.pixelOf({7, -9, -2}));
  QCOMPARE(w.all().size(), std::size_t(1));
  const Workspace before = w.session().workspace();
  const int steps = w.session().undoStack().index();
  const QPointF end = w.seenLast().handles[1].at, elsewhere = w.pixelOf({2, -11, -7});
  drag(w.scene(), end, elsewhere);
  QVERIFY(areNear(w.last().shape.points[1], w.onBall(elsewhere)));
  QVERIFY(w.last().shape.points[0] == before.measurements[0].shape.points[0]);
  QCOMPARE(w.session().undoStack().index(), steps + 1);
  w.undo();
  QVERIFY(w.session().workspace() == before);
  // Beyond the edge of the visible surface, the point keeps its last position on it.
  QTest::mousePress(w.scene(), Qt::LeftButton, {}, end.toPoint());
  QTest::mouseEvent(QTest::MouseMove, w.scene(), Qt::LeftButton, {}, w.pixelOf({17, -12, 17}).toPoint());
  QVERIFY(w.last() == before.measurements[0]);
  QTest::mouseEvent(QTest::MouseMove, w.scene(), Qt::LeftButton, {}, elsewhere.toPoint());
  QVERIFY(w.last() != before.measurements[0]);
  QTest::keyClick(w.scene(), Qt::Key_Escape);
  QVERIFY(w.session().workspace() == before);
  QTest::mouseRelease(w.scene(), Qt::LeftButton, {}, elsewhere.toPoint());
  QVERIFY(w.session().workspace() == before);
}

void TestSurfacePoints::aClickOnAPointChangesNothing() {
  SurfaceWindow w;
  w.drawLength(w.pixelOf({-6, -10, 3}), w.pixelOf({7, -9, -2}));
  const Workspace before = w.session().workspace();
  const int steps = w.session().undoStack().index();
  const QPoint end = w.seenLast().handles[1].at.toPoint();
  QTest::mousePress(w.scene(), Qt::LeftButton, {}, end);
  QTest::mouseEvent(QTest::MouseMove, w.scene(), Qt::LeftButton, {}, end + QPoint(1, 1));
  QTest::mouseRelease(w.scene(), Qt::LeftButton, {}, end + QPoint(1, 1));
  QVERIFY(w.session().workspace() == before);
  QCOMPARE(w.session().undoStack().index(), steps);
}

void TestSurfacePoints::whatWasNotPickedThereIsNotMoved_data() {
  using Draw = std::function<void(SurfaceWindow&)>;
  QTest::addColumn<Draw>("draw");
  QTest::newRow("drawn in a slice") << Draw([](SurfaceWindow& w) {
    w.draw(ShapeKind::length, w.placesWithin(placesOf(ShapeKind::length), {}, 4));
  });
  QTest::newRow("hidden by the ball") << Draw([](SurfaceWindow& w) {
    w.drawLength(w.pixelOf({-6, -10, 3}), w.pixelOf({7, -9, -2}));
    w.scene()->showView(QStringLiteral("posterior"));
  });
  QTest::newRow("the surface is elsewhere by now") << Draw([](SurfaceWindow& w) {
    w.drawLength(w.pixelOf({-6, -10, 3}), w.pixelOf({7, -9, -2}));
    w.session().edit(QStringLiteral("deeper"), [](Scene& s) {
      for (CurvePoint& p : s.transferFunction.points) p.value = 900;  // moves the surface by 4 mm
    });
  });
  QTest::newRow("a projection") << Draw([](SurfaceWindow& w) {
    w.drawLength(w.pixelOf({-6, -10, 3}), w.pixelOf({7, -9, -2}));
    w.session().edit(QStringLiteral("mode"), [](Scene& s) { s.mode = Mode::mip; });
  });
}

// A drag from such an end turns the camera, as from anywhere else.
void TestSurfacePoints::whatWasNotPickedThereIsNotMoved() {
  QFETCH(std::function<void(SurfaceWindow&)>, draw);
  SurfaceWindow w;
  draw(w);
  QCOMPARE(w.all().size(), std::size_t(1));
  QCOMPARE(w.seenLast().lines.size(), std::size_t(1));
  QVERIFY(w.seenLast().selected && w.seenLast().handles.empty());
  const Measurement before = w.last();
  const Camera camera = w.scene()->camera();
  const QPointF end = w.seenLast().lines[0][1];
  drag(w.scene(), end, end + QPointF(40, 15));
  QVERIFY(w.last() == before);
  QVERIFY(w.scene()->camera() != camera);
}

// Seen from the left, the first end is behind the ball.
void TestSurfacePoints::theEndThatIsSeenIsMovedAlone() {
  SurfaceWindow w;
  w.drawLength(w.pixelOf({-9, -6, 3}), w.pixelOf({9, -6, -2}));
  const Measurement before = w.last();
  w.scene()->showView(QStringLiteral("left"));
  const DrawnMeasurement seen = w.seenLast();
  QCOMPARE(seen.handles.size(), std::size_t(1));
  QCOMPARE(seen.handles[0].index, std::size_t(1));
  const QPointF elsewhere =
      w.pixelOf({10, 2, -5}) + seen.handles[0].at - QPointF(seen.handles[0].at.toPoint());
  drag(w.scene(), seen.handles[0].at, elsewhere);
  QVERIFY(areNear(w.last().shape.points[1], w.onBall(elsewhere)));
  QVERIFY(w.last().shape.points[0] == before.shape.points[0]);
}

// In fog, a line of sight through the middle is more uncertain than one nearer to the edge.
void TestSurfacePoints::softnessIsThatOfWherePointsLie() {
  SurfaceWindow w;
  w.makeFog();
  w.drawLength(w.pixelOf({-10, 0, 0}), w.pixelOf({10, 0, 0}));
  const double before = w.last().shape.softMm.value_or(0);
  const QPointF end = w.seenLast().handles[1].at;
  const auto move = [&](QPointF to) {
    QTest::mouseEvent(QTest::MouseMove, w.scene(), Qt::LeftButton, {}, to.toPoint());
    return w.last().shape.softMm.value_or(0);
  };
  QTest::mousePress(w.scene(), Qt::LeftButton, {}, end.toPoint());
  QVERIFY(move(w.pixelOf({1, 0, 0})) > before + 1);
  // At its old position the uncertainty is the same, within the fine steps of picking.
  QVERIFY(std::abs(move(end) - before) < 0.1);
  QTest::mouseRelease(w.scene(), Qt::LeftButton, {}, end.toPoint());
}

void TestSurfacePoints::movedInASliceItIsNoLongerOnTheSurface_data() {
  using Place = std::function<QPointF(const DrawnMeasurement&)>;
  QTest::addColumn<Place>("place");
  QTest::addColumn<bool>("stays");
  QTest::newRow("an end") << Place([](const DrawnMeasurement& d) { return d.handles[1].at; }) << false;
  QTest::newRow("all of it") << Place([](const DrawnMeasurement& d) {
    return (d.lines[0][0] + d.lines[0][1]) / 2;
  }) << false;
  QTest::newRow("its text") << Place([](const DrawnMeasurement& d) { return d.textRect.center(); }) << true;
}

void TestSurfacePoints::movedInASliceItIsNoLongerOnTheSurface() {
  QFETCH(std::function<QPointF(const DrawnMeasurement&)>, place);
  QFETCH(bool, stays);
  SurfaceWindow w;
  QTest::keyClick(w.scene(), Qt::Key_A);
  const QPointF from = w.pixelOf({-6, -10, 3});
  w.drawLength(from, QPointF(w.pixelOf({7, -9, 3}).x(), from.y()));
  const Measurement before = w.last();
  moveCrosshair(w.session(), axialViewId, *w.session().series(), QStringLiteral("there"),
                before.shape.points[0]);
  QVERIFY(w.drawn(before.id).whole && w.drawn(before.id).handles.size() == 2);
  const QPointF at = place(w.drawn(before.id));
  drag(w.view(), at, at + QPointF(12, 20));
  QVERIFY(w.last() != before);
  QCOMPARE(w.last().shape.softMm.has_value(), stays);
  w.undo();
  QVERIFY(w.last() == before);
}

void TestSurfacePoints::aClickSelectsAndDeleteRemoves() {
  SurfaceWindow w;
  const QPointF from = w.pixelOf({-8, -8, 0}), to = w.pixelOf({8, -8, 0});
  w.drawLength(from, to);
  const int id = w.last().id;
  QCOMPARE(w.all().size(), std::size_t(1));
  w.session().select(0);
  const Workspace before = w.session().workspace();
  const QPointF middle = (from + to) / 2;
  w.click(middle);
  QCOMPARE(w.session().workspace().selected, id);
  QVERIFY2(w.session().workspace().crosshairs == before.crosshairs,
           "the line was meant, not what lies behind it");
  drag(w.scene(), middle + QPointF(0, 25), middle + QPointF(3, 35));
  QVERIFY2(w.session().workspace().selected == id, "the camera was turned, nothing else");
  w.undo();
  w.click(middle + QPointF(0, 25));
  QCOMPARE(w.session().workspace().selected, 0);
  w.click(middle);
  QTest::keyClick(w.scene(), Qt::Key_Delete);
  QVERIFY(w.all().empty());
  w.undo();
  QCOMPARE(w.last().id, id);
}

void TestSurfacePoints::itIsDrawnWhereItIsSeen_data() {
  using Act = std::function<void(SurfaceWindow&)>;
  QTest::addColumn<Act>("act");
  QTest::newRow("turned") << Act([](SurfaceWindow& w) { QTest::keyClick(w.scene(), Qt::Key_Left); });
  QTest::newRow("enlarged") << Act([](SurfaceWindow& w) { wheel(w.scene(), 1); });
  QTest::newRow("turned back") << Act([](SurfaceWindow& w) {
    QTest::keyClick(w.scene(), Qt::Key_Left);
    hover(w.scene(), {5, 5});
    w.undo();
  });
  QTest::newRow("in a view of another size") << Act([](SurfaceWindow& w) {
    w.child<QAction>("layoutOne")->trigger();
    QCoreApplication::processEvents();
  });
  QTest::newRow("named") << Act(
      [](SurfaceWindow& w) { renameMeasurement(w.session(), w.last().id, QStringLiteral("a lesion")); });
}

// The drawing is right however often the pointer asked for it before.
void TestSurfacePoints::itIsDrawnWhereItIsSeen() {
  QFETCH(std::function<void(SurfaceWindow&)>, act);
  SurfaceWindow w;
  w.drawLength(w.pixelOf({-6, -10, 3}), w.pixelOf({7, -9, -2}));
  const auto isRight = [&] {
    const Measurement& m = w.last();
    const DrawnMeasurement seen = w.seenLast();
    QStringList text = measuredLines(m.shape, w.measured(m));
    if (!m.shape.name.empty()) text.prepend(nameText(m));
    if (seen.text != text || seen.lines.size() != 1) return false;
    for (int n = 0; n < 2; ++n) {
      const glm::dvec2 at = seenAt(w.scene()->camera(), w.sceneSize(), m.shape.points[std::size_t(n)]);
      if ((seen.lines[0][n] - QPointF(at.x, at.y)).manhattanLength() > 1e-6) return false;
    }
    return true;
  };
  hover(w.scene(), w.seenLast().handles[0].at);
  QVERIFY(isRight());
  act(w);
  QVERIFY(isRight());
}

void TestSurfacePoints::textsAreOfTheirOwnSeries() {
  const LoadedSeriesPtr first = inFrame(opaqueBall(), "one");
  SurfaceWindow w(first);
  w.drawLength(w.pixelOf({-6, -10, 3}), w.pixelOf({7, -9, -2}));
  const QStringList text = w.seenLast().text;
  QVERIFY(text.value(0).endsWith(QStringLiteral(" mm")));
  w.session().show(inFrame(uncalibratedSeries(), "one"), sceneViewId);
  QVERIFY(keyOf(w.session().series()->series) != w.last().series);
  QCOMPARE(w.seenLast().lines.size(), std::size_t(1));
  QCOMPARE(w.seenLast().text, text);
  w.session().pool().forget(w.last().series);
  w.session().setFocus(axialViewId);
  QCOMPARE(w.seenLast().lines.size(), std::size_t(1));
  QVERIFY(w.seenLast().text.isEmpty());
}

VOLUMEN_TEST(TestSurfacePoints);
#include "tst_surface_points.moc"
