// Guards slices.md 4 in 3D: lengths and angles between points of the visible surface, by real mouse and key
// events. They are compared with rays that meet a ball. Also guards what else the window does with them.
#include <QMenu>

#include "results/text/measured_text.h"
#include "tests/ui/surface_window.h"
#include "tests/unit/suite.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/session_json.h"

using namespace volumen;
using namespace volumen::tests;

class TestSurfaceMeasurements : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aLengthLiesOnTheSurface_data();
  void aLengthLiesOnTheSurface();
  void anAngleTakesThreeClicks();
  void theCameraMayMoveBetweenClicks();
  void otherButtonsMoveItToo_data();
  void otherButtonsMoveItToo();
  void whereNothingIsSeenASentenceSaysSo_data();
  void whereNothingIsSeenASentenceSaysSo();
  void anEndIsNotLeftOffTheSurface();
  void keysChooseAndPutAway();
  void theMenuShowsTheKeysThatHold();
  void theSliceThroughBothEndsShowsIt();
  void itSaysHowDeepItMayLie();
  void theSessionKeepsIt();
  void theWheelPlacesNoneAnew();
};

void TestSurfaceMeasurements::aLengthLiesOnTheSurface_data() {
  QTest::addColumn<int>("projection");
  QTest::addColumn<bool>("byClicks");
  QTest::newRow("parallel, a drag") << int(Projection::parallel) << false;
  QTest::newRow("parallel, two clicks") << int(Projection::parallel) << true;
  QTest::newRow("perspective, a drag") << int(Projection::perspective) << false;
  QTest::newRow("perspective, two clicks") << int(Projection::perspective) << true;
}

void TestSurfaceMeasurements::aLengthLiesOnTheSurface() {
  QFETCH(int, projection);
  QFETCH(bool, byClicks);
  SurfaceWindow w;
  const Camera camera = withProjection(w.scene()->camera(), Projection(projection));
  w.session().edit(QStringLiteral("camera"), [&](Scene& s) { s.camera = camera; });
  const Workspace before = w.session().workspace();
  const int steps = w.session().undoStack().index();
  const QPointF from = w.pixelOf({-6, -10, 3}), to = w.pixelOf({7, -9, -2});
  w.choose(ShapeKind::length);
  QVERIFY(w.isMeasuring());
  if (byClicks) {
    w.click(from);
    QVERIFY(w.all().empty());
    hover(w.scene(), to);
    QCOMPARE(w.scene()->drawnMeasurements().size(), std::size_t(1));
    QVERIFY2(w.scene()->drawnMeasurements()[0].text.value(0).endsWith(QStringLiteral(" mm")),
             "its number follows the hand");
    w.click(to);
  } else {
    drag(w.scene(), from, to);
  }
  QCOMPARE(w.all().size(), std::size_t(1));
  QVERIFY2(!w.isMeasuring(), "the tool before is back");
  const Measurement m = w.last();
  QVERIFY(m.shape.kind == ShapeKind::length && checkShape(m.shape).ok());
  QVERIFY(areNear(m.shape.points[0], w.onBall(from)) && areNear(m.shape.points[1], w.onBall(to)));
  const double mm = glm::length(w.onBall(to) - w.onBall(from));
  QVERIFY(std::abs(w.measured(m)->number - mm) < 2 * offTheBall);
  QCOMPARE(w.session().workspace().selected, m.id);
  const DrawnMeasurement seen = w.seenLast();
  QCOMPARE(seen.text, measuredLines(m.shape, w.measured(m)));
  QCOMPARE(seen.handles.size(), std::size_t(2));
  // A point is seen where it was picked, within the rounding of the way through patient space.
  QVERIFY((seen.handles[0].at - from).manhattanLength() < 1e-6);
  QVERIFY((seen.handles[1].at - to).manhattanLength() < 1e-6);
  QCOMPARE(w.session().undoStack().index(), steps + 1);
  w.undo();
  QVERIFY(w.session().workspace() == before);
  w.redo();
  QVERIFY(w.last() == m);
}

void TestSurfaceMeasurements::anAngleTakesThreeClicks() {
  SurfaceWindow w;
  const QPointF arm = w.pixelOf({-6, -10, 0}), vertex = w.pixelOf({0, -12, 0}),
                other = w.pixelOf({0, -10, 6});
  w.choose(ShapeKind::angle);
  w.click(arm);
  w.click(vertex);
  QVERIFY(w.all().empty());
  w.click(other);
  QCOMPARE(w.all().size(), std::size_t(1));
  const glm::dvec3 a = w.onBall(arm) - w.onBall(vertex), b = w.onBall(other) - w.onBall(vertex);
  const double degrees = std::acos(glm::dot(a, b) / glm::length(a) / glm::length(b)) * 180 / std::acos(-1.0);
  // 0.1 mm at either end of arms of 6 mm.
  QVERIFY(std::abs(w.measured(w.last())->number - degrees) < 4);
  QCOMPARE(w.seenLast().lines.size(), std::size_t(1));
  QCOMPARE(w.seenLast().lines[0].size(), qsizetype(3));
}

