// Guards the scissors: the same voxels as by angles and winding numbers one by one, along the lines of sight
// of any camera, on any grid.
#include <cmath>
#include <limits>
#include <random>

#include "tests/fixtures/ct_with_table.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/segment/bit_masks.h"
#include "tests/unit/segment/lassos.h"
#include "tests/unit/suite.h"
#include "viewer/segment/mask.h"
#include "viewer/segment/range.h"
#include "viewer/segment/table.h"

using namespace volumen;
using namespace volumen::tests;

class TestMask : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theVoxelsAreThoseOfBruteForce_data();
  void theVoxelsAreThoseOfBruteForce();
  void setsOfVoxelsAreCutLikewise();
  void whatAnOutlineCrossesItselfAroundIsInside();
  void whatIsBehindTheEyeIsNotInside_data();
  void whatIsBehindTheEyeIsNotInside();
  void lassosAddUpWithTheTable();
  void anOutlineOfNoAreaCutsNothing_data();
  void anOutlineOfNoAreaCutsNothing();
  void valuesBecomeAir_data();
  void valuesBecomeAir();
  void textsNameWhatWasCut();
  void cuttingFurtherIsTheSameAsAnew_data();
  void cuttingFurtherIsTheSameAsAnew();
  void cancelledIsToldSo();
};

namespace {

// Returns a sheared, oblique grid of unequal steps.
VoxelGeometry obliqueGrid() {
  VoxelGeometry grid;
  grid.size = {19, 14, 11};
  grid.patientFromVoxelStep = {{0.9, 0.2, -0.1}, {-0.3, 1.1, 0.25}, {0.1, -0.4, 1.7}};
  grid.origin = {-8, -7, -9};
  return grid;
}

VolumePtr volumeOn(const VoxelGeometry& grid) {
  std::vector<std::string> warnings;
  return *Volume::make({grid, std::vector<std::int16_t>(std::size_t(grid.voxelCount()), 100), 1, 0, {}},
                       warnings);
}

std::int64_t keptOf(const VolumePtr& volume, const Mask& mask) { return keptVoxels(*volume, mask).count(); }

Mask maskOf(std::vector<Lasso> lassos, bool table = false) {
  Mask mask{table, {}};
  for (Lasso& lasso : lassos) mask.lassos.push_back(std::make_shared<const Lasso>(std::move(lasso)));
  return mask;
}

Lasso square(double half) {
  Lasso lasso;
  lasso.points = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  return lasso;
}

}  // namespace

void TestMask::theVoxelsAreThoseOfBruteForce_data() {
  QTest::addColumn<bool>("perspective");
  QTest::addColumn<bool>("inside");
  QTest::newRow("parallel, inside") << false << true;
  QTest::newRow("parallel, outside") << false << false;
  QTest::newRow("perspective, inside") << true << true;
  QTest::newRow("perspective, outside") << true << false;
}

void TestMask::theVoxelsAreThoseOfBruteForce() {
  QFETCH(bool, perspective);
  QFETCH(bool, inside);
  const VolumePtr volume = volumeOn(obliqueGrid());
  const VoxelGeometry& grid = volume->geometry();
  std::mt19937 random(37);
  int someCut = 0;
  for (int round = 0; round < 40; ++round) {
    const Lasso lasso = anyLasso(random, perspective, inside);
    const BitMask kept = keptVoxels(*volume, maskOf({lasso}));
    std::int64_t cut = 0;
    for (int k = 0; k < grid.size.z; ++k)
      for (int j = 0; j < grid.size.y; ++j)
        for (int i = 0; i < grid.size.x; ++i) {
          const bool gone = isCutBy(lasso, grid.patientFromVoxel({i, j, k}));
          cut += gone;
          QVERIFY2(kept.at({i, j, k}) == !gone,
                   qPrintable(QStringLiteral("round %1: %2 %3 %4").arg(round).arg(i).arg(j).arg(k)));
        }
    someCut += cut > 0 && cut < grid.voxelCount();
  }
  QVERIFY2(someCut > 30, "or the rounds show little");
}

