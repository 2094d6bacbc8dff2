// Guards slices.md 4: the numbers of each shape with their units, and the refusal of invalid shapes.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/fixtures/grids.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/measure/measure.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

class TestMeasure : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void numbersAndUnits_data();
  void numbersAndUnits();
  void curvesAreAsLongAsTheyAreSmooth();
  void regionsAreFreeOfNaN();
  void probesTheNearestVoxel_data();
  void probesTheNearestVoxel();
  void probeSaysPadding();
  void millilitresOnEveryGrid_data();
  void millilitresOnEveryGrid();
  void refused_data();
  void refused();
};

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Shape shapeOf(ShapeKind kind, std::vector<dvec3> points) {
  Shape shape;
  shape.kind = kind;
  shape.points = std::move(points);
  if (ruleOf(kind).region) shape.plane = ShapePlane();
  return shape;
}

/// Returns 11 x 11 x 11 voxels with value i, centred on the patient's origin. x in mm is i - 5.
VolumePtr ramp(bool calibrated = true) {
  VolumeParts parts;
  parts.geometry.size = {11, 11, 11};
  parts.geometry.origin = dvec3(-5);
  parts.geometry.calibrated = calibrated;
  std::vector<float> values(11 * 11 * 11);
  for (std::size_t n = 0; n < values.size(); ++n) values[n] = float(n % 11);
  parts.values = std::move(values);
  return volumeFrom(std::move(parts));
}

}  // namespace

void TestMeasure::numbersAndUnits_data() {
  QTest::addColumn<int>("kind");
  QTest::addColumn<std::vector<dvec3>>("points");
  QTest::addColumn<double>("number");
  QTest::addColumn<QString>("unit");
  QTest::addColumn<QString>("uncalibrated");
  const auto row = [](ShapeKind kind, std::vector<dvec3> points, double number, const char* unit,
                      const char* uncalibrated) {
    QTest::newRow(ruleOf(kind).name) << int(kind) << points << number << QString::fromLatin1(unit)
                                     << QString::fromLatin1(uncalibrated);
  };
  using enum ShapeKind;
  row(length, {{0, 0, 0}, {3, 4, 0}}, 5, "mm", "px");
  row(polyline, {{0, 0, 0}, {3, 4, 0}, {3, 4, 2}}, 7, "mm", "px");
  row(openCurve, {{0, 0, 0}, {3, 4, 0}}, 5, "mm", "px");
  row(angle, {{2, 0, 0}, {0, 0, 0}, {0, 3, 0}}, 90, "degrees", "degrees");
  row(cobb, {{0, 0, 0}, {1, 0, 0}, {5, 5, 0}, {4, 6, 0}}, 45, "degrees", "degrees");
  row(legAxis, {{0, 0, 4}, {0, 0, 0}, {3, 0, -3}}, 45, "degrees", "degrees");
  row(ellipse, {{-2, -1, 0}, {2, 1, 0}}, 2 * std::acos(-1.0), "mm^2", "px^2");
  row(rectangle, {{-2, -1, 0}, {2, 1, 0}}, 8, "mm^2", "px^2");
  row(freehand, {{-2, -1, 0}, {2, -1, 0}, {2, 1, 0}}, 4, "mm^2", "px^2");
  row(probe, {{1, 0, 0}}, 6, "HU", "HU");
}

void TestMeasure::numbersAndUnits() {
  QFETCH(int, kind);
  QFETCH(std::vector<dvec3>, points);
  QFETCH(double, number);
  QFETCH(QString, unit);
  QFETCH(QString, uncalibrated);
  const Shape shape = shapeOf(ShapeKind(kind), points);
  const Result<Measured> found = measure(shape, *ramp(), "HU");
  QVERIFY2(found.ok(), found.ok() ? "" : found.message().c_str());
  QVERIFY(std::abs(found->number - number) < 1e-12);
  QCOMPARE(QString::fromStdString(found->unit), unit);
  QCOMPARE(QString::fromStdString(found->valueUnit), QStringLiteral("HU"));
  QCOMPARE(QString::fromStdString(measure(shape, *ramp(false), "HU")->unit), uncalibrated);
  QCOMPARE(found->plusMinus.has_value(), unit == QLatin1String("mm"));
  QCOMPARE(found->values.has_value(), unit == QLatin1String("mm^2"));
  QCOMPARE(found->voxel.has_value(), unit == QLatin1String("HU"));
}

