// Guards brush.h: strokes and outlines against voxel-by-voxel implementations, in planes of any direction
// through grids of any shape. A slice shows no hole under the brush, and nothing that the brush did not
// touch.
#include <array>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/segment/field_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/brush.h"

using namespace volumen;
using namespace volumen::tests;

class TestBrush : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void ballsAreThoseOfATwin();
  void discsAreThoseOfATwin();
  void discsHaveNoHoles();
  void discsOfCubesAreCircles();
  void discsReachIntoThickSlices();
  void aPlaneBetweenSlicesPaintsOne();
  void outlinesAreThoseOfATwin();
  void whatAnOutlineGoesAroundIsInside();
  void beyondTheGridIsNothing();
  void rulesSayWhatIsPainted();
};

namespace {

struct BrushCase {
  VoxelGeometry grid;
  glm::dvec3 from{0}, to{0}, normal{0, 0, 1};
  double radius = 1, finest = 1;
};

// Returns a random stroke in and around the grid. Half of the planes are perpendicular to a grid axis.
BrushCase anyStroke(Chance& chance) {
  BrushCase c;
  c.grid = anyGrid(chance, 14);
  const glm::dvec3 edges = c.grid.spacing(), size(c.grid.size);
  c.finest = std::min({edges.x, edges.y, edges.z});
  const glm::dmat3& step = c.grid.patientFromVoxelStep;
  const int axis = chance.below(3);
  c.normal = chance.oneIn(2) ? glm::normalize(chance.vector() + glm::dvec3(0.01))
                             : glm::normalize(glm::cross(step[axis], step[(axis + 1) % 3]));
  c.from = c.grid.patientFromVoxel((chance.colour() * 1.4 - 0.2) * size);
  const glm::dvec3 way = step * (chance.vector() * size * 0.5);
  c.to = chance.oneIn(3) ? c.from : c.from + way - glm::dot(way, c.normal) * c.normal;
  c.radius = c.finest * chance.between(0.3, 8);
  return c;
}

// Returns the voxels of spans. Checks that spans are in memory order and neither overlap nor touch.
BitMask maskOfSpans(const VoxelGeometry& grid, const VoxelSpans& spans) {
  for (std::size_t n = 0; n < spans.size(); ++n) {
    const RowSpan& s = spans[n];
    if (s.begin >= s.end || s.begin < 0 || s.end > grid.size.x) qFatal("no span of the grid");
    if (n == 0) continue;
    const RowSpan& before = spans[n - 1];
    const bool sameRow = before.j == s.j && before.k == s.k;
    if (sameRow ? s.begin <= before.end : std::pair(before.k, before.j) > std::pair(s.k, s.j))
      qFatal("not in order, or not apart");
  }
  BitMask mask(grid);
  addSpans(mask, spans);
  return mask;
}

double distanceToPath(glm::dvec3 p, glm::dvec3 from, glm::dvec3 to) {
  const glm::dvec3 along = to - from;
  const double length = glm::length(along);
  if (length == 0) return glm::distance(p, from);
  const double t = glm::dot(p - from, along / length);
  if (t <= 0) return glm::distance(p, from);
  if (t >= length) return glm::distance(p, to);
  return glm::length(glm::cross(p - from, along / length));
}

// Returns how far the corners of a voxel extend on both sides of a plane, in mm.
std::pair<double, double> sidesOf(const VoxelGeometry& grid, glm::ivec3 v, glm::dvec3 at, glm::dvec3 normal) {
  double least = 1e300, most = -1e300;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 offset(corner & 1, corner >> 1 & 1, corner >> 2);
    const double d = glm::dot(grid.patientFromVoxel(glm::dvec3(v) + offset - 0.5) - at, normal);
    least = std::min(least, d), most = std::max(most, d);
  }
  return {least, most};
}

enum class Expected { in, out, either };

// If rounding decides, both results are right.
Expected byMargin(double insideBy, double scale) {
  return insideBy > 1e-7 * scale ? Expected::in : insideBy < -1e-7 * scale ? Expected::out : Expected::either;
}

Expected both(Expected a, Expected b) {
  if (a == Expected::out || b == Expected::out) return Expected::out;
  return a == Expected::in ? b : a;
}

Expected isCutByPlane(const VoxelGeometry& grid, glm::ivec3 v, glm::dvec3 at, glm::dvec3 normal) {
  const auto [least, most] = sidesOf(grid, v, at, normal);
  return byMargin(std::min(-least, most), most - least);
}

