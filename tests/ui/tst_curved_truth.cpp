// Guards that curved planes state only what is true of the patient: lengths, values and masking. No curved
// plane outlives its series or is exported as a segment.
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QRegularExpression>
#include <QSignalSpy>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tests/ui/curve_window.h"
#include "tests/unit/suite.h"
#include "ui/widgets/plain_text.h"
#include "viewer/segment/range.h"

using namespace volumen;
using namespace volumen::tests;
using namespace volumen::tests::curved;
using glm::dvec3;

class TestCurvedTruth : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void lengthsAlongItAreTrue_data();
  void lengthsAlongItAreTrue();
  void anotherWidthOfALine();
  void fromAMaximisedView();
  void whatWasTakenAwayIsSaid();
  void outsideTheSeriesThereIsNoValue();
  void itGoesWithItsSeriesUnlessMeasuredOn();
  void nothingIsSegmentedOnIt();
};

void TestCurvedTruth::lengthsAlongItAreTrue_data() {
  QTest::addColumn<bool>("leavesItsPlane");
  QTest::addColumn<bool>("fromTheLeft");
  QTest::newRow("in a plane") << false << false;
  QTest::newRow("out of its plane") << true << false;
  QTest::newRow("out of its plane, drawn from left to right") << true << true;
}

// The drawn curve is as long in the stretched plane as in the patient. Both planes give a position by its
// length from the patient's right. The bounds are a pixel at either end, the chords of 4 mm between clicks,
// the last digit, and the 2 mm between cross-sections.
void TestCurvedTruth::lengthsAlongItAreTrue() {
  QFETCH(bool, leavesItsPlane);
  QFETCH(bool, fromTheLeft);
  std::vector<dvec3> points = arch;
  if (leavesItsPlane) points[1].z += 9, points[2].z -= 9, points[3].z += 9;
  const SmoothCurve curve = *SmoothCurve::through(points);
  if (fromTheLeft) std::ranges::reverse(points);
  const SessionFolder folder;
  CurveWindow w(folder);
  addMeasurement(w.session(), w.workspace().view(axialViewId).series,
                 {ShapeKind::openCurve, "", points, {}, {}, {}});
  QVERIFY(w.showCurve());
  const CurvedGrid grid = w.grid(stretched);
  w.press("polylineTool");
  for (double s = 10; s < 51; s += 4) w.click(stretched, grid.curvedFromPatient(curve.at(s)));
  QTest::keyClick(w.view(stretched), Qt::Key_Return);
  const Measurement m = w.curve();
  QVERIFY(m.shape.kind == ShapeKind::polyline && m.series == keyOf(w.seriesAt(stretched)));
  const double mm = measure(m.shape, *w.loaded(stretched)->volume, "HU")->number;
  QVERIFY2(std::abs(mm - 40) < 2 * w.view(stretched)->plane()->mmPerPixel + 0.8,
           qPrintable(QString::number(mm)));
  // Scrolls along the curve.
  const auto told = [&](ViewId id) {
    static const QRegularExpression number(QStringLiteral("([0-9.,]+) mm along the curve"));
    const auto found = number.match(w.view(id)->overlays().topRight.join(QLatin1Char('\n')));
    return found.hasMatch() ? QLocale().toDouble(found.captured(1)) : -1;
  };
  w.session().change(QStringLiteral("Show plane"),
                     withKind(w.workspace(), stretched, ViewKind::sagittal, {}));
  wheel(w.view(sections), -8);
  const double number = told(sections);
  QVERIFY2(number > 10, qPrintable(QString::number(number)));
  QVERIFY(glm::distance(w.crosshair(slices).at, curve.at(number)) < 0.1);
  QVERIFY2(std::abs(told(stretched) - number) < 0.5, qPrintable(QString::number(told(stretched))));
  const double x = w.crosshair(stretched).at.x;
  QVERIFY(leavesItsPlane ? number - x > 2 : std::abs(number - x) < 0.5);
}

