// Guards the recipe steps that find something: balls and strokes against distances, Otsu's threshold,
// lesions, scissors, and the airway tree of a phantom that leaks.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/grids.h"
#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/recipe/column_masks.h"
#include "tests/unit/segment/bit_masks.h"
#include "tests/unit/segment/lassos.h"
#include "tests/unit/suite.h"
#include "viewer/recipe/recipe.h"
#include "viewer/recipe/scissors.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

class TestRecipeSteps : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void strokesAreWhatABallCovers();
  void otsuPartsTwoTissues();
  void lesionsAreTheirShareOfTheLargestValue_data();
  void lesionsAreTheirShareOfTheLargestValue();
  void aLesionThatReachesOutIsRefused();
  void partsAreTakenBySize();
  void islandsLeaveNoCrumbs();
  void marginsReachSoFar();
  void allAreSmoothedAtOnce();
  void scissorsCutAsTheirLassoDoes();
  void scissorsThatSeeNothingAreRefused_data();
  void scissorsThatSeeNothingAreRefused();
  void whatWasMadeByHandIsRefused();
  void theAirTreeStopsBeforeItLeaks_data();
  void theAirTreeStopsBeforeItLeaks();
};

namespace {

using Places = std::vector<dvec3>;

BitMask done(const Step& step, const Volume& volume, NamedMasks masks = {}) {
  const Status made = runStep(step, volume, masks);
  if (!made) throw std::runtime_error(made.message());
  return masks.at(step.segment);
}

// Returns the distance to a line segment by golden-section search, as it has a single minimum.
double fromLine(dvec3 p, dvec3 a, dvec3 b) {
  double low = 0, high = 1;
  for (int n = 0; n < 60; ++n) {
    const double first = low + 0.382 * (high - low), second = high - 0.382 * (high - low);
    if (glm::distance(p, glm::mix(a, b, first)) < glm::distance(p, glm::mix(a, b, second)))
      high = second;
    else
      low = first;
  }
  return glm::distance(p, glm::mix(a, b, (low + high) / 2));
}

constexpr double lungHu = -860, airHu = -1000, wallHu = -100;

// A chest: a body, two lungs, and a trachea of 9 mm radius that forks into two tubes. The tubes leak into the
// lungs above -870 HU. Coordinates are in mm from the middle, z upwards.
double fromTube(dvec3 p) {
  if (p.z > 20) return glm::length(dvec3(p.x, p.y, 0)) - 9;
  return fromLine(p, {0, 0, 20}, {p.x < 0 ? -45 : 45, 0, -20}) - 5;
}
double chestHu(dvec3 p) {
  if (glm::length(dvec3(p.x / 90, p.y / 60, 0)) > 1) return airHu;
  const bool isLung = glm::length(dvec3((std::abs(p.x) - 45) / 28, p.y / 40, (p.z + 10) / 50)) < 1;
  const double tube = fromTube(p);
  if (tube < 0) return airHu;
  return isLung ? lungHu : tube < 2.5 ? wallHu : 40;
}

VolumePtr chest(dvec3 mm, glm::ivec3 size, bool isUpsideDown) {
  const glm::dmat3 step(mm.x, 0, 0, 0, mm.y, 0, 0, 0, isUpsideDown ? -mm.z : mm.z);
  VolumePtr made = volumeOf<std::int16_t>(
      size, step, [&](dvec3 v) { return chestHu(step * (v - (dvec3(size) - 1.0) / 2.0)); });
  VolumeParts parts{made->geometry(), made->stored(), 1, 0, {}};
  parts.attributes.modality = "CT";
  return volumeFrom(std::move(parts));
}

}  // namespace

