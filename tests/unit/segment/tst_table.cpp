// Guards table removal: what is removed and what stays, on any grid and in any storage type.
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <random>

#include "tests/fixtures/ct_with_table.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/segment/bit_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/mask.h"
#include "viewer/segment/table.h"

using namespace volumen;
using namespace volumen::tests;

class TestTable : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void thePatientIsTheLargestPartFilledAndGrown();
  void theTableBecomesAir_data();
  void theTableBecomesAir();
  void theSkinKeepsItsEdge();
  void onlyWhatTheFileHoldsIsWritten();
  void whatHoldsNoPatientIsRefused();
  void cancelledIsToldSo();
  void picturesLeaveOutNoPatient();
};

namespace {

using Make = VolumePtr (*)(bool table);

// Returns the patient by the definition, voxel by voxel. `axis` runs along the patient.
BitMask patientSlowly(const Volume& volume, int axis) {
  const VoxelGeometry& grid = volume.geometry();
  BitMask notAir(grid), left(grid), largest(grid);
  for (const glm::ivec3 v : voxelsOf(grid)) notAir.set(v, double(volume.value(v.x, v.y, v.z)) >= notAirHu);
  left = notAir;
  for (const glm::ivec3 v : voxelsOf(grid)) {
    if (!left.at(v)) continue;
    const BitMask part = reachedFrom({v}, notAir, stepsAcross(-1));
    left = subtracted(left, part);
    if (part.count() > largest.count()) largest = part;
  }
  const BitMask filled = filledSlowly(largest, axis);
  glm::ivec3 reach;
  for (int a = 0; a < 3; ++a) reach[a] = int(std::lround(3 / grid.spacing()[a]));
  BitMask made(grid);
  for (const glm::ivec3 v : voxelsOf(grid))
    for (const glm::ivec3 other : voxelsOf(grid))
      if (filled.at(other) && glm::all(glm::lessThanEqual(glm::abs(other - v), reach))) made.set(v);
  return made;
}

}  // namespace

Q_DECLARE_METATYPE(Make)

void TestTable::thePatientIsTheLargestPartFilledAndGrown() {
  struct Lying {
    glm::dmat3 step;
    int axis;  // along the patient
  };
  const Lying all[] = {{glm::dmat3(1), 2},
                       {{{0.5, 0, 0}, {0, 0.8, 0}, {0, 0, 2.5}}, 2},
                       {{{0.8, 0.6, 0}, {-0.48, 0.64, 0.6}, {0.72, -0.96, 1.6}}, 2},
                       {{{2, 0, 0}, {0, 0, -1.1}, {0, 7, 0}}, 1},
                       {{{0, 0.2, 1}, {1, 0, 0}, {0, 1.5, 0}}, 0}};
  const Seeds seeds = seedsOf(200, 10000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    VolumeParts parts;
    parts.geometry = anyGrid(random, {random() % 2 ? 66 : 10, 7, 6});
    const Lying& lying = all[random() % std::size(all)];
    parts.geometry.patientFromVoxelStep = lying.step;
    const BitMask mask = anyMask(random, parts.geometry);
    std::vector<std::int16_t> values;
    for (const glm::ivec3 v : voxelsOf(parts.geometry)) values.push_back(mask.at(v) ? -300 : -301);
    parts.values = std::move(values);
    const VolumePtr volume = volumeFrom(std::move(parts));
    QVERIFY2(patientMask(*volume) == patientSlowly(*volume, lying.axis), caseOf(seed, mask).c_str());
  }
}

void TestTable::theTableBecomesAir_data() {
  QTest::addColumn<Make>("make");
  QTest::newRow("HU as they are stored") << Make([](bool t) { return CtWithTable::volume(t); });
  QTest::newRow("unsigned, from -1024 on")
      << Make([](bool t) { return CtWithTable::volume<std::uint16_t>(t, 1, -1024); });
  QTest::newRow("a slope of its own")
      << Make([](bool t) { return CtWithTable::volume<std::uint16_t>(t, 0.5, -1024); });
  QTest::newRow("floats") << Make([](bool t) { return CtWithTable::volume<float>(t); });
  QTest::newRow("coronal slices") << Make(
      [](bool t) { return CtWithTable::volume<std::int16_t>(t, 1, 0, true); });
}