// A curve is longer than the polyline through its points. A quarter of a circle of 10 mm radius has its
// length to within 0.1 %.
void TestMeasure::curvesAreAsLongAsTheyAreSmooth() {
  std::vector<dvec3> quarter;
  for (int n = 0; n <= 6; ++n)
    quarter.emplace_back(10 * std::cos(n * std::acos(-1.0) / 12), 10 * std::sin(n * std::acos(-1.0) / 12), 4);
  const auto numberOf = [](ShapeKind kind, const std::vector<dvec3>& points) {
    return measure(shapeOf(kind, points), *ramp(), "HU")->number;
  };
  const double length = numberOf(ShapeKind::openCurve, quarter);
  QVERIFY(length > numberOf(ShapeKind::polyline, quarter));
  QVERIFY2(std::abs(length / (5 * std::acos(-1.0)) - 1) < 1e-3, qPrintable(QString::number(length)));
  QCOMPARE(numberOf(ShapeKind::openCurve, {{1, 2, 3}, {1, 2, 3}}), 0.0);
}

void TestMeasure::regionsAreFreeOfNaN() {
  for (const auto& points : {std::vector<dvec3>{{1, 1, 0}, {1, 1, 0}, {1, 1, 0}},
                             {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}},
                             {{-3, -3, 0}, {3, 3, 0}, {3, -3, 0}, {-3, 3, 0}}}) {
    const Result<Measured> found = measure(shapeOf(ShapeKind::freehand, points), *ramp(), "");
    QVERIFY(found.ok() && std::isfinite(found->number));
    if (found->values) QVERIFY(std::isfinite(found->values->mean) && std::isfinite(found->values->sd));
  }
}

void TestMeasure::probesTheNearestVoxel_data() {
  QTest::addColumn<dvec3>("point");
  QTest::addColumn<glm::ivec3>("index");
  QTest::newRow("a centre") << dvec3(-2, 3, 0) << glm::ivec3(3, 8, 5);
  QTest::newRow("near one") << dvec3(-1.6, 2.6, 0.4) << glm::ivec3(3, 8, 5);
  QTest::newRow("halfway: upwards") << dvec3(-1.5, 2.5, 0.5) << glm::ivec3(4, 8, 6);
  QTest::newRow("the box's border") << dvec3(-5.5, 5.5, 5.5) << glm::ivec3(0, 10, 10);
}

void TestMeasure::probesTheNearestVoxel() {
  QFETCH(dvec3, point);
  QFETCH(glm::ivec3, index);
  const Result<Measured> found = measure(shapeOf(ShapeKind::probe, {point}), *ramp(), "HU");
  QVERIFY(found->voxel->index == index);
  QVERIFY(found->voxel->centre == dvec3(index) - 5.0);
  QCOMPARE(found->number, double(index.x));
}

void TestMeasure::probeSaysPadding() {
  VolumeParts parts;
  parts.geometry.size = {2, 1, 1};
  parts.values = std::vector<std::int16_t>{-2000, 10};
  parts.attributes.padding = ValueRange{-2000, -2000};
  const VolumePtr volume = volumeFrom(std::move(parts));
  QVERIFY(measure(shapeOf(ShapeKind::probe, {{0, 0, 0}}), *volume, "HU")->voxel->padding);
  QVERIFY(!measure(shapeOf(ShapeKind::probe, {{1, 0, 0}}), *volume, "HU")->voxel->padding);
}