// Covers random masks, grids and lassos, with limited or unlimited depth.
void TestMask::setsOfVoxelsAreCutLikewise() {
  const Seeds seeds = seedsOf(200, 5000);
  int someCut = 0, someBeyond = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    VoxelGeometry grid = anyGrid(random, {24, 9, 7});
    grid.origin = -grid.patientFromVoxelStep * (glm::dvec3(grid.size - 1) / 2.0);
    const BitMask mask = anyMask(random, grid);
    const Lasso lasso = anyLasso(random, random() % 2, random() % 2);
    const double nearEye = lasso.perspective ? 40 : 0, unlimited = std::numeric_limits<double>::infinity(),
                 within = random() % 3 == 0 ? unlimited : nearEye + double(random() % 400) / 100;
    const BitMask left = leftBy(mask, lasso, within);
    for (int k = 0; k < grid.size.z; ++k)
      for (int j = 0; j < grid.size.y; ++j)
        for (int i = 0; i < grid.size.x; ++i) {
          const glm::dvec3 p = grid.patientFromVoxel({i, j, k});
          const double depth = std::abs(glm::dot(p - lasso.origin, lasso.forward()));
          if (std::abs(depth - within) < 1e-6) continue;
          const bool isIn = mask.at({i, j, k}), goes = isCutBy(lasso, p);
          someCut += isIn && goes && depth < within;
          someBeyond += isIn && goes && depth > within;
          QVERIFY2(left.at({i, j, k}) == (isIn && !(goes && depth < within)),
                   qPrintable(QStringLiteral("seed %1: %2 %3 %4").arg(seed).arg(i).arg(j).arg(k)));
        }
  }
  QVERIFY2(someCut > 0 && someBeyond > 0, "or the rounds show little");
}

void TestMask::whatAnOutlineCrossesItselfAroundIsInside() {
  VoxelGeometry grid;
  grid.size = {9, 9, 1};
  grid.origin = {-4, -4, 0};
  // The outline goes around twice. By the even-odd rule its middle would stay.
  Lasso twice = square(2.5);
  const std::vector<glm::dvec2> once = twice.points;
  twice.points.insert(twice.points.end(), once.begin(), once.end());
  QCOMPARE(keptOf(volumeOn(grid), maskOf({twice})), 81 - 25);
}

void TestMask::whatIsBehindTheEyeIsNotInside_data() {
  QTest::addColumn<bool>("inside");
  QTest::addColumn<int>("kept");
  // The eye is in the 11th of 21 voxels along z, with ten in front of it.
  QTest::newRow("inside") << true << 11;
  QTest::newRow("outside") << false << 10;
}

void TestMask::whatIsBehindTheEyeIsNotInside() {
  QFETCH(bool, inside);
  QFETCH(int, kept);
  VoxelGeometry grid;
  grid.size = {1, 1, 21};
  grid.origin = {0, 0, -10};
  Lasso lasso = square(0.5);
  lasso.perspective = true;
  lasso.inside = inside;
  QCOMPARE(keptOf(volumeOn(grid), maskOf({lasso})), kept);
}

void TestMask::lassosAddUpWithTheTable() {
  const VolumePtr volume = CtWithTable::volume(true);
  std::mt19937 random(5);
  const Lasso a = anyLasso(random, false, true), b = anyLasso(random, true, true);
  const BitMask patient = patientMask(*volume), all = keptVoxels(*volume, maskOf({a, b}, true)),
                withA = keptVoxels(*volume, maskOf({a})), withB = keptVoxels(*volume, maskOf({b}));
  QVERIFY(all == intersected(patient, intersected(withA, withB)));
  QVERIFY(all != patient && !all.empty());
  const ValueRange range{30, 500};
  QVERIFY(keptVoxelsInRange(*volume, range, maskOf({a, b}, true)) ==
          intersected(voxelsInRange(*volume, range), all));
  QVERIFY(keptVoxelsInRange(*volume, range, {}) == voxelsInRange(*volume, range));
}

void TestMask::anOutlineOfNoAreaCutsNothing_data() {
  QTest::addColumn<int>("points");
  for (const int points : {0, 1, 2}) QTest::addRow("%d points", points) << points;
}

void TestMask::anOutlineOfNoAreaCutsNothing() {
  QFETCH(int, points);
  VoxelGeometry grid;
  grid.size = {5, 5, 5};
  Lasso lasso;
  lasso.points = std::vector<glm::dvec2>{{0, 0}, {4, 4}};
  lasso.points.resize(std::size_t(points));
  QCOMPARE(keptOf(volumeOn(grid), maskOf({lasso})), 125);
}