template <class ExpectedAt>
bool isAsExpected(const BitMask& mask, const ExpectedAt& expectedAt) {
  bool good = true;
  forVoxels(mask.size(), [&](glm::ivec3 v) {
    const Expected expected = expectedAt(v);
    good = good && (expected == Expected::either || mask.at(v) == (expected == Expected::in));
  });
  return good;
}

// Returns the smallest distance of a voxel's core from the centres of all discs of the stroke, in the plane.
double reachOfDiscs(const BrushCase& c, glm::ivec3 v) {
  const glm::dvec3 edges = c.grid.spacing();
  const int steps = int(std::ceil(glm::distance(c.from, c.to) / (c.finest / 2)));
  double nearest = 1e300;
  for (int n = 0; n <= steps; ++n) {
    const glm::dvec3 middle = c.from + (c.to - c.from) * (steps > 0 ? double(n) / steps : 0.0);
    glm::dvec3 core = c.grid.voxelFromPatient(middle) - glm::dvec3(v);
    for (int a = 0; a < 3; ++a) {
      const double half = (edges[a] - c.finest) / (2 * edges[a]);
      core[a] = std::min(std::max(core[a], -half), half);
    }
    const glm::dvec3 way = middle - c.grid.patientFromVoxel(glm::dvec3(v) + core);
    nearest = std::min(nearest, glm::length(glm::cross(way, c.normal)));
  }
  return nearest;
}

// Returns the winding number of an outline about a point, by angles.
int windingAbout(const std::vector<glm::dvec2>& outline, glm::dvec2 p) {
  double angle = 0;
  for (std::size_t n = 0; n < outline.size(); ++n) {
    const glm::dvec2 a = outline[n] - p, b = outline[(n + 1) % outline.size()] - p;
    angle += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
  }
  return int(std::lround(angle / (2 * std::numbers::pi)));
}

VoxelGeometry cubes(int size) {
  VoxelGeometry grid;
  grid.size = glm::ivec3(size);
  return grid;
}

}  // namespace

void TestBrush::ballsAreThoseOfATwin() {
  const Seeds seeds = seedsOf(400, 5000);
  int covered = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const BrushCase c = anyStroke(chance);
    const BitMask mask = maskOfSpans(c.grid, ballStroke(c.grid, c.from, c.to, c.radius));
    const auto expected = [&](glm::ivec3 v) {
      return byMargin(c.radius - distanceToPath(c.grid.patientFromVoxel(v), c.from, c.to), c.radius);
    };
    QVERIFY2(isAsExpected(mask, expected), qPrintable(QString::number(seed)));
    covered += mask.empty() ? 0 : 1;
  }
  QVERIFY(covered > seeds.count / 3);
}

void TestBrush::discsAreThoseOfATwin() {
  const Seeds seeds = seedsOf(300, 5000);
  int covered = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const BrushCase c = anyStroke(chance);
    const BitMask mask = maskOfSpans(c.grid, discStroke(c.grid, c.from, c.to, c.normal, c.radius));
    const auto expected = [&](glm::ivec3 v) {
      const Expected cut = isCutByPlane(c.grid, v, c.from, c.normal);
      return cut == Expected::out ? cut : both(cut, byMargin(c.radius - reachOfDiscs(c, v), c.radius));
    };
    QVERIFY2(isAsExpected(mask, expected), qPrintable(QString::number(seed)));
    covered += mask.empty() ? 0 : 1;
  }
  QVERIFY(covered > seeds.count / 4);
}

