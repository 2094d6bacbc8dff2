// Guards the drawing of shapes in flat views: whole on their own slice, as a cut in every other plane.
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/measure/outline.h"
#include "viewer/measure/shape_cut.h"

using namespace volumen;
using glm::dvec3;

namespace {

SlicePlane axialAt(double z) { return {.centre = {7, -3, z}}; }
SlicePlane sagittalAt(double x) { return {.centre = {x, 1, 2}, .right = {0, 1, 0}, .down = {0, 0, -1}}; }

Shape shapeOf(ShapeKind kind, std::vector<dvec3> points) {
  Shape shape{kind, "", std::move(points), {}, {}, {}};
  if (ruleOf(kind).region) shape.plane = ShapePlane{shape.points[0], {1, 0, 0}, {0, 1, 0}};
  return shape;
}

}  // namespace

class TestShapeCut : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void seenOnItsSlice_data();
  void seenOnItsSlice();
  void goesAsFarAsItIsDrawn_data();
  void goesAsFarAsItIsDrawn();
  void cutByAnotherPlane_data();
  void cutByAnotherPlane();
  void anEllipsesEdge();
  void aThickSlabShowsMore();
  void aCurveIsSmoothInEveryPlane();
};

void TestShapeCut::seenOnItsSlice_data() {
  QTest::addColumn<double>("z");
  QTest::addColumn<bool>("seen");
  QTest::newRow("on it") << 4.0 << true;
  QTest::newRow("a little above") << 4.9 << true;
  QTest::newRow("a little below") << 3.1 << true;
  QTest::newRow("halfway above: this one") << 5.0 << true;
  QTest::newRow("halfway below: the other one") << 3.0 << false;
  QTest::newRow("on the next slice") << 6.0 << false;
}

// Slices are 2 mm apart. Each kind lies at z = 4.
void TestShapeCut::seenOnItsSlice() {
  QFETCH(double, z);
  QFETCH(bool, seen);
  const std::vector<dvec3> places{{0, 0, 4}, {3, 1, 4}, {5, 5, 4}, {-2, 4, 4}};
  for (const ShapeRule& rule : shapeRules()) {
    if (rule.kind == ShapeKind::volume) continue;
    const Shape shape = shapeOf(rule.kind, {places.begin(), places.begin() + long(rule.fewest)});
    const ShapeCut cut = cutOf(shape, axialAt(z), 1);
    QVERIFY2(cut.whole == seen, rule.name);
    QVERIFY2(cut.lines.empty() != seen, rule.name);
    QCOMPARE(cut.lines.size(), std::size_t(!seen ? 0 : rule.twoLines ? 2 : 1));
  }
}

void TestShapeCut::goesAsFarAsItIsDrawn_data() {
  QTest::addColumn<int>("kind");
  QTest::addColumn<int>("count");
  for (const ShapeRule& rule : shapeRules())
    for (std::size_t n = 1; n <= rule.fewest; ++n)
      QTest::addRow("%s, %zu of %zu", rule.name, n, rule.fewest) << int(rule.kind) << int(n);
}

// While a shape is being drawn, it has fewer points than its rule requires.
void TestShapeCut::goesAsFarAsItIsDrawn() {
  QFETCH(int, kind);
  QFETCH(int, count);
  const std::vector<dvec3> places{{1, 2, 4}, {5, 2, 4}, {5, 6, 4}, {7, 7, 4}};
  const Shape shape = shapeOf(ShapeKind(kind), {places.begin(), places.begin() + count});
  const ShapeCut cut = cutOf(shape, axialAt(4), 1);
  QVERIFY(cut.whole);
  if (ruleOf(shape.kind).region) return;
  std::vector<dvec3> drawn;
  for (const std::vector<dvec3>& line : cut.lines) drawn.insert(drawn.end(), line.begin(), line.end());
  QVERIFY(drawn == shape.points);
  QCOMPARE(cut.lines.size(), std::size_t(ruleOf(shape.kind).twoLines && count > 2 ? 2 : 1));
}

void TestShapeCut::cutByAnotherPlane_data() {
  QTest::addColumn<Shape>("shape");
  QTest::addColumn<std::vector<dvec3>>("ends");  // both ends of each line
  using enum ShapeKind;
  const auto row = [](const char* name, const Shape& shape, std::vector<dvec3> ends) {
    QTest::newRow(name) << shape << ends;
  };
  const double half = 0.25, chord = std::sqrt(3.0) / 2;
  row("rectangle", shapeOf(rectangle, {{-1, -2, 4}, {3, 5, 4}}), {{0.5, -2, 4}, {0.5, 5, 4}});
  row("rectangle beside it", shapeOf(rectangle, {{1, -2, 4}, {3, 5, 4}}), {});
  row("freehand with two arms",
      shapeOf(freehand,
              {{0, 0, 4}, {1, 0, 4}, {1, 1, 4}, {0.2, 1, 4}, {0.2, 3, 4}, {1, 3, 4}, {1, 4, 4}, {0, 4, 4}}),
      {{0.5, 0, 4}, {0.5, 1, 4}, {0.5, 3, 4}, {0.5, 4, 4}});
  row("ellipse", shapeOf(ellipse, {{0, -1, 4}, {2, 1, 4}}), {{0.5, -chord, 4}, {0.5, chord, 4}});
  row("length across", shapeOf(length, {{-2, 0, 4}, {2, 0, 4}}), {{0.5 - half, 0, 4}, {0.5 + half, 0, 4}});
  row("length that ends in it", shapeOf(length, {{-2, 0, 4}, {0.5, 0, 4}}),
      {{0.5 - half, 0, 4}, {0.5, 0, 4}});
  row("length beside it", shapeOf(length, {{-2, 0, 4}, {-1, 0, 4}}), {});
  row("one arm of an angle", shapeOf(angle, {{0.5, 3, 4}, {0.5, 0, 4}, {4, 0, 4}}),
      {{0.5, 3, 4}, {0.5, 0, 4}, {0.5, 0, 4}, {0.5 + half, 0, 4}});
  row("probe beside it", shapeOf(probe, {{0, 0, 4}}), {});
}