void TestMeasure::millilitresOnEveryGrid_data() {
  QTest::addColumn<glm::dmat3>("step");
  QTest::addColumn<double>("mm3");
  // Volumes of one voxel of each grid, in mm^3, calculated by hand.
  const double cells[] = {1, 0.5 * 0.8 * 2.5, 2, 0.7 * 0.7 * 2, 1.1 * 0.9 * 1.5};
  for (int n = 0; n < 5; ++n) QTest::newRow(grids[n].name) << grids[n].patientFromVoxelStep << cells[n];
}

void TestMeasure::millilitresOnEveryGrid() {
  QFETCH(glm::dmat3, step);
  QFETCH(double, mm3);
  const VolumePtr volume = volumeOf<float>({10, 5, 4}, step, [](dvec3 p) { return p.x; });
  Shape shape = shapeOf(ShapeKind::volume, {});
  shape.range = {2.5, 6.75};
  const Result<Measured> found = measure(shape, *volume, "HU");
  QCOMPARE(QString::fromStdString(found->unit), QStringLiteral("ml"));
  QCOMPARE(found->segment->voxels, std::int64_t(4 * 20));
  QVERIFY(std::abs(found->number - 4 * 20 * mm3 / 1000) < 1e-12);
  QVERIFY(std::abs(*found->drawn - 4.25 * 20 * mm3 / 1000) < 1e-3 * *found->drawn);
}

void TestMeasure::refused_data() {
  QTest::addColumn<Shape>("shape");
  QTest::addColumn<QString>("sentence");
  const auto row = [](const char* name, const Shape& shape, const char* sentence) {
    QTest::newRow(name) << shape << QString::fromLatin1(sentence);
  };
  const auto on = [](ShapePlane plane) {
    Shape shape = shapeOf(ShapeKind::rectangle, {{0, 0, 0}, {1, 1, 0}});
    shape.plane = plane;
    return shape;
  };
  using enum ShapeKind;
  row("a length without points", shapeOf(length, {}), "points must hold 2 for kind \"length\"");
  row("a length of three", shapeOf(length, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), "not 3.");
  row("a polyline of one", shapeOf(polyline, {{0, 0, 0}}), "2 to 2000");
  row("a freehand of two", shapeOf(freehand, {{0, 0, 0}, {1, 0, 0}}), "3 to 2000");
  row("no number", shapeOf(probe, {{0, std::nan(""), 0}}), "points[0] must be within 1e9 mm");
  row("infinite", shapeOf(length, {{0, 0, 0}, {infinity, 0, 0}}), "points[1]");
  row("an arm of no length", shapeOf(angle, {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}), "no angle");
  row("a line of no length", shapeOf(cobb, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 0}}), "no angle");
  row("a probe outside", shapeOf(probe, {{5.6, 0, 0}}), "outside the volume");
  Shape noPlane = shapeOf(ellipse, {{0, 0, 0}, {1, 1, 0}});
  noPlane.plane.reset();
  row("no plane", noPlane, "plane is missing");
  row("right is no unit vector", on({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}), "plane.right must be a unit vector");
  row("down is no unit vector", on({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}), "plane.down must be a unit vector");
  row("no right angle", on({{0, 0, 0}, {1, 0, 0}, {0.6, 0.8, 0}}), "at right angles");
  row("a centre that is no number", on({{0, 0, std::nan("")}, {1, 0, 0}, {0, 1, 0}}), "plane.centre");
  row("off the plane", shapeOf(rectangle, {{0, 0, 0}, {1, 1, 0.6}}), "points[1] lies off the plane");
  Shape upsideDown = shapeOf(ShapeKind::volume, {});
  upsideDown.range = {3, 2};
  row("range upside down", upsideDown, "range must be [low, high]");
  upsideDown.range = {std::nan(""), 2};
  row("range of no number", upsideDown, "range must be [low, high]");
}

void TestMeasure::refused() {
  QFETCH(Shape, shape);
  QFETCH(QString, sentence);
  const Result<Measured> found = measure(shape, *ramp(), "HU");
  QVERIFY(!found.ok());
  QVERIFY2(QString::fromStdString(found.message()).contains(sentence), found.message().c_str());
}

VOLUMEN_TEST(TestMeasure);
#include "tst_measure.moc"
