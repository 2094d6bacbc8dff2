// Guards the search for surfaces (picture.md 10): its cells and distances equal those found by visiting every
// voxel. No crossing is lost or duplicated between cells.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "viewer/kernels/segment_crossings.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentCells : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cellsAndDistancesAreThoseOfEveryVoxel_data();
  void cellsAndDistancesAreThoseOfEveryVoxel();
  void crossingsPartInsideFromOutside_data() { cellsAndDistancesAreThoseOfEveryVoxel_data(); }
  void crossingsPartInsideFromOutside();
  void linesFromVeryFarAwayEnd();
};

namespace {

/// Returns a field of 2 to 60 voxels an edge with few spots, waves or noise; 0 at its border.
std::shared_ptr<const OccupancyField> randomField(Chance& chance) {
  OccupancyField field;
  const glm::ivec3 size(2 + chance.below(60), 2 + chance.below(40), 2 + chance.below(30));
  field.geometry.size = size;
  field.box = {glm::ivec3(0), size - 1};
  const int kind = chance.below(3), every = 1 + chance.below(3000);
  const glm::dvec3 waves = chance.vector();
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const glm::ivec3 at(i, j, k);
        const bool isBorder = glm::any(glm::equal(at, glm::ivec3(0))) || glm::any(glm::equal(at, size - 1));
        const double value = kind == 0   ? (chance.oneIn(every) ? 0.9 : 0.1)
                             : kind == 1 ? 0.5 + 0.4 * std::sin(glm::dot(waves, glm::dvec3(at)))
                                         : chance.share();
        field.values.push_back(isBorder ? 0.0f : float(value));
      }
  return std::make_shared<const OccupancyField>(std::move(field));
}

float occupancyAt(const OccupancyField& field, glm::ivec3 at) {
  const glm::ivec3 size = field.size();
  return field.values[(std::size_t(at.z) * std::size_t(size.y) + std::size_t(at.y)) * std::size_t(size.x) +
                      std::size_t(at.x)];
}

bool isCrossed(const OccupancyField& field, glm::ivec3 cell) {
  int inside = 0;
  for (int n = 0; n < 8; ++n)
    inside += occupancyAt(field, cell + glm::ivec3(n & 1, n >> 1 & 1, n >> 2)) >= SegmentCells::level;
  return inside > 0 && inside < 8;
}

template <class Visit>
void forEachIn(glm::ivec3 count, const Visit& visit) {
  for (int k = 0; k < count.z; ++k)
    for (int j = 0; j < count.y; ++j)
      for (int i = 0; i < count.x; ++i) visit(glm::ivec3(i, j, k));
}

/// Returns the field at a position within its box by interpolation.
double occupancyBetween(const OccupancyField& field, glm::dvec3 place) {
  const glm::ivec3 cell = glm::clamp(glm::ivec3(glm::floor(place)), glm::ivec3(0), field.size() - 2);
  const glm::dvec3 f = place - glm::dvec3(cell);
  double sum = 0;
  for (int n = 0; n < 8; ++n) {
    const glm::ivec3 corner(n & 1, n >> 1 & 1, n >> 2);
    const glm::dvec3 weight = glm::mix(1.0 - f, f, glm::dvec3(corner));
    sum += weight.x * weight.y * weight.z * double(occupancyAt(field, cell + corner));
  }
  return sum;
}

}  // namespace

void TestSegmentCells::cellsAndDistancesAreThoseOfEveryVoxel_data() {
  QTest::addColumn<quint64>("seed");
  const Seeds seeds = seedsOf(30, 1000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed)
    QTest::addRow("seed %d", seed) << quint64(seed);
}