// Points within 1e-6 mm of the border are not compared.
void TestRecipeSteps::strokesAreWhatABallCovers() {
  const Seeds seeds = seedsOf(60, 2000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const Grid& grid = grids[chance.below(int(std::size(grids)))];
    const glm::ivec3 size(1 + chance.below(20), 1 + chance.below(12), 1 + chance.below(8));
    const VolumePtr volume = volumeOf<std::int16_t>(size, grid.patientFromVoxelStep, [](dvec3) { return 0; });
    Places at(std::size_t(1 + chance.below(3)));
    for (dvec3& p : at) p = 8.0 * chance.vector();
    const double radius = chance.between(0, 5);
    const BitMask stroke = done({"paint", "A", {{"at", at}, {"radiusMm", radius}}}, *volume);
    for (int k = 0; k < size.z; ++k)
      for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i) {
          const dvec3 p = volume->geometry().patientFromVoxel({i, j, k});
          double mm = glm::distance(p, at[0]);
          for (std::size_t n = 1; n < at.size(); ++n) mm = std::min(mm, fromLine(p, at[n - 1], at[n]));
          if (std::abs(mm - radius) > 1e-6)
            QVERIFY2(stroke.at({i, j, k}) == (mm < radius), qPrintable(QString::number(seed)));
        }
  }
}

void TestRecipeSteps::otsuPartsTwoTissues() {
  Chance chance(7);
  const VolumePtr volume = volumeOf<std::int16_t>(
      {20, 20, 20}, glm::dmat3(1), [&](dvec3 p) { return (p.x < 8 ? 100 : 400) + chance.between(-40, 40); });
  QCOMPARE(done({"otsu", "A"}, *volume).count(), std::int64_t(12 * 20 * 20));
}

void TestRecipeSteps::lesionsAreTheirShareOfTheLargestValue_data() {
  QTest::addColumn<double>("share");
  QTest::newRow("41 %") << 0.41;
  QTest::newRow("50 %") << 0.5;
}

// In a cone of 20 mm, the share s of the maximum is a ball of 20 (1 - s) mm. A second, smaller cone in the
// sphere is another component.
void TestRecipeSteps::lesionsAreTheirShareOfTheLargestValue() {
  QFETCH(double, share);
  const auto cone = [](dvec3 p) { return std::max(0.0, 1 - glm::length(p) / 20); };
  const VolumePtr volume = volumeOf<float>({81, 81, 81}, glm::dmat3(1), [&](dvec3 v) {
    const dvec3 p = v - 40.0;
    return 10 * cone(p) + 8 * std::max(0.0, 1 - glm::distance(p, dvec3(0, 30, 0)) / 5);
  });
  const NamedMasks sphere{
      {"Sphere", done({"ball", "Sphere", {{"at", Places{{0, 5, 0}}}, {"radiusMm", 38.0}}}, *volume)}};
  const BitMask found =
      done({"lesion", "A", {{"in", std::string("Sphere")}, {"share", share}}}, *volume, sphere);
  std::int64_t expected = 0;
  for (int k = 0; k < 81; ++k)
    for (int j = 0; j < 81; ++j)
      for (int i = 0; i < 81; ++i) expected += float(10 * cone(dvec3(i, j, k) - 40.0)) >= share * 10;
  QCOMPARE(found.count(), expected);
}

void TestRecipeSteps::aLesionThatReachesOutIsRefused() {
  const VolumePtr volume = volumeOf<float>({41, 41, 41}, glm::dmat3(1), [](dvec3 v) {
    return 10 * std::max(0.0, 1 - glm::length(v - 20.0) / 20);
  });
  NamedMasks sphere{
      {"Sphere", done({"ball", "Sphere", {{"at", Places{{0, 0, 0}}}, {"radiusMm", 8.0}}}, *volume)}};
  const Status found = runStep({"lesion", "A", {{"in", std::string("Sphere")}}}, *volume, sphere);
  QVERIFY(!found);
  QVERIFY(
      QString::fromStdString(found.message()).startsWith(QStringLiteral("lesion: what is found reaches")));
}

void TestRecipeSteps::partsAreTakenBySize() {
  const VolumePtr volume = sixteen();
  const NamedMasks parts{{"B", columnsOf(*volume, {0, 3, 4, 5, 9, 10})}};
  const auto part = [&](double rank) {
    return done({"part", "A", {{"other", std::string("B")}, {"rank", rank}}}, *volume, parts);
  };
  QVERIFY(part(1) == columnsOf(*volume, {3, 4, 5}));
  QVERIFY(part(2) == columnsOf(*volume, {9, 10}));
  QVERIFY(part(3) == columnsOf(*volume, {0}));
  QVERIFY(part(4).empty());
}

