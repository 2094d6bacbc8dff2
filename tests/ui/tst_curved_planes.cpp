// Guards curved planes in the window. A curve is drawn across slices, laid out beside them, scrolled,
// measured, undone and kept in sessions. A curve that cannot be laid out is reported.
#include <cmath>
#include <glm/geometric.hpp>

#include "results/text/measured_text.h"
#include "tests/ui/curve_window.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"
#include "ui/workspace/links.h"

using namespace volumen;
using namespace volumen::tests;
using namespace volumen::tests::curved;
using glm::dvec3;

class TestCurvedPlanes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aCurveIsDrawnAcrossSlices();
  void aDoubleClickEndsIt();
  void itsPointsAreDraggedWhereTheyAreSeen();
  void itIsLaidOutInFourViews();
  void scrollingItMovesTheSlices();
  void anotherWidth();
  void undoneAndDoneAgain();
  void undoneWhileItIsMade();
  void aSessionBringsItBack();
  void aChangedCurveIsSaid();
  void whatCannotBeShownIsTold_data();
  void whatCannotBeShownIsTold();
};

void TestCurvedPlanes::aCurveIsDrawnAcrossSlices() {
  const SessionFolder folder;
  CurveWindow w(folder);
  FlatView* axial = w.view(axialViewId);
  QVERIFY(axial && axial->plane());
  w.press("openCurveTool");
  std::vector<dvec3> places;
  const QPoint at[] = {w.pixel(axialViewId, {-10, -6, 0}).toPoint(),
                       w.pixel(axialViewId, {4, 8, 0}).toPoint(), w.pixel(axialViewId, {4, 8, 0}).toPoint()};
  for (const QPoint p : at) {
    QTest::mouseClick(axial, Qt::LeftButton, {}, p);
    places.push_back(axial->plane()->patientFromPixel({p.x(), p.y()}));
    const std::vector<DrawnMeasurement> drawn = axial->drawnMeasurements();
    QVERIFY2(drawn.size() == 1 && !drawn[0].lines.empty(), "all of it is seen while it is drawn");
    wheel(axial, -2);
  }
  QVERIFY(w.workspace().measurements.empty());
  QTest::keyClick(axial, Qt::Key_Return);
  QCOMPARE(w.workspace().measurements.size(), std::size_t(1));
  const Measurement m = w.curve();
  QVERIFY(m.shape.kind == ShapeKind::openCurve && !m.shape.plane);
  QCOMPARE(m.shape.points.size(), std::size_t(3));
  for (std::size_t n = 0; n < 3; ++n) QVERIFY(glm::distance(m.shape.points[n], places[n]) < 1e-9);
  QVERIFY2(std::abs(places[1].z - places[0].z) > 3 && std::abs(places[2].z - places[1].z) > 3,
           "on three slices, one straight above another");
  QVERIFY2(!w.window.views()->tool().measuring, "the tool before is back");
  const auto measured = measure(m.shape, *w.loaded(axialViewId)->volume, "HU");
  QCOMPARE(measured->number, SmoothCurve::through(m.shape.points)->length());
  QCOMPARE(measured->unit, std::string("mm"));
  w.press("undo");
  QVERIFY(w.workspace().measurements.empty());
  w.press("redo");
  QVERIFY(w.curve() == m);
}

void TestCurvedPlanes::aDoubleClickEndsIt() {
  const SessionFolder folder;
  CurveWindow w(folder);
  w.press("openCurveTool");
  w.click(axialViewId, arch[0]);
  w.click(axialViewId, arch[1]);
  const QPoint last = w.pixel(axialViewId, arch[2]).toPoint();
  QTest::mouseClick(w.view(axialViewId), Qt::LeftButton, {}, last);
  QTest::mouseDClick(w.view(axialViewId), Qt::LeftButton, {}, last);
  QCOMPARE(w.workspace().measurements.size(), std::size_t(1));
  QCOMPARE(w.curve().shape.points.size(), std::size_t(3));
  // Its number is the length of the smooth curve.
  const DrawnMeasurement drawn = w.view(axialViewId)->drawnMeasurements().front();
  QCOMPARE(drawn.text.value(0),
           shortNumberText(SmoothCurve::through(w.curve().shape.points)->length()) + QStringLiteral(" mm"));
}