// Lungs, which are open above and below, and the rest of the patient stay unchanged byte for byte.
void TestTable::theTableBecomesAir() {
  QFETCH(Make, make);
  const VolumePtr with = make(true), alone = make(false);
  const Result<VolumePtr> removed = masked(*with, {true, {}});
  QVERIFY(removed.ok());
  QVERIFY((*removed)->stored() == alone->stored());
  QVERIFY((*removed)->geometry() == with->geometry());
  QVERIFY((*removed)->attributes().cut.table);
  QVERIFY(!with->attributes().cut.table);
}

void TestTable::theSkinKeepsItsEdge() {
  // The skin has a soft edge: -700 and -900 HU in the two voxels before it.
  const auto value = [](glm::dvec3 x) {
    if (x.x >= 20) return 40.0;
    return x.x >= 19 ? -700.0 : x.x >= 18 ? -900.0 : x.x < 4 ? 0.0 : -1000.0;
  };
  const VolumePtr volume = volumeOf<std::int16_t>({40, 10, 10}, glm::dmat3(1.5), value);
  const Result<VolumePtr> removed = masked(*volume, {true, {}});
  QVERIFY(removed.ok());
  QCOMPARE((*removed)->value(19, 5, 5), -700.f);
  QCOMPARE((*removed)->value(18, 5, 5), -900.f);
  QCOMPARE((*removed)->value(2, 5, 5), -1000.f);
}

void TestTable::onlyWhatTheFileHoldsIsWritten() {
  // The file holds no air, so that its lowest value is used.
  const auto value = [](glm::dvec3 x) { return x.x < 5 ? 200.0 : x.x < 12 ? -400.0 : 40.0; };
  const VolumePtr volume = volumeOf<std::int16_t>({40, 10, 10}, glm::dmat3(1), value);
  const Result<VolumePtr> removed = masked(*volume, {true, {}});
  QVERIFY(removed.ok());
  QCOMPARE((*removed)->value(0, 5, 5), -400.f);
}

void TestTable::whatHoldsNoPatientIsRefused() {
  const VolumePtr air = volumeOf<std::int16_t>({8, 8, 8}, glm::dmat3(1), [](glm::dvec3) { return -1000; });
  QVERIFY(masked(*air, {true, {}}).message().find("nothing in this series is above -300 HU") !=
          std::string::npos);
}

void TestTable::cancelledIsToldSo() {
  const CancelToken cancel;
  cancel.cancel();
  QVERIFY(masked(*CtWithTable::volume(true), {true, {}}, cancel).message().find("cancelled") !=
          std::string::npos);
}

// Two legs do not touch, and the table has a twentieth of a leg's size.
void TestTable::picturesLeaveOutNoPatient() {
  const auto made = [](bool secondLeg, bool table) {
    return volumeOf<std::int16_t>({40, 40, 10}, glm::dmat3(2), [=](glm::dvec3 x) {
      const auto inside = [&](double cx) { return std::hypot(x.x - cx, x.y - 14) < 8; };
      if (inside(9) || (secondLeg && inside(29))) return 40.0;
      return table && x.y == 30 && x.x < 12 ? 400.0 : -1000.0;
    });
  };
  QVERIFY2(!patientBesideTable(*made(true, false)), "there is no table");
  QVERIFY(!patientBesideTable(*made(false, false)));
  const auto patient = patientBesideTable(*made(true, true));
  QVERIFY(patient);
  QVERIFY(patient->at({9, 14, 5}) && patient->at({29, 14, 5}));
  QVERIFY(!patient->at({5, 30, 5}));
  const auto leg = patientMask(*made(true, true));
  QVERIFY2(leg.at({9, 14, 5}) != leg.at({29, 14, 5}), "removed by hand, one of two that are alike goes");
}

VOLUMEN_TEST(TestTable);
#include "tst_table.moc"
