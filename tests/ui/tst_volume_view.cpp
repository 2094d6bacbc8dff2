// Guards design.md 8 (volume view and its gestures), picture.md 6 (ray inside box and clip) and picture.md 7
// (camera).
#include <QGuiApplication>
#include <QSignalSpy>
#include <QWheelEvent>
#include <cmath>
#include <glm/geometric.hpp>

#include "results/text/text.h"
#include "tests/ui/gestures.h"
#include "tests/ui/scene_session.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/views/canvas.h"
#include "ui/views/volume_view.h"

using namespace volumen;

namespace {

constexpr glm::dvec2 size(400, 300);

Camera someCamera(Projection projection) {
  Camera camera;
  camera.target = glm::dvec3(3, -2, 5);
  camera.direction = {0.3, 0.9, -0.2};
  camera.height = 100;
  camera.distance = 200;
  camera.projection = projection;
  return camera;
}

void projections() {
  QTest::addColumn<int>("projection");
  QTest::newRow("parallel") << int(Projection::parallel);
  QTest::newRow("perspective") << int(Projection::perspective);
}

bool near(glm::dvec2 a, glm::dvec2 b, double pixels = 1e-6) { return glm::length(a - b) < pixels; }

struct Shown : tests::SceneSession {
  VolumeView view{session, scenes, drawService};

  Shown() {
    session.show(tests::ballSeries());
    view.resize(int(size.x), int(size.y));
    view.show();
  }
  QPointF middle() const { return {size.x / 2, size.y / 2}; }
};

}  // namespace

class TestVolumeView : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void lineOfSightAndPositionAreInverse_data() { projections(); }
  void lineOfSightAndPositionAreInverse();
  void orbitKeepsThePivot_data() { projections(); }
  void orbitKeepsThePivot();
  void orbitFollowsTheHand();
  void zoomKeepsThePointUnderTheCursor_data() { projections(); }
  void zoomKeepsThePointUnderTheCursor();
  void panFollowsTheHand_data() { projections(); }
  void panFollowsTheHand();
  void projectionChangeKeepsTheSize();
  void sidesAreLettered_data();
  void sidesAreLettered();
  void scaleBarIsRound_data();
  void scaleBarIsRound();
  void namesReadLikeNames_data();
  void namesReadLikeNames();
  void pickFindsTheSurface();
  void pickSeesTheClip();
  void gesturesAreOneUndoStepEach_data();
  void gesturesAreOneUndoStepEach();
  void wheelZoomsAtTheCursor();
  void curveToolShiftsAndWidens();
  void cubeAndResetChangeTheView();
  void zoomCountsFromTheFittedView();
  void thePictureIsShownPixelByPixel();
  void theCanvasIsOpenGlWhereItCanBe();
};

void TestVolumeView::lineOfSightAndPositionAreInverse() {
  QFETCH(int, projection);
  const Camera camera = someCamera(Projection(projection));
  for (const glm::dvec2 at : {glm::dvec2(200, 150), glm::dvec2(10, 20), glm::dvec2(390, 250)}) {
    const SightLine line = sightLine(camera, size, at);
    for (double t : {150.0, 300.0}) QVERIFY(near(seenAt(camera, size, line.origin + t * line.direction), at));
  }
}

void TestVolumeView::orbitKeepsThePivot() {
  QFETCH(int, projection);
  const Camera camera = someCamera(Projection(projection));
  const glm::dvec3 pivot(10, 8, -6);
  const Camera after = orbited(camera, pivot, 0.4, -0.3);
  QVERIFY(near(seenAt(camera, size, pivot), seenAt(after, size, pivot)));
  QVERIFY(std::abs(glm::dot(glm::normalize(after.direction), glm::normalize(after.up))) < 1e-9);
}

void TestVolumeView::orbitFollowsTheHand() {
  // With positive angles, points in front of the pivot move right and down.
  Camera camera = someCamera(Projection::parallel);
  camera.direction = {0, 1, 0};
  const glm::dvec3 pivot = *camera.target, front = pivot - glm::dvec3(0, 20, 0);
  const glm::dvec2 before = seenAt(camera, size, front);
  QVERIFY(seenAt(orbited(camera, pivot, 0.1, 0), size, front).x > before.x);
  QVERIFY(seenAt(orbited(camera, pivot, 0, 0.1), size, front).y > before.y);
  // As on a turntable, the patient's z axis stays upright.
  const CameraAxes axes = cameraAxes(orbited(camera, pivot, 1.1, 0.4));
  QVERIFY(std::abs(axes.right.z) < 1e-9);
}

