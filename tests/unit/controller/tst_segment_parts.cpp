// Guards what clicks on connected components take without a window: which voxels touch, and the leak guard.
#include <algorithm>

#include "results/segments/segment_record.h"
#include "tests/unit/controller/editing.h"
#include "tests/unit/suite.h"
#include "viewer/segment/parts.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentParts : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void voxelsTouchAsChosen_data();
  void voxelsTouchAsChosen();
  void aLeakGuardStopsAtThinBridges_data();
  void aLeakGuardStopsAtThinBridges();
};

void TestSegmentParts::voxelsTouchAsChosen_data() {
  QTest::addColumn<QString>("word");
  QTest::addColumn<int>("touching");
  QTest::addColumn<int>("use");
  int touching = 1;
  for (const char* word : {"faces", "edges", "corners"}) {
    for (const auto& [name, use] : {std::pair("added", PartUse::add), std::pair("kept", PartUse::keep),
                                    std::pair("removed", PartUse::remove)})
      QTest::addRow("by %s, %s", word, name) << QString::fromLatin1(word) << touching << int(use);
    ++touching;
  }
}

// The first voxel is clicked. One of the others shares a face with it, one an edge, one only a corner. They
// do not touch each other, and the last touches none.
void TestSegmentParts::voxelsTouchAsChosen() {
  QFETCH(QString, word);
  QFETCH(int, touching);
  QFETCH(int, use);
  static constexpr glm::ivec3 voxels[] = {
      {20, 20, 20}, {21, 20, 20}, {19, 21, 20}, {19, 19, 21}, {25, 25, 25}};
  auto series = std::make_shared<LoadedSeries>(*hollowBalls());
  series->volume = volumeOf<std::int16_t>(glm::ivec3(40), glm::dmat3(1), [](glm::dvec3 pVoxel) {
    return std::ranges::count(voxels, glm::ivec3(glm::round(pVoxel))) > 0 ? 1000.0 : 0.0;
  });
  Editing e(series);
  BitMask part(e.grid()), all(e.grid());
  for (int n = 0; n < 5; ++n) {
    all.set(voxels[n]);
    if (n <= touching) part.set(voxels[n]);
  }
  e.choose([&](SegmentOptions& o) {
    o.range = {500, 1500};
    o.neighbours = word.toStdString();
    o.partUse = PartUse(use);
  });
  if (PartUse(use) != PartUse::add) e.add({500, 1500});
  e.part(glm::dvec3(0.5));
  QVERIFY(e.idle());
  QVERIFY(e.mask() == (PartUse(use) == PartUse::remove ? subtracted(all, part) : part));
  if (PartUse(use) != PartUse::add) return;
  const RecordedRecipe recorded = recordedRecipe(*e.map(), "CT");
  const auto followed = follow(recorded.recipe, *series->volume);
  QVERIFY(followed && maskOf(followed->labels, 1) == e.mask());
}

void TestSegmentParts::aLeakGuardStopsAtThinBridges_data() {
  QTest::addColumn<double>("guard");
  QTest::addColumn<int>("use");
  QTest::newRow("off: both balls are added") << 0.0 << int(PartUse::add);
  QTest::newRow("wider than the rod: one is added") << 2.0 << int(PartUse::add);
  QTest::newRow("one is kept") << 2.0 << int(PartUse::keep);
  QTest::newRow("one is removed") << 2.0 << int(PartUse::remove);
}

void TestSegmentParts::aLeakGuardStopsAtThinBridges() {
  QFETCH(double, guard);
  QFETCH(int, use);
  Editing e(joinedBalls());
  e.choose([&](SegmentOptions& o) {
    o.range = {500, 1500};
    o.leakGuardMm = guard;
    o.partUse = PartUse(use);
  });
  if (PartUse(use) != PartUse::add) e.add({500, 1500});
  e.part(inLeftBall);
  QVERIFY(e.idle());
  const BitMask both = voxelsInRange(*e.series->volume, {500, 1500});
  const glm::ivec3 seed(glm::round(e.grid().voxelFromPatient(inLeftBall)));
  const BitMask left = connectedBeyond(both, std::span(&seed, 1), Neighbours::faces, 2);
  QVERIFY(!left.empty() && left != both);
  QVERIFY(e.mask() == (guard == 0 ? both : PartUse(use) == PartUse::remove ? subtracted(both, left) : left));
  if (PartUse(use) != PartUse::add) return;
  const RecordedRecipe recorded = recordedRecipe(*e.map(), "CT");
  QVERIFY(recorded.missing.empty());
  const auto again = readRecipe(recipeJson(recorded.recipe));
  QVERIFY(again && (recipeJson(*again).find("leakGuardMm") != std::string::npos) == (guard > 0));
  const auto followed = follow(*again, *e.series->volume);
  QVERIFY(followed && maskOf(followed->labels, 1) == e.mask());
}

VOLUMEN_TEST(TestSegmentParts);
#include "tst_segment_parts.moc"
