// Guards slices.md 4 in the window: what is drawn in flat views by real mouse and key events, and the
// resulting numbers.
#include <QLineEdit>
#include <numbers>

#include "results/text/measured_text.h"
#include "tests/fixtures/grids.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"
#include "ui/workspace/camera_moves.h"

using namespace volumen;
using namespace volumen::tests;
using enum ShapeKind;

namespace {

// Returns a series with the value i on voxels of this grid, 40 along each edge.
LoadedSeriesPtr rampOn(const glm::dmat3& step) {
  return seriesOf(volumeOf<float>({40, 40, 40}, step, [](glm::dvec3 p) { return p.x; }));
}

}  // namespace

class TestMeasureTools : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyToolDrawsWhereTheHandIs_data();
  void everyToolDrawsWhereTheHandIs();
  void numbersAreClosedForms();
  void twoClicksMakeALine();
  void aDoubleClickEndsAPolyline();
  void escapeGivesUp_data();
  void escapeGivesUp();
  void shiftKeepsTheTool();
  void keysChooseTools_data();
  void keysChooseTools();
  void anArrowAsksForItsText();
  void withoutCalibrationPixelsAreSaid();
  void noVoxelInside();
  void largeRegionsAreMeasuredBeside();
};

void TestMeasureTools::everyToolDrawsWhereTheHandIs_data() {
  QTest::addColumn<int>("kind");
  QTest::addColumn<int>("grid");
  for (const ShapeKind kind : drawnKinds)
    for (int n = 0; n < int(std::size(grids)); ++n)
      QTest::addRow("%s, %s", ruleOf(kind).name, grids[n].name) << int(kind) << n;
}

// The shape's points are those of the pixels, to 1e-9 mm. Its numbers are those of viewer/measure. It is one
// undo step.
void TestMeasureTools::everyToolDrawsWhereTheHandIs() {
  QFETCH(int, kind);
  QFETCH(int, grid);
  MeasureWindow w(rampOn(grids[grid].patientFromVoxelStep));
  const int steps = w.session().undoStack().index();
  const std::vector<QPointF> places = placesOf(ShapeKind(kind));
  w.draw(ShapeKind(kind), places);
  QCOMPARE(w.all().size(), std::size_t(1));
  const Measurement m = w.last();
  QVERIFY(m.shape.kind == ShapeKind(kind));
  QVERIFY(checkShape(m.shape).ok());
  // An outline has another point where the button is released.
  QVERIFY(m.shape.points.size() >= places.size() && m.shape.points.size() <= places.size() + 2);
  for (const QPointF p : places) {
    double nearest = 1e9;
    for (const glm::dvec3 q : m.shape.points) nearest = std::min(nearest, glm::length(q - w.patient(p)));
    QVERIFY(nearest < 1e-9);
  }
  QCOMPARE(w.session().workspace().selected, m.id);
  QVERIFY2(!w.window.views()->tool().measuring, "the tool before is back");
  const DrawnMeasurement drawn = w.drawn(m.id);
  QVERIFY(drawn.whole && drawn.selected && !drawn.handles.empty());
  QCOMPARE(drawn.text, measuredLines(m.shape, w.measured(m)));
  QCOMPARE(w.session().undoStack().index(), steps + 1);
  w.undo();
  QVERIFY(w.all().empty());
}

void TestMeasureTools::numbersAreClosedForms() {
  MeasureWindow w;
  const double mm = w.view()->plane()->mmPerPixel;
  w.draw(length, {{50, 60}, {80, 100}});
  QVERIFY(std::abs(w.measured(w.last())->number - 50 * mm) < 1e-9);
  w.draw(angle, {{50, 100}, {100, 100}, {100, 40}});
  QVERIFY(std::abs(w.measured(w.last())->number - 90) < 1e-9);
  w.draw(cobb, {{40, 40}, {140, 40}, {40, 90}, {90, 140}});
  QVERIFY(std::abs(w.measured(w.last())->number - 45) < 1e-9);
  // Inside the ball of 1000 HU, 10 mm about (3, -2, 4). The slice is about 4 mm from its centre.
  const glm::dvec2 centre = w.view()->plane()->pixelFromPatient({3, -2, 4});
  const QPointF middle(std::round(centre.x), std::round(centre.y)),
      half(std::round(5 / mm), std::round(4 / mm));
  w.draw(ellipse, {middle - half, middle + half});
  const Measured ball = *w.measured(w.last());
  QVERIFY(std::abs(ball.number - std::numbers::pi * half.x() * half.y() * mm * mm) < 1e-9);
  QCOMPARE(ball.values->mean, 1000.0);
  QCOMPARE(ball.values->sd, 0.0);
  // The count of voxels of 1 mm^2 differs from the area by less than the circumference, because the edge cuts
  // voxels.
  QVERIFY(std::abs(double(ball.values->n) - ball.number) < 30);
  QVERIFY(w.drawn(w.last().id).text.contains(QStringLiteral("Mean 1000, SD 0 HU")));
  w.draw(probe, {middle});
  QCOMPARE(w.drawn(w.last().id).text, QStringList(QStringLiteral("1000 HU")));
}