void TestVolumeView::zoomKeepsThePointUnderTheCursor() {
  QFETCH(int, projection);
  const Camera camera = someCamera(Projection(projection));
  const glm::dvec3 fixed(10, 8, -6);
  const Camera after = zoomedAt(camera, fixed, 0.5);
  QVERIFY(near(seenAt(camera, size, fixed), seenAt(after, size, fixed)));
  QVERIFY(std::abs(mmPerPixel(after, size, fixed) / mmPerPixel(camera, size, fixed) - 0.5) < 1e-9);
}

void TestVolumeView::panFollowsTheHand() {
  QFETCH(int, projection);
  const Camera camera = someCamera(Projection(projection));
  const glm::dvec3 held(10, 8, -6);
  const Camera after = panned(camera, size, {30, -20}, held);
  QVERIFY(near(seenAt(after, size, held), seenAt(camera, size, held) + glm::dvec2(30, -20)));
}

void TestVolumeView::projectionChangeKeepsTheSize() {
  const Camera camera = someCamera(Projection::parallel);
  const Camera other = withProjection(camera, Projection::perspective);
  QVERIFY(std::abs(mmPerPixel(other, size, *camera.target) - mmPerPixel(camera, size, *camera.target)) <
          1e-9);
  QVERIFY(std::abs(withProjection(other, Projection::parallel).height - camera.height) < 1e-9);
}

void TestVolumeView::sidesAreLettered_data() {
  QTest::addColumn<double>("x");
  QTest::addColumn<double>("y");
  QTest::addColumn<double>("z");
  QTest::addColumn<QString>("letters");
  QTest::newRow("left") << 1.0 << 0.0 << 0.0 << QStringLiteral("L");
  QTest::newRow("anterior") << 0.0 << -2.0 << 0.1 << QStringLiteral("A");
  QTest::newRow("posterior and left") << 0.6 << 0.8 << 0.1 << QStringLiteral("PL");
  QTest::newRow("inferior, right, anterior") << -0.5 << -0.4 << -0.7 << QStringLiteral("IRA");
}

void TestVolumeView::sidesAreLettered() {
  QFETCH(double, x);
  QFETCH(double, y);
  QFETCH(double, z);
  QFETCH(QString, letters);
  QCOMPARE(QString::fromStdString(sideLetters({x, y, z})), letters);
}

void TestVolumeView::scaleBarIsRound_data() {
  QTest::addColumn<double>("mmPerPixel");
  QTest::addColumn<double>("mm");
  QTest::newRow("0.3 mm a pixel") << 0.3 << 20.0;
  QTest::newRow("0.5 mm a pixel") << 0.5 << 50.0;
  QTest::newRow("close up") << 0.004 << 0.2;
}

void TestVolumeView::scaleBarIsRound() {
  QFETCH(double, mmPerPixel);
  QFETCH(double, mm);
  QVERIFY(std::abs(scaleBarMm(mmPerPixel, 100) - mm) < 1e-9);
}

void TestVolumeView::namesReadLikeNames_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QString>("id");
  QTest::addColumn<QString>("text");
  const auto row = [](const char* what, const char* name, const char* id, const char* text) {
    QTest::newRow(what) << QString::fromUtf8(name) << QString::fromUtf8(id) << QString::fromUtf8(text);
  };
  row("carets", "Doe^Jane^A", "12", "Doe, Jane A (12)");
  row("other scripts follow", "Yamada^Tarou=山田^太郎", "1", "Yamada, Tarou (1)");
  row("no name", "", "77", "77");
  row("nothing", "", "", "(no name)");
  row("reordering characters are taken out", "Doe\u202e^Jane", "", "Doe, Jane");
}

void TestVolumeView::namesReadLikeNames() {
  QFETCH(QString, name);
  QFETCH(QString, id);
  QFETCH(QString, text);
  Series series;
  series.format = "DICOM";
  series.patientName = name.toStdString();
  series.patientId = id.toStdString();
  QCOMPARE(patientText(series), text);
}