// A body of 4 voxels, a crumb at its corner, and a diagonal line of four voxels joined only by corners.
void TestRecipeSteps::islandsLeaveNoCrumbs() {
  const VolumePtr volume = volumeOf<std::int16_t>({12, 12, 1}, glm::dmat3(10), [](dvec3) { return 0; });
  BitMask body(volume->geometry()), line(volume->geometry()), crumb(volume->geometry());
  for (int n = 0; n < 4; ++n) body.set({n % 2, n / 2, 0}), line.set({6 + n, 6 + n, 0});
  crumb.set({2, 2, 0});
  const NamedMasks all{{"A", united(united(body, line), crumb)}};
  const auto left = [&](const char* neighbours) {
    return done({"islands", "A", {{"leastMl", 4.0}, {"neighbours", std::string(neighbours)}}}, *volume, all);
  };
  QVERIFY(left("faces") == body);
  QVERIFY(left("corners") == united(body, line));
}

void TestRecipeSteps::marginsReachSoFar() {
  const VolumePtr volume = sixteen();
  const NamedMasks two{{"A", columnsOf(*volume, {2, 3, 4, 5, 6})}, {"B", columnsOf(*volume, {5})}};
  const auto near = [&](const char* kind, double mm) {
    return done({kind, "A", {{"other", std::string("B")}, {"marginMm", mm}}}, *volume, two);
  };
  QVERIFY(near("subtract", 0) == columnsOf(*volume, {2, 3, 4, 6}));
  QVERIFY(near("subtract", 2) == columnsOf(*volume, {2}));
  QVERIFY(near("intersect", 1) == columnsOf(*volume, {4, 5, 6}));
}

// A column of B inside A becomes A's. The locked segment does not change.
void TestRecipeSteps::allAreSmoothedAtOnce() {
  const VolumePtr volume = sixteen();
  NamedMasks masks{{"A", columnsOf(*volume, {0, 1, 2, 4, 5, 6})},
                   {"B", columnsOf(*volume, {3, 7, 8, 9, 10, 11})},
                   {"C", columnsOf(*volume, {12, 14})}};
  const BitMask locked = masks.at("C");
  const Status status = runStep({"joint",
                                 "A",
                                 {{"with", std::vector<std::string>{"B"}},
                                  {"sigmaMm", 1.5},
                                  {"locked", std::vector<std::string>{"C"}}}},
                                *volume, masks);
  QVERIFY(status);
  QVERIFY(masks.at("A") == columnsOf(*volume, {0, 1, 2, 3, 4, 5, 6}));
  QVERIFY(intersected(masks.at("B"), masks.at("A")).empty() && masks.at("B").at({8, 0, 0}));
  QVERIFY(masks.at("C") == locked);
}

// The step stores positions in patient space, and its JSON holds their decimal text. No voxel of these cases
// is so near an outline that rounding would move it to the other side.
void TestRecipeSteps::scissorsCutAsTheirLassoDoes() {
  const Seeds seeds = seedsOf(100, 3000);
  int cut = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    const Grid& grid = grids[random() % std::size(grids)];
    const VolumePtr volume =
        volumeOf<std::int16_t>({20, 9, 7}, grid.patientFromVoxelStep, [](dvec3) { return 0; });
    const BitMask mask = anyMask(random, volume->geometry());
    const Lasso lasso = anyLasso(random, random() % 2, random() % 2);
    const double within = random() % 2 ? 40.3 : std::numeric_limits<double>::infinity();
    const Step step = scissorsStep("A", lasso, within);
    const auto read = readSteps(stepsJson({step}));
    QVERIFY2(read, read ? "" : read.message().c_str());
    const BitMask left = leftBy(mask, lasso, within);
    QVERIFY2(done(step, *volume, {{"A", mask}}) == left, qPrintable(QString::number(seed)));
    QVERIFY2(done(read->front(), *volume, {{"A", mask}}) == left, qPrintable(QString::number(seed)));
    cut += left != mask && !left.empty();
  }
  QVERIFY2(cut > seeds.count / 3, "or the cases show little");
}

