// Guards the line at which one view's plane crosses another view, at the edges of the picture. Random planes
// are compared with an implementation without cross products.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "ui/workspace/flat_plane.h"

using namespace volumen;
using volumen::tests::Chance;

namespace {

SlicePlane planeByChance(Chance& chance) {
  SlicePlane plane;
  plane.right = glm::normalize(chance.vector() + glm::dvec3(0, 0, 1e-9));
  plane.down = glm::normalize(glm::cross(plane.right, chance.vector() + glm::dvec3(1e-9, 0, 0)));
  plane.centre = 60.0 * chance.vector();
  plane.mmPerPixel = chance.power(-1, 0.5);
  plane.size = {20 + chance.below(400), 20 + chance.below(300)};
  return plane;
}

// Returns the signed distance (mm) of a pixel from the other plane.
double heightOver(const SlicePlane& view, const SlicePlane& other, glm::dvec2 pixel) {
  return glm::dot(view.patientFromPixel(pixel) - other.centre, other.normal());
}

// Independent implementation: that distance is linear along each edge of the picture and zero at the line.
std::vector<glm::dvec2> crossingsOfEdges(const SlicePlane& view, const SlicePlane& other) {
  const glm::dvec2 size(view.size);
  const std::array<glm::dvec2, 5> corners{{{0, 0}, {size.x, 0}, {size.x, size.y}, {0, size.y}, {0, 0}}};
  std::vector<glm::dvec2> crossings;
  for (std::size_t n = 0; n < 4; ++n) {
    const double a = heightOver(view, other, corners[n]), b = heightOver(view, other, corners[n + 1]);
    if ((a < 0) != (b < 0)) crossings.push_back(corners[n] + a / (a - b) * (corners[n + 1] - corners[n]));
  }
  return crossings;
}

}  // namespace

class TestReferenceSegments : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void agreeWithTheTwin_data();
  void agreeWithTheTwin();
  void parallelPlanesHaveNone();
  void lieWhereTheyShould_data();
  void lieWhereTheyShould();
  void areCarriedToAnotherFrame();
};

void TestReferenceSegments::agreeWithTheTwin_data() {
  QTest::addColumn<int>("seed");
  const tests::Seeds seeds = tests::seedsOf(20, 200);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) QTest::addRow("seed %d", seed) << seed;
}

// Tests fifty pairs a seed. The independent implementation divides by a difference of distances. For planes
// within 0.05 of parallel its error would exceed the bound.
void TestReferenceSegments::agreeWithTheTwin() {
  QFETCH(int, seed);
  Chance chance{std::uint64_t(seed)};
  int seen = 0;
  for (int n = 0; n < 50; ++n) {
    const SlicePlane view = planeByChance(chance), other = planeByChance(chance);
    if (glm::length(glm::cross(view.normal(), other.normal())) < 0.05) continue;
    const auto segment = referenceSegment(view, other);
    const std::vector<glm::dvec2> twin = crossingsOfEdges(view, other);
    QCOMPARE(segment.has_value(), twin.size() == 2);
    if (!segment) continue;
    ++seen;
    const double straight =
        std::max(glm::length(segment->from - twin[0]), glm::length(segment->to - twin[1]));
    const double turned = std::max(glm::length(segment->from - twin[1]), glm::length(segment->to - twin[0]));
    QVERIFY2(std::min(straight, turned) < 1e-6, "pixels, of pictures of some hundreds");
  }
  QVERIFY2(seen > 5, "they do meet");
}

void TestReferenceSegments::parallelPlanesHaveNone() {
  SlicePlane a, b;
  a.size = b.size = {100, 80};
  b.centre = {0, 0, 5};
  QVERIFY(!referenceSegment(a, a));
  QVERIFY(!referenceSegment(a, b));
}

void TestReferenceSegments::lieWhereTheyShould_data() {
  QTest::addColumn<double>("mm");
  QTest::addColumn<bool>("isSeen");
  QTest::newRow("in the middle") << 0.0 << true;
  QTest::newRow("near the right edge") << 49.0 << true;
  QTest::newRow("beyond it") << 51.0 << false;
  QTest::newRow("beyond the left one") << -51.0 << false;
}

// A sagittal plane crosses an axial picture of 100 x 80 pixels of 1 mm in a vertical line from edge to edge.
void TestReferenceSegments::lieWhereTheyShould() {
  QFETCH(double, mm);
  QFETCH(bool, isSeen);
  SlicePlane axial, sagittal;
  axial.size = {100, 80};
  sagittal.right = {0, 1, 0};
  sagittal.down = {0, 0, -1};
  sagittal.centre = {mm, 7, -3};
  const auto segment = referenceSegment(axial, sagittal);
  QCOMPARE(segment.has_value(), isSeen);
  if (!segment) return;
  QVERIFY(std::abs(segment->from.x - (50 + mm)) < 1e-9 && std::abs(segment->to.x - (50 + mm)) < 1e-9);
  QVERIFY(std::abs(std::abs(segment->from.y - segment->to.y) - 80) < 1e-9);
}

// Every point of a plane follows the transform between the frames of reference.
void TestReferenceSegments::areCarriedToAnotherFrame() {
  Chance chance(7);
  const SlicePlane turn = planeByChance(chance), plane = planeByChance(chance);
  const Rigid way{glm::dmat3(turn.right, turn.down, turn.normal()), {3, -20, 11}};
  const SlicePlane carried = carriedTo(way, plane);
  for (const glm::dvec2 pixel : {glm::dvec2(0, 0), glm::dvec2(37, 5), glm::dvec2(-4, 120)})
    QVERIFY(glm::length(carried.patientFromPixel(pixel) - way(plane.patientFromPixel(pixel))) < 1e-9);
}

VOLUMEN_TEST(TestReferenceSegments);
#include "tst_reference_segments.moc"
