// Guards the document: views keep what was made of each series, every change is a step that can be undone,
// and series in memory go when there is no room.
#include <QSignalSpy>
#include <QTest>
#include <random>

#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/session.h"
#include "ui/workspace/session_json.h"

using namespace volumen;

namespace {

void brighten(Session& session, double intensity) {
  session.edit(QStringLiteral("Light"), [&](Scene& s) { s.lights[0].intensity = intensity; });
  session.endGesture();
}

double brightness(const Session& session) { return session.scene().lights[0].intensity; }

// 20 x 30 x 41 voxels of 0.5, 0.7, 2 mm somewhere in the patient.
VoxelGeometry slab() {
  VoxelGeometry geometry;
  geometry.size = {20, 30, 41};
  for (int a = 0; a < 3; ++a) geometry.patientFromVoxelStep[a] *= glm::dvec3(0.5, 0.7, 2)[a];
  geometry.origin = {-100, 20, 300};
  return geometry;
}

}  // namespace

class TestWorkspace : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void editsSurviveASwitchAndBack();
  void aSwitchIsAStep();
  void viewsOfAGroupShowOneSeries();
  void comparedViewsShowTheirOwn();
  void layoutsKeepTheFocusOnScreen_data();
  void layoutsKeepTheFocusOnScreen();
  void randomStepsAreUndoneToTheByte();
  void whatPlaysOnBelongsToTheStepBefore();
  void theOldestSeriesGoFirst();
  void whatIsOnScreenStays();
  void aSeriesThatWentIsAskedForAgain();
  void closingIsAStep();
  void theTableComesBackWithUndo();
  void planesLieOnAcquiredSlices();
  void theWheelGoesDownThePatient_data();
  void theWheelGoesDownThePatient();
  void turningKeepsPlanesOrthogonalAndTheirPictures();
  void planesTurnToTheAcquiredSlices_data();
  void planesTurnToTheAcquiredSlices();
  void referenceLinesLieWhereThePlanesCut();
};

void TestWorkspace::editsSurviveASwitchAndBack() {
  Session session;
  const LoadedSeriesPtr a = tests::ballSeries(), b = tests::ballSeries();
  session.show(a);
  brighten(session, 0.25);
  session.show(b);
  QCOMPARE(brightness(session), 1.0);
  brighten(session, 0.5);
  QVERIFY(session.showAgain(a->series, session.workspace().focus));
  QCOMPARE(brightness(session), 0.25);
  session.show(b);
  QCOMPARE(brightness(session), 0.5);
}

void TestWorkspace::aSwitchIsAStep() {
  Session session;
  const LoadedSeriesPtr a = tests::ballSeries(), b = tests::ballSeries();
  session.show(a);
  QVERIFY2(!session.undoStack().canUndo(), "the first series is where it begins");
  brighten(session, 0.25);
  session.show(b);
  brighten(session, 0.5);
  session.undoStack().undo();
  QVERIFY(session.series() == b);
  session.undoStack().undo();
  QVERIFY(session.series() == a);
  QCOMPARE(brightness(session), 0.25);
  session.undoStack().undo();
  QCOMPARE(brightness(session), 1.0);
  while (session.undoStack().canRedo()) session.undoStack().redo();
  QVERIFY(session.series() == b);
  QCOMPARE(brightness(session), 0.5);
}

void TestWorkspace::viewsOfAGroupShowOneSeries() {
  Session session;
  const LoadedSeriesPtr a = tests::ballSeries();
  session.show(a);
  for (ViewId id = 0; id < firstComparedId; ++id) QVERIFY(session.seriesOf(id) == a);
  for (ViewId id = firstComparedId; id < viewCount; ++id) QVERIFY(!session.seriesOf(id));
}

void TestWorkspace::comparedViewsShowTheirOwn() {
  Session session;
  const LoadedSeriesPtr a = tests::ballSeries(), b = tests::ballSeries();
  session.show(a);
  session.change(QStringLiteral("Layout"), withLayout(session.workspace(), Layout::two));
  QVERIFY2(session.seriesOf(firstComparedId) == a, "beside what was shown");
  session.show(b, firstComparedId + 1);
  QVERIFY(session.seriesOf(firstComparedId) == a);
  QVERIFY(session.seriesOf(firstComparedId + 1) == b);
  QVERIFY(session.seriesOf(axialViewId) == a);
}