void TestRecipeSteps::scissorsThatSeeNothingAreRefused_data() {
  QTest::addColumn<Places>("outline");
  QTest::addColumn<Places>("sight");
  QTest::addColumn<QString>("says");
  const Places triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, sight{{0, 0, -9}, {0, 0, 0}};
  QTest::newRow("an outline of two places")
      << Places{{0, 0, 0}, {1, 0, 0}} << sight << QStringLiteral("scissors: outline must be three places");
  const QString twoPlaces = QStringLiteral("scissors: sight must be two places");
  QTest::newRow("no line of sight") << triangle << Places{} << twoPlaces;
  QTest::newRow("one place") << triangle << Places{{0, 0, -9}} << twoPlaces;
  QTest::newRow("one place twice") << triangle << Places{{0, 0, -9}, {0, 0, -9}} << twoPlaces;
  QTest::newRow("three places") << triangle << Places{{0, 0, -9}, {0, 0, 0}, {0, 0, 9}} << twoPlaces;
  QTest::newRow("the outline behind the eye")
      << triangle << Places{{0, 0, 9}, {0, 0, 10}}
      << QStringLiteral("scissors: outline must lie before the first place");
}

void TestRecipeSteps::scissorsThatSeeNothingAreRefused() {
  QFETCH(Places, outline);
  QFETCH(Places, sight);
  QFETCH(QString, says);
  const VolumePtr volume = volumeOf<float>({3, 3, 3}, glm::dmat3(1), [](dvec3) { return 0; });
  NamedMasks masks{{"A", inverted(BitMask(volume->geometry()))}};
  const Step step{"scissors", "A", {{"outline", outline}, {"sight", sight}, {"perspective", true}}};
  const Status made = runStep(step, *volume, masks);
  QVERIFY(!made && masks.at("A").count() == 27);
  QVERIFY2(QString::fromStdString(made.message()).startsWith(says), made.message().c_str());
}

void TestRecipeSteps::whatWasMadeByHandIsRefused() {
  NamedMasks masks;
  const Status status = runStep({"byHand", "A"}, *sixteen(), masks);
  QVERIFY(!status && masks.empty());
  QVERIFY(QString::fromStdString(status.message()).contains(QStringLiteral("\"A\" was painted")));
}

void TestRecipeSteps::theAirTreeStopsBeforeItLeaks_data() {
  QTest::addColumn<dvec3>("mm");
  QTest::addColumn<bool>("upsideDown");
  QTest::newRow("even") << dvec3(1.5) << false;
  QTest::newRow("thick slices from above") << dvec3(1, 1, 3) << true;
}

// The lung has -860 HU. The threshold of the tree stays below it, and the result is the tubes alone.
void TestRecipeSteps::theAirTreeStopsBeforeItLeaks() {
  QFETCH(dvec3, mm);
  QFETCH(bool, upsideDown);
  const glm::ivec3 size(glm::ceil(dvec3(200, 140, 120) / mm));
  const VolumePtr volume = chest(mm, size, upsideDown);
  NamedMasks masks;
  masks.emplace("Body", done({"patient", "Body"}, *volume));
  masks.emplace("Trachea", done({"trachea", "Trachea", {{"in", std::string("Body")}}}, *volume, masks));
  const BitMask tree =
      done({"airTree", "Tree", {{"from", std::string("Trachea")}, {"mostMl", 40.0}}}, *volume, masks);
  std::int64_t tubes = 0, wrong = 0;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const dvec3 p = volume->geometry().patientFromVoxel({i, j, k});
        const bool isTube = fromTube(p) < 0;
        tubes += isTube;
        wrong += tree.at({i, j, k}) != isTube;
      }
  QVERIFY(tubes > 1000);
  QCOMPARE(wrong, std::int64_t(0));
}

VOLUMEN_TEST(TestRecipeSteps);
#include "tst_recipe_steps.moc"