void TestVolumeView::pickFindsTheSurface() {
  const LoadedSeriesPtr series = tests::ballSeries(32, 10, {2, 0, 0});
  const SightLine line{{2, -500, 0}, {0, 1, 0}};
  const auto hit = pick(series->firstScene, *series->volume, line, true);
  QVERIFY(hit.has_value());
  // The curve begins at 400 of 1000, in the cell that holds the surface, so it is within a voxel.
  QVERIFY(std::abs(hit->pPatient->y + 10) < 1);
  QVERIFY(std::abs(valueAtVoxel(*series->volume, {15.5 + 2, 15.5, 15.5}) - 1000) < 1e-9);
  QVERIFY(!pick(series->firstScene, *series->volume, {{14, -500, 14}, {0, 1, 0}}, true));
  // In perspective nothing behind the eye is seen.
  QVERIFY(!pick(series->firstScene, *series->volume, {{2, 14, 0}, {0, 1, 0}}, false));
}

void TestVolumeView::pickSeesTheClip() {
  const LoadedSeriesPtr series = tests::ballSeries();
  Scene scene = series->firstScene;
  scene.clip.boxLow.y = 0.5;
  auto hit = pick(scene, *series->volume, {{0, -500, 0}, {0, 1, 0}}, true);
  QVERIFY(hit && std::abs(hit->pPatient->y) < 1);
  scene.clip = {};
  scene.clip.planes = {{{0, -2, 0}, -4}};  // keeps y >= 4
  hit = pick(scene, *series->volume, {{0, -500, 0}, {0, 1, 0}}, true);
  QVERIFY(hit && std::abs(hit->pPatient->y - 4) < 1);
}

void TestVolumeView::gesturesAreOneUndoStepEach_data() {
  QTest::addColumn<int>("button");
  QTest::addColumn<int>("modifiers");
  QTest::addColumn<QString>("step");
  QTest::newRow("left turns") << int(Qt::LeftButton) << 0 << QStringLiteral("Rotate");
  QTest::newRow("Ctrl+left rolls") << int(Qt::LeftButton) << int(Qt::ControlModifier)
                                   << QStringLiteral("Rotate");
  QTest::newRow("middle pans") << int(Qt::MiddleButton) << 0 << QStringLiteral("Pan");
  QTest::newRow("Shift+left pans") << int(Qt::LeftButton) << int(Qt::ShiftModifier) << QStringLiteral("Pan");
  QTest::newRow("right zooms") << int(Qt::RightButton) << 0 << QStringLiteral("Zoom");
}

void TestVolumeView::gesturesAreOneUndoStepEach() {
  QFETCH(int, button);
  QFETCH(int, modifiers);
  QFETCH(QString, step);
  Shown shown;
  const Camera before = shown.view.camera();
  const auto dragOnce = [&] {
    tests::drag(&shown.view, shown.middle() + QPointF(30, 0), shown.middle() + QPointF(60, 40),
                Qt::MouseButton(button), Qt::KeyboardModifiers(modifiers));
  };
  dragOnce();
  QVERIFY(!(shown.view.camera() == before));
  QCOMPARE(shown.session.undoStack().count(), 1);
  QCOMPARE(shown.session.undoStack().undoText(), step);
  dragOnce();
  QCOMPARE(shown.session.undoStack().count(), 2);
  shown.session.undoStack().undo();
  shown.session.undoStack().undo();
  QVERIFY(shown.view.camera() == before);
}