void TestWorkspace::layoutsKeepTheFocusOnScreen_data() {
  QTest::addColumn<int>("from");
  QTest::addColumn<int>("to");
  for (std::size_t from = 0; from < allLayouts().size(); ++from)
    for (std::size_t to = 0; to < allLayouts().size(); ++to)
      QTest::addRow("%s to %s", layoutName(allLayouts()[from]), layoutName(allLayouts()[to]))
          << int(from) << int(to);
}

void TestWorkspace::layoutsKeepTheFocusOnScreen() {
  QFETCH(int, from);
  QFETCH(int, to);
  const Layout first = allLayouts()[std::size_t(from)], second = allLayouts()[std::size_t(to)];
  QCOMPARE(*layoutNamed(layoutName(second)), second);
  Workspace workspace;
  for (ViewId focus = 0; focus < firstSecondId; ++focus) {
    workspace.focus = focus;
    const Workspace after = withLayout(withLayout(workspace, first), second);
    const auto views = viewsOnScreen(after);
    QVERIFY(std::ranges::find(views, after.focus) != views.end());
    if (std::ranges::find(views, focus) != views.end() && from == to) QCOMPARE(after.focus, focus);
    const ViewId scene = sceneViewOf(after);
    QVERIFY(after.view(scene).kind == ViewKind::volume);
  }
}

void TestWorkspace::randomStepsAreUndoneToTheByte() {
  std::mt19937 random(7);
  const auto below = [&](int n) { return int(random() % unsigned(n)); };
  Session session;
  const std::vector<LoadedSeriesPtr> series{tests::ballSeries(), tests::ballSeries(), tests::ballSeries()};
  session.show(series[0]);
  std::vector<Workspace> history{session.workspace()};
  std::vector<std::string> files;
  while (history.size() <= 200) {
    switch (below(7)) {
      case 0:
        session.show(series[std::size_t(below(3))], below(viewCount));
        break;
      case 1:
        session.change(
            QStringLiteral("Layout"),
            withLayout(session.workspace(), allLayouts()[std::size_t(below(int(allLayouts().size())))]));
        break;
      case 2:
        brighten(session, 0.01 * below(100));
        break;
      case 3:
        session.change(QStringLiteral("Zoom"), [&](Workspace& w) {
          ViewState& view = w.editView(below(viewCount));
          view.flats.editOrAdd(view.series).zoom = 1 + below(9);
        });
        break;
      case 4:
        session.showAs(below(viewCount), ViewKind(below(4)));
        break;
      case 5: {
        const SeriesKey key = keyOf(series[std::size_t(below(3))]->series);
        if (!session.workspace().series.contains(key)) break;
        Mask mask = session.maskOf(key);
        if (below(4) == 0) mask.tableRemoved = !mask.tableRemoved;
        if (below(6) == 0) mask.lassos.clear();
        Lasso lasso;
        lasso.perspective = below(2);
        lasso.inside = below(2);
        for (int n = below(9); n > 0; --n) lasso.points.emplace_back(below(99) / 7.0, below(99) / 3.0);
        mask.lassos.push_back(std::make_shared<const Lasso>(lasso));
        session.setMask(QStringLiteral("Cut"), key, mask);
        break;
      }
      default:
        session.change(QStringLiteral("Crosshair"),
                       [&](Workspace& w) { w.crosshairs.editOrAdd("f").at.x = below(99); });
    }
    session.endGesture();
    if (session.undoStack().index() == int(history.size())) history.push_back(session.workspace());
  }
  for (const Workspace& workspace : history) files.push_back(*sessionToJson(workspace, "/"));
  for (std::size_t n = history.size() - 1; n-- > 0;) {
    session.undoStack().undo();
    QVERIFY2(session.workspace() == history[n], qPrintable(QString::number(n)));
    QVERIFY2(*sessionToJson(session.workspace(), "/") == files[n], qPrintable(QString::number(n)));
  }
  for (std::size_t n = 1; n < history.size(); ++n) {
    session.undoStack().redo();
    QVERIFY2(session.workspace() == history[n], qPrintable(QString::number(n)));
  }
}