void TestMask::valuesBecomeAir_data() {
  QTest::addColumn<double>("low");
  QTest::addColumn<double>("air");
  QTest::newRow("HU") << -1024.0 << -1000.0;
  QTest::newRow("no air in it: the nearest there is") << -400.0 << -400.0;
  QTest::newRow("not HU: the smallest") << 3.0 << 3.0;
}

void TestMask::valuesBecomeAir() {
  QFETCH(double, low);
  QFETCH(double, air);
  const auto value = [low](glm::dvec3 x) { return x.x < 1 ? low : 50 + x.x; };
  const VolumePtr volume = volumeOf<std::int16_t>({8, 8, 8}, glm::dmat3(1), value);
  Lasso lasso = square(2.5);
  lasso.origin = volume->geometry().centre();
  const Result<VolumePtr> cut = masked(*volume, maskOf({lasso}));
  QVERIFY(cut.ok());
  const BitMask kept = keptVoxels(*volume, maskOf({lasso}));
  QVERIFY(!kept.empty());
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i)
        QCOMPARE((*cut)->value(i, j, k), kept.at({i, j, k}) ? volume->value(i, j, k) : float(air));
  QVERIFY((*cut)->geometry() == volume->geometry());
  QVERIFY((*cut)->attributes().cut == (Cut{false, 1}));
}

void TestMask::textsNameWhatWasCut() {
  QCOMPARE(cutText({}), std::string());
  QCOMPARE(cutText({true, 0}), std::string("table removed"));
  QCOMPARE(cutText({false, 1}), std::string("1 outline"));
  QCOMPARE(cutText({true, 2}), std::string("2 outlines, table removed"));
}

void TestMask::cuttingFurtherIsTheSameAsAnew_data() {
  QTest::addColumn<bool>("table");
  QTest::addColumn<double>("low");
  for (const bool table : {false, true})
    for (const double low : {-1024.0, -400.0, 3.0}) {
      if (table && low > -1000) continue;
      QTest::addRow("%s, values from %g", table ? "without its table" : "outlines alone", low)
          << table << low;
    }
}

// The first part has up to three random outlines, the second one or two.
void TestMask::cuttingFurtherIsTheSameAsAnew() {
  QFETCH(bool, table);
  QFETCH(double, low);
  std::mt19937 random(8);
  const auto value = [low](glm::dvec3 x) { return low + std::abs(x.x) * 37 + std::abs(x.y * x.z); };
  const VolumePtr volume =
      table ? CtWithTable::volume(true) : volumeOf<std::int16_t>({19, 14, 11}, glm::dmat3(1.1), value);
  int different = 0;
  for (int n = 0; n < (table ? 6 : 40); ++n) {
    std::vector<Lasso> lassos(1 + random() % 5);
    for (Lasso& lasso : lassos) {
      lasso = anyLasso(random, random() % 2, random() % 2);
      lasso.origin += volume->geometry().centre();
    }
    Mask mask = maskOf(lassos);
    mask.tableRemoved = table;
    Mask first = mask;
    first.lassos.resize(lassos.size() - 1 - (lassos.size() > 1 ? random() % 2 : 0));
    const Result<VolumePtr> anew = masked(*volume, mask), before = masked(*volume, first);
    QVERIFY(anew.ok() && before.ok());
    const auto further = cutFurther(**before, std::span(mask.lassos).subspan(first.lassos.size()));
    QVERIFY(further.ok());
    QVERIFY((*further)->stored() == (*anew)->stored());
    different += (*before)->stored() != (*anew)->stored();
    QVERIFY((*further)->attributes().cut == (Cut{table, int(lassos.size())}));
  }
  QVERIFY2(different > 3, "the outlines cut nothing");
}

void TestMask::cancelledIsToldSo() {
  const CancelToken cancel;
  cancel.cancel();
  QVERIFY(masked(*CtWithTable::volume(true), maskOf({square(3)}), cancel).message().find("cancelled") !=
          std::string::npos);
}

VOLUMEN_TEST(TestMask);
#include "tst_mask.moc"