// Points of a slice at least half a cell's diagonal inside the brush are painted.
void TestBrush::discsHaveNoHoles() {
  const Seeds seeds = seedsOf(300, 5000);
  int looked = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    BrushCase c = anyStroke(chance);
    const glm::dmat3& step = c.grid.patientFromVoxelStep;
    double diagonal = 0;
    for (int corner = 0; corner < 4; ++corner)
      diagonal =
          std::max(diagonal, glm::length(step * glm::dvec3(1, corner & 1 ? 1 : -1, corner & 2 ? 1 : -1)));
    c.radius += diagonal / 2;
    const BitMask mask = maskOfSpans(c.grid, discStroke(c.grid, c.from, c.to, c.normal, c.radius));
    const glm::dvec3 across = glm::normalize(glm::cross(c.normal, glm::dvec3(0.3, -0.5, 0.8)));
    for (int n = 0; n < 200; ++n) {
      const double angle = chance.between(0, 7), away = (c.radius - diagonal / 2) * chance.share();
      const glm::dvec3 p = c.from + chance.share() * (c.to - c.from) +
                           away * (std::cos(angle) * across + std::sin(angle) * glm::cross(c.normal, across));
      const glm::ivec3 v(glm::floor(c.grid.voxelFromPatient(p) + 0.5));
      const bool inGrid = v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < c.grid.size.x && v.y < c.grid.size.y &&
                          v.z < c.grid.size.z;
      if (!inGrid || isCutByPlane(c.grid, v, c.from, c.normal) == Expected::either) continue;
      ++looked;
      QVERIFY2(mask.at(v), qPrintable(QString::number(seed)));
    }
  }
  QVERIFY(looked > 20 * seeds.count);
}

void TestBrush::discsOfCubesAreCircles() {
  const VoxelGeometry grid = cubes(41);
  for (const double radius : {0.5, 1.0, 5.0, 7.3, 12.0}) {
    const BitMask mask = maskOfSpans(grid, discStroke(grid, {20, 20, 7}, {20, 20, 7}, {0, 0, 1}, radius));
    QVERIFY(mask == maskWhere(grid, [&](glm::ivec3 v) {
              return v.z == 7 && glm::length(glm::dvec2(v.x - 20, v.y - 20)) <= radius;
            }));
  }
}

// Voxels have 0.7 x 0.7 x 5 mm, and the plane is coronal. A disc of 1 mm at the border of two slices paints
// both.
void TestBrush::discsReachIntoThickSlices() {
  VoxelGeometry grid;
  grid.size = {40, 40, 10};
  grid.patientFromVoxelStep = glm::dmat3(glm::dvec3(0.7, 0, 0), glm::dvec3(0, 0.7, 0), glm::dvec3(0, 0, 5));
  const auto slicesAt = [&](double z) {
    const glm::dvec3 at(14, 14, z);
    const auto box = maskOfSpans(grid, discStroke(grid, at, at, {0, 1, 0}, 1)).box();
    return std::pair(box->low.z, box->high.z);
  };
  QCOMPARE(slicesAt(22.5), std::pair(4, 5));
  QCOMPARE(slicesAt(21.9), std::pair(4, 5));
  QCOMPARE(slicesAt(21.8), std::pair(4, 4));
  QCOMPARE(slicesAt(20.0), std::pair(4, 4));
}

// The painted slice is the displayed one.
void TestBrush::aPlaneBetweenSlicesPaintsOne() {
  const VoxelGeometry grid = cubes(20);
  for (const double normal : {1.0, -1.0}) {
    const glm::dvec3 at(10, 10, 6.5);
    const BitMask mask = maskOfSpans(grid, discStroke(grid, at, at, {0, 0, normal}, 3));
    QCOMPARE(mask.box()->low.z, 7);
    QCOMPARE(mask.box()->high.z, 7);
  }
}

void TestBrush::outlinesAreThoseOfATwin() {
  const Seeds seeds = seedsOf(300, 5000);
  int covered = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const BrushCase c = anyStroke(chance);
    const glm::dvec3 right = glm::normalize(glm::cross(c.normal, glm::dvec3(0.3, -0.5, 0.8))),
                     down = glm::cross(c.normal, right);
    std::vector<glm::dvec3> outline;
    std::vector<glm::dvec2> inPlane;
    for (int n = 3 + chance.below(9); n > 0; --n) {
      inPlane.push_back(c.finest * 10 * glm::dvec2(chance.between(-1, 1), chance.between(-1, 1)));
      outline.push_back(c.from + inPlane.back().x * right + inPlane.back().y * down);
    }
    const BitMask mask = maskOfSpans(c.grid, insideOutline(c.grid, outline, c.normal));
    const auto expected = [&](glm::ivec3 v) {
      const glm::dvec3 way = c.grid.patientFromVoxel(v) - c.from;
      const glm::dvec2 p(glm::dot(way, right), glm::dot(way, down));
      for (std::size_t n = 0; n < inPlane.size(); ++n)
        if (distanceToPath({p, 0}, {inPlane[n], 0}, {inPlane[(n + 1) % inPlane.size()], 0}) < 1e-7 * c.finest)
          return Expected::either;
      return both(isCutByPlane(c.grid, v, c.from, c.normal),
                  windingAbout(inPlane, p) != 0 ? Expected::in : Expected::out);
    };
    QVERIFY2(isAsExpected(mask, expected), qPrintable(QString::number(seed)));
    covered += mask.empty() ? 0 : 1;
  }
  QVERIFY(covered > seeds.count / 4);
}