void TestWorkspace::whatPlaysOnBelongsToTheStepBefore() {
  Session session;
  session.show(tests::ballSeries());
  brighten(session, 0.9);
  const auto steps = [&] { return session.undoStack().index(); };
  const int atStart = steps();
  const auto play = [&](double intensity) {
    session.playOn(atStart, [&] {
      session.edit(
          QStringLiteral("Played"), [&](Scene& s) { s.lights[0].intensity = intensity; },
          QStringLiteral("Played"));
    });
  };
  const Workspace start = session.workspace();
  play(0.1);
  QCOMPARE(steps(), atStart + 1);
  play(0.2);
  const Workspace played = session.workspace();
  session.edit(
      QStringLiteral("Mode"), [](Scene& s) { s.mode = Mode::mip; }, QStringLiteral("Mode"));
  play(0.3);
  session.edit(
      QStringLiteral("Mode"), [](Scene& s) { s.mode = Mode::minip; }, QStringLiteral("Mode"));
  play(0.4);
  const Workspace last = session.workspace();
  QCOMPARE(steps(), atStart + 2);
  QCOMPARE(session.undoStack().undoText(), QStringLiteral("Mode"));
  session.undoStack().undo();
  QVERIFY(session.workspace() == played);
  session.undoStack().undo();
  QVERIFY(session.workspace() == start);
  session.undoStack().redo();
  session.undoStack().redo();
  QVERIFY(session.workspace() == last);
  // Back where it began nothing is left of it, and the step before keeps out of it.
  session.undoStack().undo();
  session.undoStack().undo();
  play(0.1);
  play(0.9);
  QCOMPARE(steps(), atStart);
  play(0.2);
  QCOMPARE(steps(), atStart + 1);
  session.undoStack().undo();
  QVERIFY(session.workspace() == start);
}

void TestWorkspace::theOldestSeriesGoFirst() {
  const LoadedSeriesPtr a = tests::ballSeries(), b = tests::ballSeries(), c = tests::ballSeries();
  const std::size_t one = a->volume->bytes();
  SeriesPool pool(2 * one);
  pool.put({keyOf(a->series), {}}, a);
  pool.put({keyOf(b->series), {}}, b);
  QVERIFY(pool.find({keyOf(a->series), {}}) == a);
  pool.put({keyOf(c->series), {}}, c);
  QVERIFY2(!pool.find({keyOf(b->series), {}}), "used longest ago");
  QVERIFY(pool.find({keyOf(a->series), {}}) && pool.find({keyOf(c->series), {}}));
  QCOMPARE(pool.bytes(), 2 * one);
}

void TestWorkspace::whatIsOnScreenStays() {
  const LoadedSeriesPtr a = tests::ballSeries(), b = tests::ballSeries(), c = tests::ballSeries();
  SeriesPool pool(1);
  pool.setOnScreen({{keyOf(a->series), {}}});
  pool.put({keyOf(a->series), {}}, a);
  pool.put({keyOf(b->series), {true, {}}}, b);
  pool.put({keyOf(c->series), {}}, c);
  QVERIFY2(pool.find({keyOf(a->series), {}}), "on screen");
  QVERIFY2(!pool.find({keyOf(b->series), {true, {}}}), "made again where it is wanted");
  pool.put({keyOf(c->series), {}}, c);
  pool.setOnScreen({});
  QVERIFY(!pool.find({keyOf(a->series), {}}));
}

void TestWorkspace::aSeriesThatWentIsAskedForAgain() {
  Session session;
  const LoadedSeriesPtr a = tests::ballSeries(), b = tests::ballSeries();
  session.pool().setBudget(1);
  QSignalSpy needed(&session, &Session::seriesNeeded);
  session.show(a);
  brighten(session, 0.25);
  session.show(b);
  QVERIFY(!session.pool().find({keyOf(a->series), {}}));
  session.undoStack().undo();
  QCOMPARE(needed.count(), 1);
  QCOMPARE(needed[0][0].value<Series>().id, a->series.id);
  QVERIFY(!session.series());
  session.take(a);
  QVERIFY(session.series() == a);
  QCOMPARE(brightness(session), 0.25);
  QVERIFY2(session.undoStack().canRedo(), "what came back is no step");
}