// Goes from the front to the side, which the front does not show.
void TestSurfaceMeasurements::theCameraMayMoveBetweenClicks() {
  SurfaceWindow w;
  w.choose(ShapeKind::length);
  const QPointF front = w.pixelOf({0, -12, 0});
  const glm::dvec3 first = w.onBall(front);
  w.click(front);
  const int steps = w.session().undoStack().index();
  for (int n = 0; n < 18; ++n) QTest::keyClick(w.scene(), Qt::Key_Left);
  wheel(w.scene(), 1);
  const int moved = w.session().undoStack().index();
  QVERIFY(moved > steps);
  const QPointF side = w.pixelOf({0, 0, 3});
  const glm::dvec3 second = w.onBall(side);
  QVERIFY2(std::abs(second.y) < 3 && std::abs(second.x) > 10, "what lay at the side is in front");
  w.click(side + QPointF(8, 0));
  QCOMPARE(w.all().size(), std::size_t(1));
  QVERIFY(areNear(w.last().shape.points[0], first));
  QVERIFY(areNear(w.last().shape.points[1], w.onBall(side + QPointF(8, 0))));
  QCOMPARE(w.session().undoStack().index(), moved + 1);
  w.choose(ShapeKind::length);
  w.click(side);
  QTest::keyClick(w.scene(), Qt::Key_Left);
  const Camera turned = w.scene()->camera();
  QTest::keyClick(w.scene(), Qt::Key_Escape);
  QVERIFY2(w.scene()->camera() == turned, "what is given up is what was drawn");
  QCOMPARE(w.all().size(), std::size_t(1));
  QCOMPARE(w.scene()->drawnMeasurements().size(), std::size_t(1));
}

void TestSurfaceMeasurements::otherButtonsMoveItToo_data() {
  QTest::addColumn<int>("button");
  QTest::newRow("the middle one") << int(Qt::MiddleButton);
  QTest::newRow("the right one") << int(Qt::RightButton);
}

void TestSurfaceMeasurements::otherButtonsMoveItToo() {
  QFETCH(int, button);
  SurfaceWindow w;
  w.choose(ShapeKind::length);
  const QPointF from = w.pixelOf({-6, -10, 3}), middle = w.pixelOf({0, -12, 0}), way(9, 12);
  const glm::dvec3 first = w.onBall(from);
  w.click(from);
  const Camera before = w.scene()->camera();
  QTest::mousePress(w.scene(), Qt::MouseButton(button), {}, middle.toPoint());
  QTest::mouseEvent(QTest::MouseMove, w.scene(), Qt::MouseButton(button), {}, (middle + way).toPoint());
  QVERIFY(w.scene()->camera() != before);
  QTest::keyClick(w.scene(), Qt::Key_Escape);
  QVERIFY2(w.scene()->camera() == before, "the drag was given up");
  QTest::mouseRelease(w.scene(), Qt::MouseButton(button), {}, (middle + way).toPoint());
  QCOMPARE(w.scene()->drawnMeasurements().size(), std::size_t(1));
  drag(w.scene(), middle, middle + way, Qt::MouseButton(button));
  QVERIFY(w.scene()->camera() != before);
  QCOMPARE(w.scene()->drawnMeasurements().size(), std::size_t(1));
  const QPointF to = w.pixelOf({7, -9, -2});
  w.click(to);
  QCOMPARE(w.all().size(), std::size_t(1));
  QVERIFY(areNear(w.last().shape.points[0], first));
  QVERIFY(areNear(w.last().shape.points[1], w.onBall(to)));
}

void TestSurfaceMeasurements::whereNothingIsSeenASentenceSaysSo_data() {
  QTest::addColumn<int>("mode");
  QTest::addColumn<QString>("sentence");
  QTest::newRow("beside the ball")
      << int(Mode::composite)
      << QStringLiteral("Nothing is seen there: click on a visible surface to measure in 3D.");
  const QString deep =
      QStringLiteral("A projection does not show how deep a place lies: choose the mode 3D to measure here.");
  QTest::newRow("in a mean") << int(Mode::average) << deep;
  QTest::newRow("at the largest values") << int(Mode::mip) << deep;
  QTest::newRow("at the smallest values") << int(Mode::minip) << deep;
}