// Covers a five-pointed star drawn in one stroke, and an outline without area.
void TestBrush::whatAnOutlineGoesAroundIsInside() {
  const VoxelGeometry grid = cubes(41);
  std::vector<glm::dvec3> star;
  for (int n = 0; n < 5; ++n) {
    const double angle = 4 * std::numbers::pi / 5 * n;
    star.push_back({20 + 15 * std::sin(angle), 20 + 15 * std::cos(angle), 9});
  }
  const BitMask mask = maskOfSpans(grid, insideOutline(grid, star, {0, 0, 1}));
  QVERIFY(mask.at({20, 20, 9}) && mask.at({20, 33, 9}));
  QVERIFY(!mask.at({20, 20, 8}) && !mask.at({20, 20, 10}) && !mask.at({29, 33, 9}));
  star.resize(2);
  QVERIFY(insideOutline(grid, star, {0, 0, 1}).empty());
}

void TestBrush::beyondTheGridIsNothing() {
  const VoxelGeometry grid = cubes(8);
  const glm::dvec3 far(100, 3, 3), n(0, 0, 1);
  QVERIFY(ballStroke(grid, far, far, 5).empty());
  QVERIFY(discStroke(grid, far, far, n, 5).empty());
  QVERIFY(
      insideOutline(grid, std::array{far, far + glm::dvec3(5, 0, 0), far + glm::dvec3(0, 5, 0)}, n).empty());
  // The stroke passes all of the grid at once.
  QCOMPARE(maskOfSpans(grid, ballStroke(grid, {-50, 3, 3}, {50, 3, 3}, 20)).count(), std::int64_t(512));
  // The distance in voxels exceeds integers.
  for (const glm::dvec3 at : {glm::dvec3(1e12, 3, 3), glm::dvec3(-1e12, 3, 3)}) {
    QVERIFY(ballStroke(grid, at, at, 5).empty());
    QVERIFY(discStroke(grid, at, at, n, 5).empty());
  }
}

void TestBrush::rulesSayWhatIsPainted() {
  VolumeParts parts;
  parts.geometry = cubes(12);
  parts.attributes.padding = ValueRange{3, 3};
  std::vector<std::int16_t> values;
  forVoxels(parts.geometry.size, [&](glm::ivec3 v) { values.push_back(std::int16_t(v.x)); });
  parts.values = values;
  const VolumePtr volume = volumeFrom(std::move(parts));
  const VoxelGeometry& grid = volume->geometry();
  LabelEdit edit{LabelMap(grid)};
  forVoxels(grid.size, [&](glm::ivec3 v) { edit.set(v, std::uint8_t(v.y / 3)); });  // bands of labels 0 to 3
  const LabelMap map = edit.done();
  const VoxelSpans spans = ballStroke(grid, {5, 5, 5}, {5, 5, 5}, 4);
  const BitMask ball = maskOfSpans(grid, spans);
  const auto expect = [&](const PaintRules& rules, const auto& isWritten) {
    const LabelMap made = painted(map, spans, rules);
    bool good = true;
    forVoxels(grid.size, [&](glm::ivec3 v) {
      const std::uint8_t was = map.at(v), after = rules.erases ? 0 : rules.label;
      good = good && made.at(v) == (ball.at(v) && isWritten(v, was) ? after : was);
    });
    return good;
  };
  QVERIFY(expect({.label = 2}, [](glm::ivec3, int) { return true; }));
  QVERIFY(expect({.label = 2, .kept = {0, 1}}, [](glm::ivec3, int was) { return was > 1; }));
  QVERIFY(expect({.label = 2, .erases = true}, [](glm::ivec3, int was) { return was == 2; }));
  QVERIFY(expect({.label = 2, .range = ValueRange{2, 6}, .volume = volume},
                 [](glm::ivec3 v, int) { return v.x >= 2 && v.x <= 6 && v.x != 3; }));
  QVERIFY(painted(map, {}, {}) == map);
}

VOLUMEN_TEST(TestBrush);
#include "tst_brush.moc"