// A slice shows handles of the points that lie in it. Only these can be dragged there.
void TestCurvedPlanes::itsPointsAreDraggedWhereTheyAreSeen() {
  const SessionFolder folder;
  CurveWindow w(folder);
  FlatView* axial = w.view(axialViewId);
  w.press("openCurveTool");
  w.click(axialViewId, arch[0]);
  wheel(axial, -3);
  w.click(axialViewId, arch[2]);
  wheel(axial, -3);
  w.click(axialViewId, arch[4]);
  QTest::keyClick(axial, Qt::Key_Return);
  const std::vector<dvec3> before = w.curve().shape.points;
  QCOMPARE(before.size(), std::size_t(3));
  const DrawnMeasurement drawn = axial->drawnMeasurements().front();
  QCOMPARE(drawn.handles.size(), std::size_t(1));
  QCOMPARE(drawn.handles[0].index, std::size_t(2));
  drag(axial, drawn.handles[0].at, drawn.handles[0].at + QPointF(12, -9));
  const std::vector<dvec3> after = w.curve().shape.points;
  QVERIFY(after[0] == before[0] && after[1] == before[1]);
  QVERIFY(std::abs(glm::distance(after[2], before[2]) - 15 * axial->plane()->mmPerPixel) < 1e-6);
  QVERIFY(std::abs(after[2].z - before[2].z) < 1e-9);
  w.press("undo");
  QVERIFY(w.curve().shape.points == before);
}

void TestCurvedPlanes::itIsLaidOutInFourViews() {
  const SessionFolder folder;
  CurveWindow w(folder);
  w.drawCurve(arch);
  const Measurement curve = w.curve();
  const SeriesKey source = curve.series;
  QVERIFY(w.showCurve());
  QVERIFY(w.workspace().layout == Layout::four);
  QVERIFY(w.workspace().view(slices).series == source);
  QVERIFY(w.workspace().view(slices).kind == ViewKind::axial);
  QVERIFY(w.workspace().view(straightened).kind == ViewKind::coronal);
  QVERIFY(w.workspace().view(stretched).kind == ViewKind::coronal);
  QVERIFY(w.workspace().view(sections).kind == ViewKind::axial);
  QCOMPARE(QString::fromStdString(w.seriesAt(straightened).description),
           QStringLiteral("Curve 1, straightened"));
  QCOMPARE(QString::fromStdString(w.seriesAt(stretched).description), QStringLiteral("Curve 1, stretched"));
  QCOMPARE(w.seriesAt(sections).unit, w.seriesAt(slices).unit);
  QVERIFY2(frameOfReference(w.seriesAt(stretched)) != frameOfReference(w.seriesAt(slices)),
           "a space of its own");
  // A curve drawn in an axial slice is stretched along the patient's axis, from right to left.
  const CurvedRecipe& recipe = w.seriesAt(stretched).curved->recipe;
  QVERIFY(glm::distance(recipe.ruled, dvec3(0, 0, 1)) < 1e-6);
  QVERIFY(recipe.points == curve.shape.points);
  const double length = SmoothCurve::through(curve.shape.points)->length();
  for (const ViewId id : {straightened, stretched}) {
    const VoxelGeometry& g = w.loaded(id)->volume->geometry();
    QVERIFY(std::abs(g.spacing().z * (g.size.z - 1) - length) < 1e-6);
    QVERIFY(std::abs(g.spacing().x - 2) < 1e-9);
    QVERIFY(g == w.seriesAt(id).acquired);
  }
  // A curved plane has no orientation letters, and says for which lengths it is not true.
  for (const ViewId id : {straightened, stretched, sections}) {
    const Overlays over = w.view(id)->overlays();
    QVERIFY(over.left.isEmpty() && over.right.isEmpty() && over.top.isEmpty() && over.bottom.isEmpty());
    QVERIFY(over.mmPerPixel > 0);
  }
  const QString warnings = w.window.views()->warningsShown().join(QLatin1Char(' '));
  QVERIFY2(warnings.contains(QStringLiteral("Resampled along a curve")), qPrintable(warnings));
  QVERIFY(!w.view(slices)->overlays().left.isEmpty());
  QVERIFY(w.view(sections)->overlays().topRight.contains(QStringLiteral("Cross-section")));
  QVERIFY(w.view(straightened)->overlays().topRight.contains(QStringLiteral("Straightened plane")));
  QVERIFY(w.view(stretched)->overlays().topRight.contains(QStringLiteral("Stretched plane")));
}