void TestVolumeView::wheelZoomsAtTheCursor() {
  Shown shown;
  const QPointF at = shown.middle() + QPointF(20, 10);
  const auto seen = shown.view.pickAt(at);
  QVERIFY(seen.has_value());
  QWheelEvent wheel(at, shown.view.mapToGlobal(at), {}, {0, 240}, Qt::NoButton, Qt::NoModifier,
                    Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(&shown.view, &wheel);
  const Camera after = shown.view.camera();
  QVERIFY(near(seenAt(after, size, *seen->pPatient), {at.x(), at.y()}));
  QVERIFY(after.height < 32 * 0.75);
}

void TestVolumeView::curveToolShiftsAndWidens() {
  Shown shown;
  shown.view.setTool(toolNamed("curve"));
  const auto points = [&] { return shown.session.scene().transferFunction.points; };
  tests::drag(&shown.view, shown.middle(), shown.middle() + QPointF(0, -60));
  QVERIFY2(points()[0].value < 400 && points()[1].value < 600, "up: lower values become visible");
  QVERIFY(std::abs((points()[1].value - points()[0].value) - 200) < 1e-3);
  shown.session.undoStack().undo();
  tests::drag(&shown.view, shown.middle(), shown.middle() + QPointF(60, 0));
  QVERIFY2(points()[1].value - points()[0].value > 220, "right: wider");
  shown.session.undoStack().undo();
  shown.session.edit(QStringLiteral("thin"), [](Scene& s) { s.transferFunction.points[1].opacity = 0.3; });
  tests::drag(&shown.view, shown.middle(), shown.middle() + QPointF(0, -60), Qt::LeftButton,
              Qt::ControlModifier);
  QVERIFY2(points()[1].opacity > 0.4, "Ctrl, up: more opaque");
  QCOMPARE(points()[0].value, 400.f);
}

void TestVolumeView::cubeAndResetChangeTheView() {
  Shown shown;
  auto* button = shown.view.findChild<QWidget*>(QStringLiteral("view-superior"));
  QVERIFY(button);
  QTest::mouseClick(button, Qt::LeftButton);
  QCOMPARE(viewName(shown.view.camera()), std::string("superior"));
  shown.view.resetView();
  QCOMPARE(viewName(shown.view.camera()), std::string("anterior"));
  QCOMPARE(shown.session.undoStack().count(), 2);
}

void TestVolumeView::zoomCountsFromTheFittedView() {
  tests::SceneSession s;
  Session& session = s.session;
  session.show(tests::ballSeries(32, 10, {}, {1, 1, 3}));
  VolumeView view(session, s.scenes, s.drawService);
  view.resize(400, 300);
  view.show();
  const auto wheel = [&](int notches) {
    QWheelEvent event({5, 5}, view.mapToGlobal(QPointF(5, 5)), {}, {0, 120 * notches}, Qt::NoButton,
                      Qt::NoModifier, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&view, &event);
  };
  QCOMPARE(view.zoom(), 1.0);
  tests::drag(&view, {200, 150}, {330, 190});
  QCOMPARE(view.zoom(), 1.0);
  view.resize(400, 250);  // a banner appeared
  QCOMPARE(view.zoom(), 1.0);
  wheel(2);
  const double enlarged = std::pow(0.85, -2);
  QVERIFY(std::abs(view.zoom() - enlarged) < 1e-9);
  tests::drag(&view, {200, 150}, {260, 90});
  QVERIFY(std::abs(view.zoom() - enlarged) < 1e-9);
  view.showView(QStringLiteral("superior"));
  QCOMPARE(view.zoom(), 1.0);
  tests::drag(&view, {200, 150}, {260, 90});
  QCOMPARE(view.zoom(), 1.0);
  session.undoStack().undo();
  session.undoStack().undo();
  QVERIFY(std::abs(view.zoom() - enlarged) < 1e-9);
  view.resetView();
  QCOMPARE(view.zoom(), 1.0);
}

void TestVolumeView::thePictureIsShownPixelByPixel() {
  Shown shown;
  QVERIFY(QTest::qWaitForWindowExposed(&shown.view));
  QImage image(shown.view.pixels(), QImage::Format_RGB32);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      image.setPixel(x, y, qRgb(x % 256, y % 256, (x * 7 + y * 3) % 256));
  shown.view.setPicture(image, QStringLiteral("standard"));
  const QImage seen = shown.view.grab().toImage().convertToFormat(QImage::Format_RGB32);
  QCOMPARE(seen.size(), image.size());
  // Compares away from overlay texts.
  for (int y = 90; y < 140; ++y)
    for (int x = 60; x < 340; ++x) QCOMPARE(seen.pixel(x, y), image.pixel(x, y));
}

void TestVolumeView::theCanvasIsOpenGlWhereItCanBe() {
  Shown shown;
  QVERIFY(QTest::qWaitForWindowExposed(&shown.view));
  const bool xcb = QGuiApplication::platformName() == QStringLiteral("xcb");
  QCOMPARE(canvasKind(shown.view.canvas()), xcb ? QStringLiteral("OpenGL") : QStringLiteral("raster"));
  qputenv("VOLUMEN_CANVAS", "raster");
  tests::SceneSession s;
  const VolumeView other(s.session, s.scenes, s.drawService);
  qunsetenv("VOLUMEN_CANVAS");
  QCOMPARE(canvasKind(other.canvas()), QStringLiteral("raster"));
}

VOLUMEN_TEST(TestVolumeView);
#include "tst_volume_view.moc"