void TestWorkspace::closingIsAStep() {
  Session session;
  const LoadedSeriesPtr a = tests::ballSeries(), b = tests::ballSeries();
  session.show(a);
  session.show(b);
  const Workspace before = session.workspace();
  session.close({keyOf(b->series)});
  QVERIFY(!session.series());
  QVERIFY(session.showAgain(a->series, sceneViewId));
  session.show(nullptr);
  QVERIFY(!session.showAgain(a->series, sceneViewId));
  Workspace empty = session.workspace();
  QCOMPARE(empty.unlisted->series.size(), std::size_t(2));
  empty.unlisted = {};
  QVERIFY(empty == Workspace());
  // What is shown next is a step, or undo would bring the first ones back in its place.
  const LoadedSeriesPtr c = tests::ballSeries();
  session.show(c);
  session.undoStack().undo();
  QVERIFY(session.workspace().series.empty());
  for (int n = 0; n < 3; ++n) session.undoStack().undo();
  QVERIFY(session.workspace() == before);
}

void TestWorkspace::theTableComesBackWithUndo() {
  Session session;
  const LoadedSeriesPtr a = tests::ballSeries();
  const auto masked = std::make_shared<const LoadedSeries>(*a);
  session.show(a);
  const SeriesKey key = keyOf(a->series);
  const Mask mask{true, {}};
  session.takeMasked(mask, masked);
  QVERIFY(session.series() == a);
  session.setMask(QStringLiteral("Remove table"), key, mask);
  QVERIFY(session.series() == masked && session.maskOf(key) == mask);
  session.undoStack().undo();
  QVERIFY(session.series() == a && session.maskOf(key).empty());
  QVERIFY(session.seriesWith(key, mask) == masked);
}

void TestWorkspace::planesLieOnAcquiredSlices() {
  const VoxelGeometry geometry = slab();
  const Crosshair cursor = firstCrosshair(geometry);
  const glm::dvec3 pVoxel = geometry.voxelFromPatient(cursor.at);
  for (int a = 0; a < 3; ++a) QVERIFY(std::abs(pVoxel[a] - std::round(pVoxel[a])) < 1e-9);
  ViewState view;
  view.kind = ViewKind::axial;
  const SlicePlane plane = flatPlane(view, {}, geometry, cursor, {300, 200});
  QCOMPARE(plane.size, glm::ivec2(300, 200));
  QVERIFY(std::abs(plane.centre.z - cursor.at.z) < 1e-9);
  // 10 x 21 mm, the height in 200 pixels.
  QVERIFY(std::abs(plane.mmPerPixel - 21.0 / 200) < 1e-9);
}

void TestWorkspace::theWheelGoesDownThePatient_data() {
  QTest::addColumn<int>("kind");
  QTest::addColumn<glm::dvec3>("step");
  QTest::addColumn<int>("count");
  QTest::newRow("axial: caudal") << int(ViewKind::axial) << glm::dvec3(0, 0, -2) << 41;
  QTest::newRow("coronal: posterior") << int(ViewKind::coronal) << glm::dvec3(0, 0.7, 0) << 30;
  QTest::newRow("sagittal: left") << int(ViewKind::sagittal) << glm::dvec3(0.5, 0, 0) << 20;
}

void TestWorkspace::theWheelGoesDownThePatient() {
  QFETCH(int, kind);
  QFETCH(glm::dvec3, step);
  QFETCH(int, count);
  const VoxelGeometry geometry = slab();
  const Crosshair cursor = firstCrosshair(geometry);
  const auto near = [](glm::dvec3 a, glm::dvec3 b) { return glm::length(a - b) < 1e-9; };
  QVERIFY(near(scrolled(geometry, ViewKind(kind), cursor, 3), cursor.at + 3.0 * step));
  const StackPlace place = stackPlace(geometry, ViewKind(kind), cursor);
  QCOMPARE(place.count, count);
  const Crosshair end{scrolled(geometry, ViewKind(kind), cursor, 1000)};
  QCOMPARE(stackPlace(geometry, ViewKind(kind), end).index, count - 1);
  QVERIFY2(near(end.at, cursor.at + double(count - 1 - place.index) * step), "it stops at the last slice");
}