// Cuts at the plane x = 0.5 with half a millimetre of thickness.
void TestShapeCut::cutByAnotherPlane() {
  QFETCH(Shape, shape);
  QFETCH(std::vector<dvec3>, ends);
  const ShapeCut cut = cutOf(shape, sagittalAt(0.5), 0.25);
  QVERIFY(!cut.whole);
  QCOMPARE(cut.lines.size(), ends.size() / 2);
  // Chords between the ellipse's corners end inside it by 1 - cos(1 degree) at most. Lines of the slab are
  // exact up to rounding.
  const double within = shape.kind == ShapeKind::ellipse ? 4e-4 : 1e-6;
  for (std::size_t n = 0; n < cut.lines.size(); ++n) {
    const dvec3 a = cut.lines[n].front(), b = cut.lines[n].back();
    const double direct = std::max(glm::length(a - ends[2 * n]), glm::length(b - ends[2 * n + 1]));
    const double turned = std::max(glm::length(b - ends[2 * n]), glm::length(a - ends[2 * n + 1]));
    const std::size_t other = ends.size() / 2 - 1 - n;
    const double reversed = std::max(glm::length(b - ends[2 * other]), glm::length(a - ends[2 * other + 1]));
    QVERIFY(std::min({direct, turned, reversed}) < within);
  }
}

void TestShapeCut::anEllipsesEdge() {
  const Shape ellipse = shapeOf(ShapeKind::ellipse, {{-3, 2, 4}, {5, 8, 4}});
  const std::vector<dvec3> edge = edgeOf(ellipse);
  QCOMPARE(int(edge.size()), ellipseCorners);
  for (const dvec3 p : edge) {
    const glm::dvec2 from((p.x - 1) / 4, (p.y - 5) / 3);
    QVERIFY(std::abs(glm::length(from) - 1) < 1e-12 && p.z == 4);
  }
  QVERIFY(glm::length(middleOf(ellipse) - dvec3(1, 5, 4)) < 1e-12);
  QVERIFY(glm::length(middleOf(shapeOf(ShapeKind::length, {{0, 0, 0}, {2, 4, 6}})) - dvec3(1, 2, 3)) < 1e-12);
}

void TestShapeCut::aThickSlabShowsMore() {
  VoxelGeometry geometry;
  geometry.size = {9, 9, 9};
  geometry.patientFromVoxelStep[2] *= 3.0;
  SlicePlane plane = axialAt(0);
  QCOMPARE(seenWithin(plane, geometry), 1.5);
  plane.slabMm = 10;
  QCOMPARE(seenWithin(plane, geometry), 5.0);
  QCOMPARE(seenWithin(sagittalAt(0), geometry), 0.5);
}

// In its own plane the curve is drawn whole and finely divided. In another plane each crossing is one line.
void TestShapeCut::aCurveIsSmoothInEveryPlane() {
  const Shape flat = shapeOf(ShapeKind::openCurve, {{0, 0, 4}, {5, 5, 4}, {10, 0, 4}});
  const ShapeCut whole = cutOf(flat, axialAt(4), 1);
  QVERIFY(whole.whole);
  QCOMPARE(whole.lines.size(), std::size_t(1));
  QVERIFY(whole.lines[0].size() > 20);
  QVERIFY(whole.lines[0].front() == flat.points.front());
  QVERIFY(glm::distance(whole.lines[0].back(), flat.points.back()) < 1e-9);
  // The arch passes up through the plane and down again, 8 mm apart.
  const Shape arch =
      shapeOf(ShapeKind::openCurve, {{-6, 0, -12}, {-4, 0, 0}, {0, 0, 9}, {4, 0, 0}, {6, 0, -12}});
  const ShapeCut cut = cutOf(arch, axialAt(0), 1);
  QVERIFY(!cut.whole);
  QCOMPARE(cut.lines.size(), std::size_t(2));
  for (const std::vector<dvec3>& line : cut.lines)
    for (const dvec3 p : line) QVERIFY(std::abs(p.z) < 1 + 1e-5 && std::abs(std::abs(p.x) - 4) < 1);
}

VOLUMEN_TEST(TestShapeCut);
#include "tst_shape_cut.moc"