void TestMeasureTools::twoClicksMakeALine() {
  MeasureWindow w;
  w.choose(length);
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, {50, 50});
  QVERIFY(w.all().empty());
  hover(w.view(), {90, 80});
  const std::vector<DrawnMeasurement> half = w.view()->drawnMeasurements();
  QCOMPARE(half.size(), std::size_t(1));
  QCOMPARE(half[0].lines[0].back(), QPointF(90, 80));
  QVERIFY2(half[0].text.value(0).endsWith(QStringLiteral("mm")), "its number follows the hand");
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, {100, 80});
  QCOMPARE(w.all().size(), std::size_t(1));
  QVERIFY(glm::length(w.last().shape.points[1] - w.patient({100, 80})) < 1e-9);
}

void TestMeasureTools::aDoubleClickEndsAPolyline() {
  MeasureWindow w;
  w.choose(polyline);
  for (const QPoint p : {QPoint(50, 50), QPoint(90, 60), QPoint(110, 120)})
    QTest::mouseClick(w.view(), Qt::LeftButton, {}, p);
  QTest::mouseDClick(w.view(), Qt::LeftButton, {}, {110, 120});
  QCOMPARE(w.all().size(), std::size_t(1));
  QCOMPARE(w.last().shape.points.size(), std::size_t(3));
  QVERIFY2(w.window.view()->isVisible(), "the view is not maximised by it");
}

void TestMeasureTools::escapeGivesUp_data() {
  QTest::addColumn<int>("kind");
  for (const ShapeKind kind : drawnKinds) QTest::newRow(ruleOf(kind).name) << int(kind);
}

void TestMeasureTools::escapeGivesUp() {
  QFETCH(int, kind);
  MeasureWindow w;
  const Workspace before = w.session().workspace();
  const int steps = w.session().undoStack().count();
  w.choose(ShapeKind(kind));
  QTest::mousePress(w.view(), Qt::LeftButton, {}, {50, 50});
  QTest::mouseEvent(QTest::MouseMove, w.view(), Qt::LeftButton, {}, {80, 70});
  QCOMPARE(w.view()->drawnMeasurements().size(), std::size_t(1));
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QVERIFY(w.view()->drawnMeasurements().empty());
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, {80, 70});
  QVERIFY(w.session().workspace() == before);
  QCOMPARE(w.session().undoStack().count(), steps);
  QVERIFY2(w.window.views()->tool().measuring, "for another try");
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QVERIFY(!w.window.views()->tool().measuring);
}

void TestMeasureTools::shiftKeepsTheTool() {
  MeasureWindow w;
  w.choose(length);
  QAction* action = w.child<QAction>("lengthTool");
  QVERIFY(action->isChecked());
  drawShape(w.view(), length, {{50, 50}, {90, 70}}, Qt::ShiftModifier);
  QVERIFY(action->isChecked());
  drawShape(w.view(coronalViewId), length, {{50, 90}, {90, 110}});
  QVERIFY(!action->isChecked());
  QCOMPARE(w.all().size(), std::size_t(2));
  action->trigger();
  action->trigger();
  QVERIFY2(!w.window.views()->tool().measuring, "chosen twice: off again");
}

void TestMeasureTools::keysChooseTools_data() {
  QTest::addColumn<int>("key");
  QTest::addColumn<QString>("tool");
  QTest::newRow("D") << int(Qt::Key_D) << QStringLiteral("length");
  QTest::newRow("A") << int(Qt::Key_A) << QStringLiteral("angle");
  QTest::newRow("E") << int(Qt::Key_E) << QStringLiteral("ellipse");
  QTest::newRow("P") << int(Qt::Key_P) << QStringLiteral("probe");
  QTest::newRow("T") << int(Qt::Key_T) << QStringLiteral("arrow");
  QTest::newRow("W") << int(Qt::Key_W) << QStringLiteral("window");
}

// The keys choose tools in a slice. In 3D the letters keep their meaning.
void TestMeasureTools::keysChooseTools() {
  QFETCH(int, key);
  QFETCH(QString, tool);
  MeasureWindow w;
  w.choose(cobb);
  const std::string seen = viewName(w.window.view()->camera());
  w.view()->setFocus();
  QTest::keyClick(w.view(), Qt::Key(key));
  QCOMPARE(QString::fromLatin1(w.window.views()->tool().name), tool);
  QCOMPARE(viewName(w.window.view()->camera()), seen);
  w.window.views()->setTool(toolNamed("window"));
  w.window.view()->setFocus();
  QTest::keyClick(w.window.view(), Qt::Key_P);
  QCOMPARE(viewName(w.window.view()->camera()), std::string("posterior"));
  QVERIFY(!w.window.views()->tool().measuring);
}

