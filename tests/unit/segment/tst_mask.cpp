// Guards what scissors cut away: the same voxels as by angles and windings one by one, along the lines of
// sight of any camera, whatever the grid.
#include <cmath>
#include <numbers>
#include <random>

#include "tests/fixtures/ct_with_table.h"
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

// A sheared, oblique grid of unequal steps.
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

// A freehand outline: a ragged ring, crossing itself now and then.
Lasso anyLasso(std::mt19937& random, bool perspective, bool inside) {
  std::uniform_real_distribution<double> one(-1, 1);
  Lasso lasso;
  const glm::dvec3 forward = glm::normalize(glm::dvec3(one(random), one(random), one(random)));
  lasso.right = glm::normalize(glm::cross(forward, glm::dvec3(one(random), one(random), one(random))));
  lasso.down = glm::cross(forward, lasso.right);
  lasso.perspective = perspective;
  lasso.inside = inside;
  lasso.origin = perspective ? -40.0 * forward + glm::dvec3(one(random)) : glm::dvec3(one(random));
  const int count = 3 + int(random() % 60);
  const double size = perspective ? 0.2 : 7;
  for (int n = 0; n < count; ++n) {
    const double angle = 2 * std::numbers::pi * n / count, radius = size * (0.75 + 0.5 * one(random));
    lasso.points.push_back(radius * glm::dvec2(std::cos(angle), std::sin(angle)) + 0.2 * size * one(random));
  }
  return lasso;
}

// How often the outline goes around a point, by the angles that its corners are seen under.
int windingByAngles(const std::vector<glm::dvec2>& points, glm::dvec2 p) {
  double sum = 0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const glm::dvec2 a = points[n] - p, b = points[(n + 1) % points.size()] - p;
    sum += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
  }
  return int(std::lround(sum / (2 * std::numbers::pi)));
}

bool isCut(const Lasso& lasso, glm::dvec3 p) {
  const glm::dvec3 d = p - lasso.origin, forward = glm::cross(lasso.right, lasso.down);
  glm::dvec2 seen(glm::dot(d, lasso.right), glm::dot(d, lasso.down));
  bool isInside = true;
  if (lasso.perspective) {
    isInside = glm::dot(d, forward) > 0;
    seen /= glm::dot(d, forward);
  }
  return (isInside && windingByAngles(lasso.points, seen) != 0) == lasso.inside;
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
          const bool gone = isCut(lasso, grid.patientFromVoxel({i, j, k}));
          cut += gone;
          QVERIFY2(kept.at({i, j, k}) == !gone,
                   qPrintable(QStringLiteral("round %1: %2 %3 %4").arg(round).arg(i).arg(j).arg(k)));
        }
    someCut += cut > 0 && cut < grid.voxelCount();
  }
  QVERIFY2(someCut > 30, "or the rounds show little");
}

void TestMask::whatAnOutlineCrossesItselfAroundIsInside() {
  VoxelGeometry grid;
  grid.size = {9, 9, 1};
  grid.origin = {-4, -4, 0};
  // Twice around: by the even-odd rule its middle would stay.
  Lasso twice = square(2.5);
  const std::vector<glm::dvec2> once = twice.points;
  twice.points.insert(twice.points.end(), once.begin(), once.end());
  QCOMPARE(keptOf(volumeOn(grid), maskOf({twice})), 81 - 25);
}

void TestMask::whatIsBehindTheEyeIsNotInside_data() {
  QTest::addColumn<bool>("inside");
  QTest::addColumn<int>("kept");
  // Of 21 voxels along z the eye is in the 11th: ten are in front of it.
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

// By chance, a first part of up to three outlines and a second of one or two.
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