void TestSurfaceMeasurements::whereNothingIsSeenASentenceSaysSo() {
  QFETCH(int, mode);
  QFETCH(QString, sentence);
  SurfaceWindow w;
  w.session().edit(QStringLiteral("mode"), [&](Scene& s) { s.mode = Mode(mode); });
  const Workspace before = w.session().workspace();
  w.choose(ShapeKind::length);
  w.click(w.pixelOf({17, -12, 17}));
  QCOMPARE(w.told(), sentence);
  QVERIFY(w.scene()->drawnMeasurements().empty());
  QVERIFY(w.session().workspace() == before);
  QVERIFY2(w.isMeasuring(), "for another try");
}

void TestSurfaceMeasurements::anEndIsNotLeftOffTheSurface() {
  SurfaceWindow w;
  const QPointF from = w.pixelOf({0, -12, 0}), beside = w.pixelOf({17, -12, 17}), to = w.pixelOf({6, -10, 0});
  w.choose(ShapeKind::length);
  drag(w.scene(), from, beside);
  QVERIFY(w.all().empty());
  QVERIFY(w.told().startsWith(QStringLiteral("Nothing is seen there")));
  w.click(to);
  QCOMPARE(w.all().size(), std::size_t(1));
  QVERIFY(areNear(w.last().shape.points[0], w.onBall(from)));
  QVERIFY(areNear(w.last().shape.points[1], w.onBall(to)));
}

void TestSurfaceMeasurements::keysChooseAndPutAway() {
  SurfaceWindow w;
  w.scene()->setFocus();
  QTest::keyClick(w.scene(), Qt::Key_D);
  QVERIFY(w.child<QAction>("lengthTool")->isChecked());
  QTest::keyClick(w.scene(), Qt::Key_Escape);
  QVERIFY(!w.isMeasuring());
  QTest::keyClick(w.scene(), Qt::Key_D);
  QTest::keyClick(w.scene(), Qt::Key_L);
  QCOMPARE(viewName(w.scene()->camera()), std::string("left"));
  QVERIFY2(w.isMeasuring(), "the view was turned, nothing else");
  w.child<QAction>("rotateTool")->trigger();
  QVERIFY2(!w.isMeasuring(), "another tool was taken");
  w.choose(ShapeKind::length);
  w.click(w.pixelOf({0, 0, 5}), Qt::ShiftModifier);
  w.click(w.pixelOf({0, 0, -5}), Qt::ShiftModifier);
  QCOMPARE(w.all().size(), std::size_t(1));
  QVERIFY2(w.isMeasuring(), "Shift keeps it");
}

// A means the view from the front here. Shift+A means nothing.
void TestSurfaceMeasurements::theMenuShowsTheKeysThatHold() {
  SurfaceWindow w;
  w.scene()->setFocus();
  QTest::keyClick(w.scene(), Qt::Key_A);
  QTest::keyClick(w.scene(), Qt::Key_A, Qt::ShiftModifier);
  QVERIFY(!w.isMeasuring());
  QTest::mouseClick(w.scene(), Qt::RightButton, {}, w.scene()->rect().center());
  auto* menu = w.child<QMenu>("volumeMenu");
  QVERIFY(menu);
  QStringList entries;
  for (const QAction* action : menu->actions()) entries << action->text();
  QVERIFY(entries.contains(QStringLiteral("Length\tD")));
  QVERIFY2(entries.contains(QStringLiteral("Angle")), qPrintable(entries.join(u'|')));
  w.child<QAction>("angleToolInScene")->trigger();
  QVERIFY(&w.window.views()->tool() == &toolNamed("angle"));
  menu->close();
}

// Both ends are in one row of pixels seen from the front, so they have one height in the patient.
void TestSurfaceMeasurements::theSliceThroughBothEndsShowsIt() {
  SurfaceWindow w;
  QTest::keyClick(w.scene(), Qt::Key_A);
  QCOMPARE(viewName(w.scene()->camera()), std::string("anterior"));
  const QPointF from = w.pixelOf({-6, -10, 3});
  w.drawLength(from, QPointF(w.pixelOf({7, -9, 3}).x(), from.y()));
  const Measurement m = w.last();
  QVERIFY(std::abs(m.shape.points[0].z - m.shape.points[1].z) < 1e-6);
  QVERIFY(std::abs(m.shape.points[0].x - m.shape.points[1].x) > 10);
  moveCrosshair(w.session(), axialViewId, *w.session().series(), QStringLiteral("there"), m.shape.points[0]);
  const DrawnMeasurement there = w.drawn(m.id);
  QVERIFY(there.whole);
  QCOMPARE(there.text, w.seenLast().text);
  glm::dvec3 away = m.shape.points[0];
  away.z += 5;
  moveCrosshair(w.session(), axialViewId, *w.session().series(), QStringLiteral("away"), away);
  QVERIFY(w.drawn(m.id).lines.empty());
  w.draw(ShapeKind::length, placesOf(ShapeKind::length));
  QCOMPARE(w.all().size(), std::size_t(2));
  QVERIFY2(!w.last().shape.softMm, "it was drawn in a slice");
  QCOMPARE(w.seenLast().text, measuredLines(w.last().shape, w.measured(w.last())));
  w.draw(ShapeKind::ellipse, placesOf(ShapeKind::ellipse));
  QVERIFY2(w.seenLast().lines.empty(), "regions belong to their slices");
}