void TestWorkspace::turningKeepsPlanesOrthogonalAndTheirPictures() {
  const VoxelGeometry geometry = slab();
  const Crosshair first = firstCrosshair(geometry);
  const Crosshair turned = turnedIn(turnedIn(first, ViewKind::axial, 0.4), ViewKind::sagittal, -0.7);
  QVERIFY2(turnedIn(first, ViewKind::axial, 0.4).axial == first.axial, "the view under the hand stays");
  QVERIFY(turned.turned() && !first.turned());
  const glm::dvec3 a = turned.axial.normal(), c = turned.coronal.normal(), s = turned.sagittal.normal();
  for (const auto& [x, y] : {std::pair(a, c), std::pair(c, s), std::pair(s, a)})
    QVERIFY(std::abs(glm::dot(x, y)) < 1e-12);
  for (const ViewKind kind : {ViewKind::axial, ViewKind::coronal, ViewKind::sagittal}) {
    ViewState view;
    view.kind = kind;
    const SlicePlane before = flatPlane(view, {}, geometry, first, {300, 200});
    const SlicePlane after = flatPlane(view, {}, geometry, turned, {300, 200});
    QCOMPARE(after.mmPerPixel, before.mmPerPixel);
    QVERIFY(std::abs(glm::dot(after.centre - turned.at, after.normal())) < 1e-9);
  }
}

void TestWorkspace::planesTurnToTheAcquiredSlices_data() {
  QTest::addColumn<glm::dvec3>("i");
  QTest::addColumn<glm::dvec3>("j");
  QTest::addColumn<int>("kind");
  const double c = std::cos(0.3), s = std::sin(0.3);
  QTest::newRow("axial, tilted") << glm::dvec3(1, 0, 0) << glm::dvec3(0, c, s) << int(ViewKind::axial);
  QTest::newRow("axial, feet first") << glm::dvec3(-1, 0, 0) << glm::dvec3(0, c, s) << int(ViewKind::axial);
  QTest::newRow("coronal") << glm::dvec3(c, s, 0) << glm::dvec3(0, 0, -1) << int(ViewKind::coronal);
  QTest::newRow("sagittal") << glm::dvec3(s, c, 0) << glm::dvec3(0, 0, -1) << int(ViewKind::sagittal);
}

void TestWorkspace::planesTurnToTheAcquiredSlices() {
  QFETCH(glm::dvec3, i);
  QFETCH(glm::dvec3, j);
  QFETCH(int, kind);
  VoxelGeometry geometry = slab();
  geometry.patientFromVoxelStep = glm::dmat3(0.5 * i, 0.7 * j, 2.0 * glm::cross(i, j));
  const Crosshair along = alongSlices({1, 2, 3}, geometry);
  QCOMPARE(along.at, glm::dvec3(1, 2, 3));
  QVERIFY(std::abs(std::abs(glm::dot(along.plane(ViewKind(kind)).normal(), glm::cross(i, j))) - 1) < 1e-12);
  const Crosshair unturned{along.at};
  for (const ViewKind each : {ViewKind::axial, ViewKind::coronal, ViewKind::sagittal})
    QVERIFY2(glm::dot(along.plane(each).normal(), unturned.plane(each).normal()) > 0.9,
             "by the smallest turn");
}

void TestWorkspace::referenceLinesLieWhereThePlanesCut() {
  const VoxelGeometry geometry = slab();
  Crosshair cursor = firstCrosshair(geometry);
  ViewState axial, sagittal;
  axial.kind = ViewKind::axial;
  sagittal.kind = ViewKind::sagittal;
  const SlicePlane a = flatPlane(axial, {}, geometry, cursor, {300, 200});
  cursor.at.x += 2;
  const SlicePlane s = flatPlane(sagittal, {}, geometry, cursor, {300, 200});
  const auto line = referenceLine(a, s);
  QVERIFY(line);
  const double x = a.pixelFromPatient(cursor.at).x;
  QVERIFY(std::abs(line->from.x - x) < 1e-6 && std::abs(line->to.x - x) < 1e-6);
  QVERIFY(std::abs(line->from.y - line->to.y) > 200);
  QVERIFY2(!referenceLine(a, a), "parallel");
}

VOLUMEN_TEST(TestWorkspace);
#include "tst_workspace.moc"
