// Guards the patient without the table: what is taken away, what stays, in any grid and storage.
#include <limits>
#include <random>

#include "tests/fixtures/ct_with_table.h"
#include "tests/unit/suite.h"
#include "viewer/segment/components.h"
#include "viewer/segment/mask.h"

using namespace volumen;
using namespace volumen::tests;

class TestTable : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void largestComponentIsThatOfAFloodFill_data();
  void largestComponentIsThatOfAFloodFill();
  void nothingLabelledStaysNothing();
  void theTableBecomesAir_data();
  void theTableBecomesAir();
  void theSkinKeepsItsEdge();
  void onlyWhatTheFileHoldsIsWritten();
  void whatHoldsNoPatientIsRefused();
  void cancelledIsToldSo();
};

namespace {

// The same by going from voxel to voxel.
std::vector<std::uint8_t> byFloodFill(const DenseLabels& map) {
  const glm::ivec3 size = map.geometry.size;
  std::vector<std::uint8_t> seen(map.labels.size()), best(map.labels.size());
  std::size_t most = 0;
  for (std::size_t start = 0; start < map.labels.size(); ++start) {
    if (!map.labels[start] || seen[start]) continue;
    std::vector<std::size_t> part{start};
    seen[start] = 1;
    for (std::size_t n = 0; n < part.size(); ++n) {
      const int i = int(part[n]) % size.x, j = int(part[n]) / size.x % size.y,
                k = int(part[n]) / size.x / size.y;
      const auto visit = [&](int x, int y, int z) {
        if (x < 0 || y < 0 || z < 0 || x >= size.x || y >= size.y || z >= size.z) return;
        const std::size_t at = (std::size_t(z) * size.y + y) * size.x + x;
        if (map.labels[at] && !seen[at]) part.push_back(at), seen[at] = 1;
      };
      visit(i - 1, j, k), visit(i + 1, j, k), visit(i, j - 1, k), visit(i, j + 1, k), visit(i, j, k - 1),
          visit(i, j, k + 1);
    }
    if (part.size() <= most) continue;
    most = part.size();
    best.assign(best.size(), 0);
    for (const std::size_t n : part) best[n] = 1;
  }
  return best;
}

using Make = VolumePtr (*)(bool table);

}  // namespace

Q_DECLARE_METATYPE(Make)

void TestTable::largestComponentIsThatOfAFloodFill_data() {
  QTest::addColumn<int>("ofHundred");
  // Around a third of the voxels the parts grow together.
  for (int share : {5, 20, 30, 33, 40, 100}) QTest::addRow("%d %% labelled", share) << share;
}

void TestTable::largestComponentIsThatOfAFloodFill() {
  QFETCH(int, ofHundred);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 bits(seed);
    DenseLabels map{{.size = {13, 11, 7}}, std::vector<std::uint8_t>(13 * 11 * 7)};
    for (auto& label : map.labels) label = int(bits() % 100) < ofHundred;
    QVERIFY(largestComponent(map).labels == byFloodFill(map));
  }
}

void TestTable::nothingLabelledStaysNothing() {
  const DenseLabels map{{.size = {3, 3, 3}}, std::vector<std::uint8_t>(27)};
  QVERIFY(largestComponent(map).labels == map.labels);
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

// Lungs, which are open above and below, and all else of the patient stay as they are, byte for byte.
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
  // A soft edge: -700 and -900 HU in the two voxels before the skin's.
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
  // No air in it: the nearest there is.
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

VOLUMEN_TEST(TestTable);
#include "tst_table.moc"
