// Guards connected components: those of a flood fill by faces, edges and corners, in order of size. Also
// guards what a click reaches, with and without thin bridges.
#include <tbb/global_control.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "tests/fixtures/seeds.h"
#include "tests/unit/segment/bit_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/parts.h"

using namespace volumen;
using namespace volumen::tests;

class TestParts : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void partsAreThoseOfAFlood();
  void whatTouches_data();
  void whatTouches();
  void aClickReachesItsPart();
  void placesBeyondTheGridHoldNothing();
  void aThinBridgeLetsNothingThrough_data();
  void aThinBridgeLetsNothingThrough();
  void beyondBridgesIsThatOfItsDefinition();
  void sameForAnyNumberOfThreads();
  void cancelledThereAreNone();
};

namespace {

constexpr Neighbours kinds[] = {Neighbours::faces, Neighbours::edges, Neighbours::corners};

// Returns the offsets of touching voxels: up to one step along each axis, along one, two or three axes at
// once.
std::vector<glm::ivec3> touching(Neighbours neighbours) {
  const int axes = neighbours == Neighbours::faces ? 1 : neighbours == Neighbours::edges ? 2 : 3;
  std::vector<glm::ivec3> all;
  for (int n = 0; n < 27; ++n) {
    const glm::ivec3 d(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
    const int along = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    if (along > 0 && along <= axes) all.push_back(d);
  }
  return all;
}

// Returns the components by flood fill, ordered by their first voxels.
std::vector<std::vector<glm::ivec3>> byFlood(const BitMask& mask, Neighbours neighbours) {
  const std::vector<glm::ivec3> steps = touching(neighbours);
  BitMask seen(mask.geometry());
  std::vector<std::vector<glm::ivec3>> parts;
  for (const glm::ivec3 start : voxelsOf(mask.geometry())) {
    if (!mask.at(start) || seen.at(start)) continue;
    std::vector<glm::ivec3> part{start};
    seen.set(start);
    for (std::size_t n = 0; n < part.size(); ++n)
      for (const glm::ivec3 step : steps) {
        const glm::ivec3 to = part[n] + step;
        if (!isInGrid(to, mask.size()) || !mask.at(to) || seen.at(to)) continue;
        part.push_back(to);
        seen.set(to);
      }
    parts.push_back(std::move(part));
  }
  return parts;
}

BitMask maskOf(const VoxelGeometry& grid, const std::vector<glm::ivec3>& voxels) {
  BitMask mask(grid);
  for (const glm::ivec3 voxel : voxels) mask.set(voxel);
  return mask;
}

std::vector<glm::ivec3> someVoxels(std::mt19937& random, const VoxelGeometry& grid) {
  const auto voxels = voxelsOf(grid);
  std::vector<glm::ivec3> some;
  for (int n = int(random() % 5); n > 0; --n) some.push_back(voxels[random() % voxels.size()]);
  return some;
}

}  // namespace

void TestParts::partsAreThoseOfAFlood() {
  const Seeds seeds = seedsOf(700, 40000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    const VoxelGeometry grid = anyGrid(random);
    const BitMask mask = anyMask(random, grid);
    const Neighbours neighbours = kinds[random() % 3];
    const std::string told = caseOf(seed, mask);
    auto expected = byFlood(mask, neighbours);
    std::ranges::stable_sort(expected, std::greater(), [](const auto& part) { return part.size(); });
    const Parts parts(mask, neighbours);
    QVERIFY2(parts.count() == expected.size(), told.c_str());
    BitMask largestTwo(grid), touched(grid), atLeast(grid);
    const std::vector<glm::ivec3> places = someVoxels(random, grid);
    const auto limit = std::int64_t(random() % 12);
    for (std::size_t n = 0; n < expected.size(); ++n) {
      const BitMask part = maskOf(grid, expected[n]);
      QVERIFY2(parts.size(n) == std::int64_t(expected[n].size()), told.c_str());
      for (const glm::ivec3 voxel : expected[n])
        if (parts.of(voxel) != n) QFAIL(told.c_str());
      if (n < 2) largestTwo = united(largestTwo, part);
      if (parts.size(n) >= limit) atLeast = united(atLeast, part);
      if (std::ranges::any_of(places, [&](glm::ivec3 v) { return part.at(v); }))
        touched = united(touched, part);
    }
    for (const glm::ivec3 voxel : voxelsOf(grid))
      if (!mask.at(voxel) && parts.of(voxel) != parts.count()) QFAIL(told.c_str());
    QVERIFY2(parts.largest() == (expected.empty() ? BitMask(grid) : maskOf(grid, expected[0])), told.c_str());
    QVERIFY2(parts.largest(2) == largestTwo, told.c_str());
    QVERIFY2(parts.largest(expected.size() + 3) == mask, told.c_str());
    QVERIFY2(parts.largest(0).empty(), told.c_str());
    QVERIFY2(parts.atLeast(limit) == atLeast, told.c_str());
    QVERIFY2(parts.touched(places) == touched, told.c_str());
    QVERIFY2(parts.untouched(places) == subtracted(mask, touched), told.c_str());
    QVERIFY2(parts.mask(std::vector<bool>(parts.count(), true)) == mask, told.c_str());
  }
}

void TestParts::whatTouches_data() {
  QTest::addColumn<int>("di");
  QTest::addColumn<int>("dj");
  QTest::addColumn<int>("dk");
  QTest::addColumn<int>("axes");
  for (int n = 0; n < 27; ++n) {
    const int di = n % 3 - 1, dj = n / 3 % 3 - 1, dk = n / 9 - 1;
    if (n != 13)
      QTest::addRow("%+d %+d %+d", di, dj, dk) << di << dj << dk << (di != 0) + (dj != 0) + (dk != 0);
  }
}

// Two voxels on both sides of a word's end form one component or two.
void TestParts::whatTouches() {
  QFETCH(int, di);
  QFETCH(int, dj);
  QFETCH(int, dk);
  QFETCH(int, axes);
  const glm::ivec3 a(64, 1, 1), b = a + glm::ivec3(di, dj, dk);
  const BitMask mask = maskOf({.size = {70, 3, 3}}, {a, b});
  for (int kind = 1; kind <= 3; ++kind) {
    const Neighbours neighbours = kinds[kind - 1];
    QCOMPARE(Parts(mask, neighbours).count(), std::size_t(axes <= kind ? 1 : 2));
    QCOMPARE(connected(mask, {&a, 1}, neighbours).at(b), axes <= kind);
  }
}

void TestParts::aClickReachesItsPart() {
  const Seeds seeds = seedsOf(1500, 60000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    const VoxelGeometry grid = anyGrid(random);
    const BitMask mask = anyMask(random, grid);
    const Neighbours neighbours = kinds[random() % 3];
    const std::vector<glm::ivec3> places = someVoxels(random, grid);
    BitMask expected(grid);
    for (const auto& part : byFlood(mask, neighbours)) {
      const BitMask all = maskOf(grid, part);
      if (std::ranges::any_of(places, [&](glm::ivec3 v) { return all.at(v); }))
        expected = united(expected, all);
    }
    QVERIFY2(connected(mask, places, neighbours) == expected, caseOf(seed, mask).c_str());
  }
}

void TestParts::placesBeyondTheGridHoldNothing() {
  const BitMask all = inverted(BitMask({.size = {5, 4, 3}}));
  const Parts parts(all, Neighbours::faces);
  for (const glm::ivec3 beyond :
       {glm::ivec3(-1, 0, 0), glm::ivec3(5, 0, 0), glm::ivec3(0, -1, 0), glm::ivec3(0, 4, 0),
        glm::ivec3(0, 0, -1), glm::ivec3(0, 0, 3), glm::ivec3(std::numeric_limits<int>::min()),
        glm::ivec3(std::numeric_limits<int>::max())}) {
    QCOMPARE(parts.of(beyond), parts.count());
    QVERIFY(parts.touched({&beyond, 1}).empty());
    QVERIFY(parts.untouched({&beyond, 1}) == all);
    QVERIFY(connected(all, {&beyond, 1}, Neighbours::faces).empty());
    QVERIFY(connectedBeyond(all, {&beyond, 1}, Neighbours::faces, 1).empty());
  }
}

void TestParts::aThinBridgeLetsNothingThrough_data() {
  QTest::addColumn<int>("bridge");  // width in voxels of 1 mm
  QTest::addColumn<bool>("through");
  QTest::newRow("1 voxel") << 1 << false;
  QTest::newRow("3 voxels") << 3 << false;
  QTest::newRow("5 voxels: a ball of 2 mm passes") << 5 << true;
}

// Two blocks of 11 voxels are joined by a bridge between their middles. The click is at a corner, where no
// ball fits.
void TestParts::aThinBridgeLetsNothingThrough() {
  QFETCH(int, bridge);
  QFETCH(bool, through);
  const VoxelGeometry grid{.size = {45, 15, 15}};
  BitMask mask(grid), left(grid);
  for (const glm::ivec3 v : voxelsOf(grid)) {
    const glm::ivec3 m = glm::abs(v - glm::ivec3(22, 7, 7));
    const bool block = m.x > 8 && m.x < 20 && m.y <= 5 && m.z <= 5;
    if (block || (m.x <= 8 && m.y <= bridge / 2 && m.z <= bridge / 2)) mask.set(v);
    if (block && v.x < 22) left.set(v);
  }
  const glm::ivec3 corner(3, 2, 2), air(3, 1, 3);
  QVERIFY(mask.at(corner) && !mask.at(air));
  const BitMask found = connectedBeyond(mask, {&corner, 1}, Neighbours::faces, 2);
  QCOMPARE(found.at({35, 7, 7}), through);
  QVERIFY(found.at({8, 7, 7}));
  QVERIFY(subtracted(found, mask).empty());
  QVERIFY2(through || subtracted(found, left).count() <= 2 * 9,
           "it reaches into the bridge by a ball at most");
  QVERIFY(connectedBeyond(mask, {&air, 1}, Neighbours::faces, 2) == found);
  QVERIFY(connectedBeyond(mask, {&air, 1}, Neighbours::faces, 0.4).empty());
}

void TestParts::beyondBridgesIsThatOfItsDefinition() {
  const Seeds seeds = seedsOf(150, 8000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    const VoxelGeometry grid = anyGrid(random, {66, 7, 6});
    const BitMask mask = anyMask(random, grid);
    const Neighbours neighbours = kinds[random() % 3];
    const double radius = double(random() % 300) / 100;
    const auto mm = [&](glm::ivec3 a, glm::ivec3 b) {
      return glm::length(grid.patientFromVoxelStep * glm::dvec3(b - a));
    };
    const auto near = [&](glm::ivec3 a, glm::ivec3 b) { return mm(a, b) <= radius * (1 + 1e-9); };
    const auto voxels = voxelsOf(grid);
    BitMask core(grid), expected(grid);
    for (const glm::ivec3 a : voxels)
      core.set(a, std::ranges::all_of(voxels, [&](glm::ivec3 b) { return !near(a, b) || mask.at(b); }));
    const std::vector<glm::ivec3> places = someVoxels(random, grid);
    for (const auto& part : byFlood(core, neighbours)) {
      const bool wanted = std::ranges::any_of(places, [&](glm::ivec3 place) {
        const auto distance = [&](glm::ivec3 v) {
          return core.at(v) ? mm(place, v) : std::numeric_limits<double>::infinity();
        };
        const glm::ivec3 nearest = *std::ranges::min_element(voxels, {}, distance);
        return distance(nearest) <= 2 * radius && std::ranges::find(part, nearest) != part.end();
      });
      if (wanted)
        for (const glm::ivec3 a : part)
          for (const glm::ivec3 b : voxels)
            if (near(a, b)) expected.set(b);
    }
    const BitMask found = connectedBeyond(mask, places, neighbours, radius);
    QVERIFY2(found == expected, caseOf(seed, mask).c_str());
    QVERIFY2(subtracted(found, mask).empty(), caseOf(seed, mask).c_str());
  }
}

void TestParts::sameForAnyNumberOfThreads() {
  std::mt19937 random(5);
  const VoxelGeometry grid{.size = {130, 60, 90}};
  BitMask mask(grid);
  for (std::uint64_t& word : mask.words()) word = std::uint64_t(random()) << 32 | random();
  mask = intersected(std::move(mask), inverted(BitMask(grid)));
  const auto all = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const Parts parts(mask, Neighbours::faces);
    std::vector<std::int64_t> sizes(parts.count());
    for (std::size_t n = 0; n < sizes.size(); ++n) sizes[n] = parts.size(n);
    return std::tuple(sizes, parts.largest(), parts.atLeast(5));
  };
  const auto one = all(1);
  QVERIFY(std::get<0>(one).size() > 1000);
  QCOMPARE(std::accumulate(std::get<0>(one).begin(), std::get<0>(one).end(), std::int64_t(0)), mask.count());
  for (int n = 0; n < 5; ++n) QVERIFY(one == all(2));
  QVERIFY(one == all(7));
}

void TestParts::cancelledThereAreNone() {
  const CancelToken cancel;
  cancel.cancel();
  const BitMask all = inverted(BitMask({.size = {9, 9, 9}}));
  const Parts parts(all, Neighbours::corners, cancel);
  const glm::ivec3 middle(4);
  QCOMPARE(parts.count(), std::size_t(0));
  QVERIFY(parts.largest().empty());
  QVERIFY(parts.touched({&middle, 1}).empty());
  QVERIFY(connected(all, {&middle, 1}, Neighbours::faces, cancel) != all);
}

VOLUMEN_TEST(TestParts);
#include "tst_parts.moc"
