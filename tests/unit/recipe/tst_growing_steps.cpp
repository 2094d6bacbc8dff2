// Guards the recipe step that grows segments from seeds: same result as the kernel, with the step's margin,
// limits and locked segments.
#include <algorithm>
#include <glm/common.hpp>
#include <limits>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/grids.h"
#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/recipe/column_masks.h"
#include "tests/unit/suite.h"
#include "viewer/recipe/recipe.h"
#include "viewer/segment/grow_from_seeds.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

class TestGrowingSteps : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void seedsGrowAsTheKernelSays();
  void ofEqualPathsTheSeedNamedFirstWins();
  void growingNeedsTwoSeeds();
};

// Compares with grown_from_seeds.h, with a separately calculated margin. Segments come in any order and share
// no voxel. The step read back from its JSON must give the same result.
void TestGrowingSteps::seedsGrowAsTheKernelSays() {
  const Seeds cases = seedsOf(60, 2000);
  int cut = 0;
  for (int seed = cases.first; seed < cases.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const Grid& grid = grids[chance.below(int(std::size(grids)))];
    const VolumePtr volume =
        volumeOf<std::int16_t>({1 + chance.below(40), 1 + chance.below(20), 1 + chance.below(12)},
                               grid.patientFromVoxelStep, [&](dvec3) { return chance.below(50); });
    const VoxelGeometry& geometry = volume->geometry();
    constexpr int locked = 4;
    LabelEdit edit{LabelMap(geometry)};
    BitMask within = inverted(BitMask(geometry)), seedsIn(geometry);
    const bool isLimited = chance.oneIn(2), isEverywhere = chance.oneIn(2);
    for (int k = 0; k < geometry.size.z; ++k)
      for (int j = 0; j < geometry.size.y; ++j)
        for (int i = 0; i < geometry.size.x; ++i) {
          const int label = chance.oneIn(20) ? 1 + chance.below(4) : 0;
          const bool isOut = isLimited && chance.oneIn(4);
          edit.set({i, j, k}, std::uint8_t(label));
          within.set({i, j, k}, !isOut && label != locked);
          seedsIn.set({i, j, k}, !isOut && label > 0 && label != locked);
        }
    const LabelMap labels = edit.done();
    SeedGrowth growth{.within = &within};
    growth.marginMm = std::numeric_limits<double>::infinity();
    if (const auto box = seedsIn.box(); box && !isEverywhere) {
      const dvec3 mm = geometry.spacing(), edges = dvec3(box->high - box->low + 1) * mm;
      growth.marginMm =
          std::max(std::max({edges.x, edges.y, edges.z}) / 10, 3 * std::max({mm.x, mm.y, mm.z}));
    }
    LabelMap seeds = withLabel(labels, locked, BitMask(geometry));
    const auto expected = grownFromSeeds(*volume, seeds, growth);
    NamedMasks masks;
    const std::vector<std::string> names{"A", "B", "C", "Locked"};
    for (int n = 0; n < 4; ++n) masks.emplace(names[std::size_t(n)], maskOf(labels, std::uint8_t(n + 1)));
    masks.emplace("Limit", united(within, masks.at("Locked")));
    Step step{"growFromSeeds",
              "A",
              {{"with", std::vector<std::string>{"B", "C"}}, {"locked", std::vector<std::string>{"Locked"}}}};
    if (isLimited) step.fields["within"] = std::string("Limit");
    if (isEverywhere) step.fields["region"] = std::string("everywhere");
    const auto read = readSteps(stepsJson({step}));
    QVERIFY2(read && read->front() == step, read ? "other fields" : read.message().c_str());
    const BitMask lockedBefore = masks.at("Locked");
    const Status made = runStep(read->front(), *volume, masks);
    QVERIFY2(made.ok() == expected.ok(), qPrintable(QString::number(seed)));
    if (!made) continue;
    for (int n = 0; n < 3; ++n)
      QVERIFY2(masks.at(names[std::size_t(n)]) == maskOf(*expected, std::uint8_t(n + 1)),
               qPrintable(QString::number(seed)));
    QVERIFY(masks.at("Locked") == lockedBefore);
    cut += isLimited;
  }
  QVERIFY2(cut > cases.count / 5, "or the cases show little");
}

void TestGrowingSteps::ofEqualPathsTheSeedNamedFirstWins() {
  const VolumePtr volume = volumeOf<std::int16_t>({5, 1, 1}, glm::dmat3(1), [](dvec3) { return 0; });
  BitMask left(volume->geometry()), right(volume->geometry());
  left.set({0, 0, 0}), right.set({4, 0, 0});
  for (const auto& [first, second] : {std::pair("L", "R"), std::pair("R", "L")}) {
    NamedMasks masks{{"L", left}, {"R", right}};
    QVERIFY(runStep({"growFromSeeds", first, {{"with", std::vector<std::string>{second}}}}, *volume, masks));
    QCOMPARE(masks.at(first).count(), std::int64_t(3));
    QCOMPARE(masks.at(second).count(), std::int64_t(2));
  }
}

void TestGrowingSteps::growingNeedsTwoSeeds() {
  const VolumePtr volume = sixteen();
  NamedMasks masks{{"A", columnsOf(*volume, {2})}, {"B", BitMask(volume->geometry())}};
  const NamedMasks before = masks;
  const Status made =
      runStep({"growFromSeeds", "A", {{"with", std::vector<std::string>{"B"}}}}, *volume, masks);
  QVERIFY(!made && masks == before);
  const QString says = QString::fromStdString(made.message());
  QVERIFY2(says.startsWith(QStringLiteral("growFromSeeds: seeds of at least two segments")),
           qPrintable(says));
  QVERIFY(!readSteps(R"([{"step": "growFromSeeds", "segment": "A"}])"));
}

VOLUMEN_TEST(TestGrowingSteps);
#include "tst_growing_steps.moc"