void TestSegmentCells::cellsAndDistancesAreThoseOfEveryVoxel() {
  QFETCH(quint64, seed);
  Chance chance(seed);
  const auto field = randomField(chance);
  const SegmentCells cells(field);
  constexpr int edge = SegmentCells::edge;
  const glm::ivec3 count = (field->size() - 1 + (edge - 1)) / edge;
  std::vector<glm::ivec3> full;
  forEachIn(count, [&](glm::ivec3 block) {
    std::uint64_t expected = 0;
    forEachIn(glm::min(glm::ivec3(edge), field->size() - 1 - block * edge), [&](glm::ivec3 at) {
      const glm::ivec3 cell = block * edge + at;
      if (!isCrossed(*field, cell)) return;
      expected |= SegmentCells::bitOf(cell);
      QVERIFY(glm::all(glm::lessThanEqual(cells.box().low, cell)));
      QVERIFY(glm::all(glm::lessThanEqual(cell, cells.box().high)));
    });
    QCOMPARE(cells.block(block), expected);
    if (expected) full.push_back(block);
  });
  forEachIn(count, [&](glm::ivec3 block) {
    int least = 254;
    for (const glm::ivec3& other : full) {
      const glm::ivec3 by = glm::abs(other - block);
      least = std::min(least, std::max({by.x, by.y, by.z}));
    }
    QCOMPARE(cells.distance(block), least);
  });
}

// Lines are random, one in three along an axis. At each crossing the field is 1/2. Between two crossings it
// lies on the stated side of 1/2.
void TestSegmentCells::crossingsPartInsideFromOutside() {
  QFETCH(quint64, seed);
  Chance chance(seed);
  const auto field = randomField(chance);
  const SegmentCells cells(field);
  const glm::dvec3 far(field->size() - 1);
  for (int n = 0; n < 50; ++n) {
    FieldLine line{(chance.vector() * 0.5 + 0.5) * far, chance.vector()};
    if (chance.oneIn(3)) line.move = glm::dvec3(n % 3 == 0, n % 3 == 1, n % 3 == 2) * (n % 2 ? 1.0 : -1.0);
    std::vector<FieldCrossing> crossings, first;
    appendCrossings(cells, line, -1e3, 1e3, 1 << 20, crossings);
    appendCrossings(cells, line, -1e3, 1e3, 1, first);
    QCOMPARE(first.size(), std::min<std::size_t>(1, crossings.size()));
    if (!first.empty()) QCOMPARE(first[0].t, crossings[0].t);
    QCOMPARE(crossings.size() % 2, std::size_t(0));  // the border is outside
    std::vector<double> ends{-1e3};
    for (std::size_t c = 0; c < crossings.size(); ++c) {
      QCOMPARE(crossings[c].leaves, c % 2 == 1);
      QVERIFY(crossings[c].t >= ends.back());
      ends.push_back(crossings[c].t);
      QVERIFY(std::abs(occupancyBetween(*field, line.origin + crossings[c].t * line.move) - 0.5) < 1e-6);
    }
    ends.push_back(1e3);
    for (int k = 0; k < 200; ++k) {
      const double t = chance.between(-60, 60);
      const glm::dvec3 place = line.origin + t * line.move;
      if (glm::any(glm::lessThan(place, glm::dvec3(0))) || glm::any(glm::greaterThan(place, far))) continue;
      const double value = occupancyBetween(*field, place);
      if (std::abs(value - 0.5) < 1e-6) continue;
      const auto before = std::ranges::upper_bound(ends, t) - ends.begin();
      QCOMPARE(value > 0.5, before % 2 == 0);
    }
  }
}

// A scene's target may be 1e30 mm away. Along such lines the spacing of floats t may exceed the field's size.
void TestSegmentCells::linesFromVeryFarAwayEnd() {
  OccupancyField field;
  field.geometry.size = glm::ivec3(64);
  field.box = {glm::ivec3(0), glm::ivec3(63)};
  field.values.assign(64 * 64 * 64, 0.0f);
  for (const int at : {10, 50}) field.values[std::size_t((at * 64 + at) * 64 + at)] = 1;
  const SegmentCells cells(std::make_shared<const OccupancyField>(std::move(field)));
  Chance chance(1);
  for (int n = 0; n < 20000; ++n) {
    const double farMm = chance.power(10, 30);
    const glm::dvec3 move =
        n % 4 == 0 ? glm::dvec3(1, 0, 0) : glm::normalize(chance.vector() + glm::dvec3(1e-3));
    const FieldLine line{glm::dvec3(32) + 20.0 * chance.vector() - farMm * move, move};
    std::vector<FieldCrossing> crossings;
    appendCrossings(cells, line, -std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::infinity(), false, crossings);
    for (const FieldCrossing& c : crossings) QVERIFY(std::isfinite(c.t));
  }
}

VOLUMEN_TEST(TestSegmentCells);
#include "tst_segment_cells.moc"