void TestCurvedPlanes::scrollingItMovesTheSlices() {
  const SessionFolder folder;
  CurveWindow w(folder);
  w.drawCurve(arch);
  QVERIFY(w.showCurve());
  const dvec3 before = w.crosshair(sections).at;
  const StackPlace place = w.view(sections)->stack().place;
  wheel(w.view(sections), -3);
  const dvec3 after = w.crosshair(sections).at;
  QCOMPARE(w.view(sections)->stack().place.index, place.index + 3);
  const VoxelGeometry& g = w.loaded(sections)->volume->geometry();
  QVERIFY(std::abs(glm::distance(before, after) - 3 * g.spacing().z) < 1e-6);
  const QString corner = w.view(sections)->overlays().topRight.join(QLatin1Char('\n'));
  QVERIFY2(corner.contains(shortNumberText(std::round(10 * std::abs(after.z)) / 10) +
                           QStringLiteral(" mm along the curve")),
           qPrintable(corner));
  // The other views follow: the slices in the patient, and the other plane of the same curve.
  const dvec3 inPatient = w.grid(sections).patientFromCurved(after);
  QVERIFY(glm::distance(w.crosshair(slices).at, inPatient) < 1e-9);
  QVERIFY(glm::distance(w.crosshair(stretched).at, w.grid(stretched).curvedFromPatient(inPatient)) < 1e-9);
  // In reverse, a position in the slices moves to the nearest one on the curve.
  wheel(w.view(slices), 1);
  const dvec3 moved = w.crosshair(slices).at;
  QVERIFY(glm::distance(moved, inPatient) > 1);
  QVERIFY(glm::distance(w.crosshair(sections).at, w.grid(sections).curvedFromPatient(moved)) < 1e-9);
  // Nothing follows if positions are not linked.
  w.session().change(QStringLiteral("Unlink"), withScrollLinked(w.workspace(), false));
  wheel(w.view(sections), -1);
  QVERIFY(w.crosshair(slices).at == moved);
}

void TestCurvedPlanes::anotherWidth() {
  const SessionFolder folder;
  CurveWindow w(folder);
  w.drawCurve(arch);
  QVERIFY(w.showCurve());
  QCOMPARE(w.loaded(sections)->volume->size().x, 25);  // 2 x 25 mm, in steps of 2 mm
  const std::size_t known = w.workspace().series.size();
  QVERIFY(w.showCurve("showCurvedPlane20"));
  QCOMPARE(w.loaded(sections)->volume->size().x, 11);
  QCOMPARE(w.workspace().series.size(), known);
}

void TestCurvedPlanes::undoneAndDoneAgain() {
  const SessionFolder folder;
  CurveWindow w(folder);
  w.drawCurve(arch);
  const Workspace before = w.workspace();
  const int steps = w.session().undoStack().index();
  QVERIFY(w.showCurve());
  QCOMPARE(w.session().undoStack().index(), steps + 1);
  const Workspace after = w.workspace();
  w.press("undo");
  QVERIFY(w.workspace() == before);
  w.press("redo");
  QVERIFY(w.workspace() == after);
  QVERIFY(QTest::qWaitFor([&] { return w.isShown(); }, longest));
}

// A volume that was not ready at the undo does not appear afterwards.
void TestCurvedPlanes::undoneWhileItIsMade() {
  const SessionFolder folder;
  CurveWindow w(folder);
  w.drawCurve(arch);
  const Workspace before = w.workspace();
  w.press("showCurvedPlane");
  QVERIFY2(w.window.document().loader.isBusy(), "it is made beside");
  w.press("undo");
  QVERIFY(QTest::qWaitFor([&] { return !w.window.document().loader.isBusy(); }, longest));
  QCoreApplication::processEvents();
  QVERIFY(w.workspace() == before);
}

