// Guards in_plane.h: the diameters of a segment in one slice, against an implementation that tries all lines,
// and closed forms on every grid.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/fixtures/grids.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/segment/field_masks.h"
#include "tests/unit/segment/shape_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/in_plane.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3, glm::ivec3;

class TestInPlane : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void rectangles_data();
  void rectangles();
  void ellipsoids_data();
  void ellipsoids();
  void ofAnyMaskAsByTryingAll();
  void ofOneComponent();
  void noneOfNothing();
};

namespace {

using Line = InPlaneDiameters::Line;

// Returns the border between inside and outside pixels of a slice in voxels: the line pieces in each cell of
// four pixels.
std::vector<std::array<dvec3, 2>> outlineOf(const BitMask& mask, int k) {
  const auto isIn = [&](int i, int j) {
    return i >= 0 && j >= 0 && i < mask.size().x && j < mask.size().y && mask.at({i, j, k});
  };
  std::vector<std::array<dvec3, 2>> pieces;
  for (int j = -1; j < mask.size().y; ++j)
    for (int i = -1; i < mask.size().x; ++i) {
      // Each run of inside corners around the cell gives one piece.
      const std::array corners{ivec3(i, j, k), ivec3(i + 1, j, k), ivec3(i + 1, j + 1, k),
                               ivec3(i, j + 1, k)};
      const auto inside = [&](std::size_t n) { return isIn(corners[n % 4].x, corners[n % 4].y); };
      const auto between = [&](std::size_t n) { return dvec3(corners[n % 4] + corners[(n + 1) % 4]) / 2.0; };
      for (std::size_t n = 0; n < 4; ++n) {
        if (inside(n) || !inside(n + 1)) continue;
        std::size_t last = n + 1;
        while (inside(last + 1)) ++last;
        pieces.push_back({between(n), between(last)});
      }
    }
  return pieces;
}

double longestOf(const BitMask& mask, int k) {
  double longest = -1;
  const auto pieces = outlineOf(mask, k);
  for (const auto& a : pieces)
    for (const auto& b : pieces)
      longest = std::max(longest, glm::length(mask.geometry().patientFromVoxelStep * (b[1] - a[0])));
  return longest;
}

// Returns the longest line in direction `across` in the slice (mm). At each corner of the outline it spans
// all pieces that the line meets.
double longestAcross(const BitMask& mask, int k, dvec3 along, dvec3 across) {
  const glm::dmat3 step = mask.geometry().patientFromVoxelStep;
  double longest = 0;
  const auto pieces = outlineOf(mask, k);
  for (const auto& corner : pieces)
    for (const dvec3& end : corner) {
      const double at = glm::dot(step * end, along);
      double low = HUGE_VAL, high = -HUGE_VAL;
      for (const auto& piece : pieces) {
        const double a = glm::dot(step * piece[0], along) - at, b = glm::dot(step * piece[1], along) - at;
        if (std::min(a, b) > 1e-9 || std::max(a, b) < -1e-9) continue;
        for (const double share : {a / (a - b), a / (a - b)}) {
          const double t = std::abs(a - b) < 1e-12 ? 0 : std::clamp(share, 0.0, 1.0);
          const double y = glm::dot(step * glm::mix(piece[0], piece[1], t), across);
          low = std::min(low, y), high = std::max(high, y);
        }
        if (std::abs(a - b) < 1e-12) {
          const double y = glm::dot(step * piece[1], across);
          low = std::min(low, y), high = std::max(high, y);
        }
      }
      longest = std::max(longest, high - low);
    }
  return longest;
}

// Returns the connected components of a slice: pixels that share an edge, found one neighbour after another.
std::vector<BitMask> componentsOf(const BitMask& mask, int k) {
  std::vector<BitMask> components;
  BitMask left = mask;
  for (int j = 0; j < mask.size().y; ++j)
    for (int i = 0; i < mask.size().x; ++i) {
      if (!left.at({i, j, k})) continue;
      BitMask& one = components.emplace_back(mask.geometry());
      std::vector<ivec3> next{{i, j, k}};
      while (!next.empty()) {
        const ivec3 v = next.back();
        next.pop_back();
        const bool isInside = v.x >= 0 && v.y >= 0 && v.x < mask.size().x && v.y < mask.size().y;
        if (!isInside || !left.at(v)) continue;
        left.set(v, false), one.set(v);
        for (const ivec3 step : {ivec3(1, 0, 0), ivec3(-1, 0, 0), ivec3(0, 1, 0), ivec3(0, -1, 0)})
          next.push_back(v + step);
      }
    }
  return components;
}

// Returns whether the outline of a component holds this point.
bool holds(const BitMask& component, int k, dvec3 pPatient) {
  return std::ranges::any_of(outlineOf(component, k), [&](const auto& piece) {
    return glm::distance(component.geometry().patientFromVoxel(piece[0]), pPatient) < 1e-9;
  });
}

bool near(double a, double b, double by) { return std::abs(a - b) <= by; }

bool endsAreRight(const Line& line) { return near(glm::distance(line.at[0], line.at[1]), line.mm, 1e-9); }

}  // namespace