// A line keeps the direction of the slices in which it was drawn, even if cross-sections are in focus by
// then.
void TestCurvedTruth::anotherWidthOfALine() {
  const SessionFolder folder;
  CurveWindow w(folder);
  w.session().setFocus(coronalViewId);
  w.drawCurve({{-20, 0, 4}, {20, 0, 4}}, coronalViewId);
  QCOMPARE(w.curve().shape.points.size(), std::size_t(2));
  const auto direction = [&] { return w.seriesAt(stretched).curved->recipe.ruled; };
  QVERIFY(w.showCurve());
  QVERIFY2(std::abs(std::abs(direction().y) - 1) < 1e-6, qPrintable(QString::number(direction().y)));
  QCOMPARE(w.workspace().focus, sections);
  const dvec3 before = direction();
  QVERIFY(w.showCurve("showCurvedPlane20"));
  QCOMPARE(w.loaded(sections)->volume->size().x, 11);
  QVERIFY(glm::distance(direction(), before) < 1e-9);
}

void TestCurvedTruth::fromAMaximisedView() {
  const SessionFolder folder;
  CurveWindow w(folder);
  w.drawCurve(arch);
  QVERIFY(w.showCurve());
  w.session().setFocus(slices);
  w.press("maximise");
  QVERIFY(w.child<QAction>("maximise")->isChecked());
  QTRY_VERIFY_WITH_TIMEOUT(w.view(slices)->isVisible() && !w.view(sections)->isVisible(), longest);
  QVERIFY(w.showCurve("showCurvedPlane20"));
  QVERIFY(!w.child<QAction>("maximise")->isChecked());
  for (const ViewId id : {slices, straightened, stretched, sections})
    QTRY_VERIFY_WITH_TIMEOUT(w.view(id)->isVisible(), longest);
}

// Removed tissue is present along the curve, because the volume is laid out as it was read.
void TestCurvedTruth::whatWasTakenAwayIsSaid() {
  const SessionFolder folder;
  CurveWindow w(folder);
  w.drawCurve(arch);
  QVERIFY(w.showCurve());
  const auto isSaid = [&](ViewId id) {
    return w.view(id)->overlays().topRight.contains(QStringLiteral("with what was taken away"));
  };
  QVERIFY(!isSaid(stretched) && !isSaid(sections));
  const VolumePtr volume = w.loaded(stretched)->volume;
  w.press("removeTable");
  QTRY_VERIFY_WITH_TIMEOUT(isSaid(stretched) && isSaid(sections), longest);
  QVERIFY(!isSaid(slices));
  QVERIFY(w.loaded(stretched)->volume == volume);
  w.press("undo");
  QVERIFY(!isSaid(stretched) && !isSaid(sections));
}

// A cross-section of 100 mm is higher than the volume of 48 mm. Beyond the volume the status line has no
// value.
void TestCurvedTruth::outsideTheSeriesThereIsNoValue() {
  const SessionFolder folder;
  CurveWindow w(folder);
  w.drawCurve({{-24, 0, 0}, {24, 0, 0}});
  QVERIFY(w.showCurve("showCurvedPlane100"));
  const VoxelGeometry& g = w.loaded(sections)->volume->geometry();
  const dvec3 voxel = glm::round(g.voxelFromPatient(w.crosshair(sections).at));
  FlatView* view = w.view(sections);
  QSignalSpy hovered(view, &View::hovered);
  const auto textAt = [&](double i, double j) {
    hover(view, w.pixel(sections, g.patientFromVoxel({i, j, voxel.z})));
    return hovered.isEmpty() ? QString() : hovered.last().value(0).toString();
  };
  const QString outside = QStringLiteral("outside the series");
  QVERIFY2(textAt(2, 2).startsWith(outside), qPrintable(textAt(2, 2)));
  QVERIFY2(textAt(2, g.size.y - 3).startsWith(outside), qPrintable(textAt(2, g.size.y - 3)));
  const QString inside = textAt(g.size.x / 2, g.size.y / 2);
  QVERIFY2(!inside.isEmpty() && !inside.contains(outside), qPrintable(inside));
}