void TestCurvedPlanes::aSessionBringsItBack() {
  const SessionFolder folder;
  CurveWindow w(folder);
  w.drawCurve(arch);
  QVERIFY(w.showCurve());
  wheel(w.view(sections), -2);
  w.session().select(0);  // stored in no session
  const Workspace saved = w.workspace();
  QVERIFY(folder.save(w));
  Journey another({folder.at("s.volumen")});
  Session& session = another.window.session();
  QVERIFY(
      QTest::qWaitFor([&] { return session.seriesOf(stretched) && session.seriesOf(sections); }, longest));
  QVERIFY(session.workspace() == saved);
  for (const ViewId id : {straightened, stretched, sections})
    QVERIFY(session.seriesOf(id)->volume->stored() == w.loaded(id)->volume->stored());
}

void TestCurvedPlanes::aChangedCurveIsSaid() {
  const SessionFolder folder;
  CurveWindow w(folder);
  w.drawCurve(arch);
  QVERIFY(w.showCurve());
  const std::size_t known = w.workspace().series.size();
  const SeriesKey first = keyOf(w.seriesAt(stretched));
  const auto isSaid = [&](ViewId id) {
    return w.view(id)->overlays().topRight.contains(QStringLiteral("of an earlier curve"));
  };
  QVERIFY(!isSaid(stretched) && !isSaid(sections));
  const DrawnMeasurement drawn = w.view(slices)->drawnMeasurements().front();
  QCOMPARE(drawn.handles.size(), arch.size());
  drag(w.view(slices), drawn.handles[2].at, drawn.handles[2].at + QPointF(0, 15));
  QVERIFY(isSaid(stretched) && isSaid(sections));
  w.press("undo");
  QVERIFY(!isSaid(stretched) && !isSaid(sections));
  w.press("redo");
  QVERIFY(w.showCurve());
  QVERIFY(!isSaid(stretched) && !isSaid(sections));
  QVERIFY(keyOf(w.seriesAt(stretched)) != first);
  QCOMPARE(w.workspace().series.size(), known);
}

void TestCurvedPlanes::whatCannotBeShownIsTold_data() {
  QTest::addColumn<int>("what");
  QTest::addColumn<QString>("says");
  QTest::newRow("no curve") << 0 << QStringLiteral("Draw a curve first");
  QTest::newRow("a curve on a curved plane") << 1 << QStringLiteral("draw it in the series itself");
  QTest::newRow("a curve shorter than a voxel") << 2 << QStringLiteral("shorter than a voxel");
  QTest::newRow("a curve outside the series") << 3 << QStringLiteral("outside the series");
}

void TestCurvedPlanes::whatCannotBeShownIsTold() {
  QFETCH(int, what);
  QFETCH(QString, says);
  const SessionFolder folder;
  CurveWindow w(folder);
  if (what == 1) {
    w.drawCurve(arch);
    QVERIFY(w.showCurve());
    w.drawCurve({{10, 0, 0}, {50, 0, 0}}, stretched);
    QVERIFY(w.curve().series == keyOf(w.seriesAt(stretched)));
  }
  const SeriesKey source = w.workspace().view(axialViewId).series;
  const dvec3 start = what == 3 ? dvec3(300, 0, 0) : dvec3(0);
  if (what >= 2)
    addMeasurement(
        w.session(), source,
        {ShapeKind::openCurve, "", {start, start + dvec3(what == 3 ? 30 : 0.5, 0, 0)}, {}, {}, {}});
  const Workspace before = w.workspace();
  w.press("showCurvedPlane");
  auto* banner = w.child<Banner>("banner");
  QTRY_VERIFY_WITH_TIMEOUT(banner->isVisible(), longest);
  QVERIFY2(banner->sentence().contains(says), qPrintable(banner->sentence()));
  if (what < 3) QVERIFY(w.workspace() == before);
}

VOLUMEN_TEST(TestCurvedPlanes);
#include "tst_curved_planes.moc"