void TestSurfaceMeasurements::itSaysHowDeepItMayLie() {
  SurfaceWindow w;
  const QPointF from = w.pixelOf({-6, -10, 3}), to = w.pixelOf({7, -9, -2});
  w.drawLength(from, to);
  const auto detail = [&] {
    return detailText(w.last(), w.measured(w.last()), w.session().series()->series);
  };
  QVERIFY(w.last().shape.softMm);
  QVERIFY2(detail().contains(QStringLiteral("on the surface as it was seen in 3D (depth within 0.1 mm)")),
           qPrintable(detail()));
  const double hard = *w.measured(w.last())->plusMinus;
  w.makeFog();  // a point in fog is about as uncertain as the depth at which half of the light is left
  w.drawLength(from, to);
  QCOMPARE(w.all().size(), std::size_t(2));
  QVERIFY(*w.last().shape.softMm > 2);
  QVERIFY2(detail().contains(QStringLiteral("(depth \u00b1 ")), qPrintable(detail()));
  QVERIFY(*w.measured(w.last())->plusMinus > hard + 2);
  hover(w.scene(), w.seenLast().handles[0].at);
  QCOMPARE(w.child<QLabel>("hoverText")->text(), detail());
}

void TestSurfaceMeasurements::theSessionKeepsIt() {
  SurfaceWindow w;
  w.makeFog();
  w.drawLength(w.pixelOf({-6, -10, 3}), w.pixelOf({7, -9, -2}));
  QVERIFY(w.last().shape.softMm.value_or(0) > 2);
  const Workspace& now = w.session().workspace();
  const auto text = sessionToJson(now, {}, {});
  QVERIFY(text.ok());
  const auto series = now.series.begin()->second.series;
  const auto again = sessionFromJson(*text, [&](const SavedSeries&) { return series; });
  QVERIFY2(again.ok(), again.ok() ? "" : again.message().c_str());
  QVERIFY(again->workspace.measurements == now.measurements);
  QVERIFY(again->workspace.measurements[0].shape.softMm == w.last().shape.softMm);
}

// What 3D shows of hundreds of lengths stays as it is while the wheel turns in a slice; it does not when one
// of them, or the camera, changes.
void TestSurfaceMeasurements::theWheelPlacesNoneAnew() {
  SurfaceWindow w;
  QSignalSpy settled(&w.window, &MainWindow::settled);
  w.child<QAction>("layoutPlanes")->trigger();
  QVERIFY(settled.wait());
  std::vector<Shape> lengths(300);
  for (int n = 0; n < 300; ++n) lengths[std::size_t(n)].points = {{-8, -8 + n / 20, n % 20 - 10}, {8, 0, 0}};
  addMeasurements(w.session(), w.all().empty() ? keyOf(w.session().series()->series) : w.all()[0].series,
                  lengths);
  w.scene()->repaint();
  const auto placed = w.scene()->placedMeasurements();
  QCOMPARE(placed->size(), std::size_t(300));
  const glm::dvec3 before = w.view(axialViewId)->plane()->centre;
  for (int n = 0; n < 3; ++n) {
    wheel(w.view(axialViewId), 1);
    QCoreApplication::processEvents();
    w.window.repaint();
  }
  QVERIFY(w.view(axialViewId)->plane()->centre != before);
  QVERIFY2(w.scene()->placedMeasurements() == placed, "the wheel");
  renameMeasurement(w.session(), placed->front().id, QStringLiteral("first"));
  const auto renamed = w.scene()->placedMeasurements();
  QVERIFY2(renamed != placed && renamed->front().text.value(0) == QStringLiteral("first"), "a name");
  w.scene()->showView(QStringLiteral("left"));
  QVERIFY2(w.scene()->placedMeasurements() != renamed, "the camera");
}

VOLUMEN_TEST(TestSurfaceMeasurements);
#include "tst_surface_measurements.moc"