void TestCurvedTruth::itGoesWithItsSeriesUnlessMeasuredOn() {
  const SessionFolder folder;
  CurveWindow w(folder);
  w.drawCurve(arch);
  QVERIFY(w.showCurve());
  const SeriesKey source = w.curve().series;
  const Workspace all = w.workspace();
  w.session().close({source});
  QVERIFY(w.workspace().series.empty());
  for (const ViewId id : {slices, straightened, stretched, sections})
    QVERIFY(w.workspace().view(id).series.empty());
  w.press("undo");
  QVERIFY(w.workspace().series == all.series);
  QVERIFY(QTest::qWaitFor([&] { return w.isShown(); }, longest));
  // A curved plane with a measurement stays.
  const VolumePtr volume = w.loaded(stretched)->volume;
  addMeasurement(w.session(), keyOf(w.seriesAt(stretched)), {ShapeKind::probe, "", {{20, 0, 0}}, {}, {}, {}});
  w.session().close({source});
  QCoreApplication::processEvents();
  QCOMPARE(w.workspace().series.size(), std::size_t(1));
  QVERIFY(w.workspace().view(slices).series.empty() && w.workspace().view(sections).series.empty());
  QVERIFY(w.loaded(stretched) && w.loaded(stretched)->volume == volume);
  const QString corner = w.view(stretched)->overlays().topRight.join(QLatin1Char('\n'));
  QVERIFY2(!corner.contains(QStringLiteral("earlier")), qPrintable(corner));
  // This also holds in a session, which stores the location of its series.
  const Workspace saved = w.workspace();
  QVERIFY(folder.save(w));
  Journey another({folder.at("s.volumen")});
  Session& session = another.window.session();
  QVERIFY(QTest::qWaitFor([&] { return session.seriesOf(stretched) != nullptr; }, longest));
  QVERIFY(session.workspace().series == saved.series);
  QVERIFY(session.seriesOf(stretched)->volume->stored() == volume->stored());
}

// A segment would be saved at wrong patient positions and measured in wrong millilitres.
void TestCurvedTruth::nothingIsSegmentedOnIt() {
  const SessionFolder folder;
  CurveWindow w(folder);
  const auto *segment = w.child<QPushButton>("segment"), *save = w.child<QPushButton>("segmentSave");
  const auto* result = w.child<QLabel>("segmentResult");
  QVERIFY(segment->isEnabled() && result->text().isEmpty());
  w.drawCurve(arch);
  QVERIFY(w.showCurve());
  w.session().setFocus(stretched);
  w.session().showAs(stretched, ViewKind::volume);
  QVERIFY(w.session().series()->series == w.seriesAt(stretched));
  QVERIFY(!segment->isEnabled() && !save->isEnabled());
  QVERIFY2(segment->toolTip().contains(QStringLiteral("segment the series that the curve was drawn in")),
           qPrintable(segment->toolTip()));
  QCOMPARE(segment->toolTip(), toolTipOf(result->text()));
  // This also holds if an earlier session has such a segment.
  const Volume& volume = *w.loaded(stretched)->volume;
  const auto labels = std::make_shared<const LabelMap>(
      withLabel(LabelMap(volume.geometry()), 1, voxelsInRange(volume, {0, 100})));
  const SegmentMap map{
      keyOf(w.seriesAt(stretched)), {{.number = 1, .range = ValueRange{0, 100}}}, labels, {}};
  w.session().change(QStringLiteral("test"), withSegmentMap(w.workspace(), map));
  QVERIFY(!save->isEnabled());
  w.session().setFocus(slices);
  w.session().showAs(slices, ViewKind::volume);
  QVERIFY(segment->isEnabled() && segment->toolTip().isEmpty() && result->text().isEmpty());
}

VOLUMEN_TEST(TestCurvedTruth);
#include "tst_curved_truth.moc"