void TestInPlane::rectangles_data() {
  QTest::addColumn<ivec3>("size");
  QTest::addColumn<double>("mm");
  QTest::addColumn<double>("across");
  // Pixels are 1 x 2 mm. Outlines of n x m pixels are cut halfway at the corners, such as from (-1/2, 0) to
  // (n - 1/2, m - 1).
  QTest::newRow("one pixel: 2 mm high, 1 mm wide") << ivec3(1, 1, 1) << 2.0 << 1.0;
  QTest::newRow("a row of five") << ivec3(5, 1, 1) << 5.0 << 2.0;
  QTest::newRow("three rows of one: the same in each slice") << ivec3(1, 3, 4) << 6.0 << 1.0;
}

void TestInPlane::rectangles() {
  QFETCH(ivec3, size);
  QFETCH(double, mm);
  QFETCH(double, across);
  VoxelGeometry grid{.size = {9, 9, 9}, .patientFromVoxelStep = {1, 0, 0, 0, 2, 0, 0, 0, 3}};
  BitMask mask(grid);
  forVoxels(size, [&](ivec3 v) { mask.set(v + ivec3(2, 3, 4)); });
  const auto found = inPlaneDiameters(mask);
  QVERIFY(found.has_value());
  QCOMPARE(found->slice, 4);
  QVERIFY(near(found->longest.mm, mm, 1e-12));
  QVERIFY(near(found->perpendicular.mm, across, 1e-12));
  QVERIFY(endsAreRight(found->longest) && endsAreRight(found->perpendicular));
}

void TestInPlane::ellipsoids_data() {
  QTest::addColumn<glm::dmat3>("step");
  for (const Grid& g : grids) QTest::newRow(g.name) << g.patientFromVoxelStep;
  for (const Grid& g : thickGrids) QTest::newRow(g.name) << g.patientFromVoxelStep;
}

// A ball of 20 mm radius has the diameter of its largest slice in both directions. Pixels are at most 1.1 mm.
void TestInPlane::ellipsoids() {
  QFETCH(glm::dmat3, step);
  const BitMask mask = maskOfShape(gridAbout(step, 24), ball(20));
  const auto found = inPlaneDiameters(mask);
  QVERIFY(found.has_value());
  const double pixel = std::max(glm::length(step[0]), glm::length(step[1]));
  QVERIFY2(near(found->longest.mm, 40, 1.5 * pixel), qPrintable(QString::number(found->longest.mm)));
  QVERIFY2(near(found->perpendicular.mm, 40, 1.5 * pixel),
           qPrintable(QString::number(found->perpendicular.mm)));
  const dvec3 along = found->longest.at[1] - found->longest.at[0],
              across = found->perpendicular.at[1] - found->perpendicular.at[0];
  QVERIFY(std::abs(glm::dot(along, across)) < 1e-6);
  for (const Line& line : {found->longest, found->perpendicular})
    for (const dvec3& end : line.at)
      QVERIFY(near(mask.geometry().voxelFromPatient(end).z, found->slice, 1e-9));
}

void TestInPlane::ofAnyMaskAsByTryingAll() {
  const Seeds seeds = seedsOf(200, 5000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const BitMask mask = anyMask(chance, anyGrid(chance, 9));
    if (mask.empty()) continue;
    const auto found = inPlaneDiameters(mask);
    QVERIFY(found.has_value());
    double longest = -1;
    std::vector<BitMask> holding;  // the components that hold an end of the diameter
    for (int k = 0; k < mask.size().z; ++k)
      for (const BitMask& component : componentsOf(mask, k)) {
        longest = std::max(longest, longestOf(component, k));
        const auto& ends = found->longest.at;
        if (k == found->slice && (holds(component, k, ends[0]) || holds(component, k, ends[1])))
          holding.push_back(component);
      }
    const QByteArray where = "seed " + QByteArray::number(seed);
    QVERIFY2(near(found->longest.mm, longest, 1e-9), where.constData());
    QVERIFY2(holding.size() == 1, where.constData());
    QVERIFY2(near(longestOf(holding[0], found->slice), longest, 1e-9), where.constData());
    QVERIFY2(endsAreRight(found->longest) && endsAreRight(found->perpendicular), where.constData());
    const glm::dmat3 step = mask.geometry().patientFromVoxelStep;
    const dvec3 along = glm::normalize(found->longest.at[1] - found->longest.at[0]);
    const dvec3 across = glm::normalize(glm::cross(glm::cross(step[0], step[1]), along));
    QVERIFY2(near(found->perpendicular.mm, longestAcross(holding[0], found->slice, along, across), 1e-6),
             where.constData());
  }
}

// Two lesions of 5 x 3 and 4 x 1 pixels of 1 mm in one slice, 20 mm apart.
void TestInPlane::ofOneComponent() {
  BitMask mask(VoxelGeometry{.size = {40, 9, 3}});
  forVoxels({5, 3, 1}, [&](ivec3 v) { mask.set(v + ivec3(2, 3, 1)); });
  forVoxels({4, 1, 1}, [&](ivec3 v) { mask.set(v + ivec3(27, 4, 1)); });
  const auto found = inPlaneDiameters(mask);
  QVERIFY(found.has_value());
  QVERIFY(near(found->longest.mm, std::hypot(5, 2), 1e-12));
  QVERIFY(found->perpendicular.mm < 5);
  for (const Line& line : {found->longest, found->perpendicular})
    for (const dvec3 end : line.at) QVERIFY(end.x < 10);
}

void TestInPlane::noneOfNothing() {
  QVERIFY(!inPlaneDiameters(BitMask(VoxelGeometry{.size = {70, 3, 4}})).has_value());
}

VOLUMEN_TEST(TestInPlane);
#include "tst_in_plane.moc"