void TestMeasureTools::anArrowAsksForItsText() {
  MeasureWindow w;
  w.draw(arrow, {{70, 60}, {120, 100}});
  auto* field = w.view()->findChild<QLineEdit*>(QStringLiteral("measurementName"));
  QVERIFY(field && field->isVisible());
  QTest::keyClicks(field, QStringLiteral("Nodule, 3 mm?"));
  QTest::keyClick(field, Qt::Key_Return);
  QCOMPARE(w.last().shape.name, std::string("Nodule, 3 mm?"));
  QCOMPARE(w.drawn(w.last().id).text, QStringList(QStringLiteral("Nodule, 3 mm?")));
  w.undo();
  QCOMPARE(w.last().shape.name, std::string());
  // A double-click on a text edits it.
  w.redo();
  const QPointF text = w.drawn(w.last().id).textRect.center();
  QTest::mouseDClick(w.view(), Qt::LeftButton, {}, text.toPoint());
  for (QLineEdit* again : w.view()->findChildren<QLineEdit*>(QStringLiteral("measurementName"))) {
    if (!again->isVisible()) continue;
    again->setText(QStringLiteral("Node"));
    QTest::keyClick(again, Qt::Key_Return);
  }
  QCOMPARE(w.last().shape.name, std::string("Node"));
  w.draw(arrow, {{70, 160}, {120, 200}});
  for (QLineEdit* given : w.view()->findChildren<QLineEdit*>(QStringLiteral("measurementName"))) {
    if (!given->isVisible()) continue;
    given->setText(QStringLiteral("given up"));
    QTest::keyClick(given, Qt::Key_Escape);
    QVERIFY(!given->isVisible());
  }
  QCOMPARE(w.last().shape.name, std::string());
}

void TestMeasureTools::withoutCalibrationPixelsAreSaid() {
  VolumeParts parts;
  parts.geometry.size = {32, 32, 4};
  parts.geometry.calibrated = false;
  parts.values = std::vector<float>(32 * 32 * 4, 7);
  MeasureWindow w(seriesOf(volumeFrom(std::move(parts))));
  w.draw(length, {{50, 50}, {90, 80}});
  const QString text = w.drawn(w.last().id).text.value(0);
  QVERIFY2(text == shortNumberText(50 * w.view()->plane()->mmPerPixel) + QStringLiteral(" px"),
           qPrintable(text));
  w.draw(rectangle, {{60, 100}, {120, 150}});
  QVERIFY(w.drawn(w.last().id).text.value(0).endsWith(QStringLiteral(" px\u00b2")));
}

void TestMeasureTools::noVoxelInside() {
  MeasureWindow w(rampOn({4, 0, 0, 0, 4, 0, 0, 0, 4}));
  w.view()->resize(900, 900);  // large enough to draw a region between four voxels
  const glm::dvec2 between = w.view()->plane()->pixelFromPatient({0, 0, 0});
  const QPointF p(between.x, between.y);
  w.draw(rectangle, {p - QPointF(4, 4), p + QPointF(4, 4)});
  const QStringList text = w.drawn(w.last().id).text;
  QCOMPARE(text.size(), 2);
  QCOMPARE(text[1], QStringLiteral("no voxel inside"));
}

// During the drag nothing waits for numbers. In the end they are those of the final position.
void TestMeasureTools::largeRegionsAreMeasuredBeside() {
  MeasureWindow w(seriesOf(randomVolume<std::int16_t>({600, 600, 3}, -1000, 1000)));
  const QSize size = w.view()->size();
  w.choose(ellipse);
  QTest::mousePress(w.view(), Qt::LeftButton, {}, {10, 10});
  for (int n = 1; n <= 20; ++n)
    QTest::mouseEvent(QTest::MouseMove, w.view(), Qt::LeftButton, {},
                      {10 + (size.width() - 30) * n / 20, 10 + (size.height() - 30) * n / 20});
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, {size.width() - 20, size.height() - 20});
  const Result<Measured> wanted = w.measured(w.last());
  QVERIFY(wanted->values->n > 10000);
  QVERIFY2(w.drawn(w.last().id).text.isEmpty(), "not at once");
  QTRY_COMPARE_WITH_TIMEOUT(w.drawn(w.last().id).text, measuredLines(w.last().shape, wanted), longest);
}

VOLUMEN_TEST(TestMeasureTools);
#include "tst_measure_tools.moc"
