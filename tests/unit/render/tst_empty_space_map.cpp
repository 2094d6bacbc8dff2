// Guards design.md 5, empty blocks: a packet of rays is skipped only if nothing within its reach is visible.
#include <random>

#include "tests/unit/suite.h"
#include "viewer/acceleration/empty_space_map.h"

namespace {

using namespace volumen;

std::vector<std::uint8_t> someVisible(glm::ivec3 count, int oneOf) {
  std::minstd_rand random(7);
  std::vector<std::uint8_t> visible(std::size_t(count.x) * count.y * count.z);
  for (auto& v : visible) v = random() % unsigned(oneOf) == 0;
  return visible;
}

// Returns for each block `bit` if any block up to `farther` along each axis is visible, else 0. Tests the
// blocks one by one.
std::vector<std::uint8_t> near(glm::ivec3 count, const std::vector<std::uint8_t>& visible, glm::ivec3 farther,
                               std::uint8_t bit) {
  std::vector<std::uint8_t> out;
  for (int k = 0; k < count.z; ++k)
    for (int j = 0; j < count.y; ++j)
      for (int i = 0; i < count.x; ++i) {
        bool any = false;
        for (int c = k; c <= std::min(k + farther.z, count.z - 1); ++c)
          for (int b = j; b <= std::min(j + farther.y, count.y - 1); ++b)
            for (int a = i; a <= std::min(i + farther.x, count.x - 1); ++a)
              any = any || visible[(std::size_t(c) * count.y + b) * count.x + a];
        out.push_back(any ? bit : 0);
      }
  return out;
}

}  // namespace

class TestEmptySpaceMap : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void nearBlocksAreThoseInReach_data();
  void nearBlocksAreThoseInReach();
};

void TestEmptySpaceMap::nearBlocksAreThoseInReach_data() {
  QTest::addColumn<int>("x");
  QTest::addColumn<int>("y");
  QTest::addColumn<int>("z");
  QTest::addColumn<int>("reach");
  for (const int reach : {1, 2, 3, 8}) {
    const QByteArray suffix = ", reach " + QByteArray::number(reach);
    QTest::newRow(("a box of blocks" + suffix).constData()) << 19 << 7 << 9 << reach;
    QTest::newRow(("one block" + suffix).constData()) << 1 << 1 << 1 << reach;
    QTest::newRow(("one column" + suffix).constData()) << 1 << 12 << 3 << reach;
    QTest::newRow(("one slice" + suffix).constData()) << 40 << 30 << 1 << reach;
  }
}

void TestEmptySpaceMap::nearBlocksAreThoseInReach() {
  QFETCH(int, x);
  QFETCH(int, y);
  QFETCH(int, z);
  QFETCH(int, reach);
  const glm::ivec3 count(x, y, z);
  const auto visible = someVisible(count, 40), before = someVisible(count, 2);
  // The map reuses the memory of another map.
  const EmptySpaceMap map =
      makeEmptySpaceMap(2, count, visible, reach, makeEmptySpaceMap(4, count, before, 1));
  QCOMPARE(map.reach, reach);
  QCOMPARE(map.shift, 1);
  const int layers = std::min(reach, 3);
  const int row = (x + 7) / 8 * 8;
  QCOMPARE(map.near.size(), std::size_t(row * y * z + (layers - 1) * row * y * z / 8 + 4));
  const auto blocks = [&](const auto& ofBlock) {
    std::vector<std::uint8_t> part;
    for (int n = 0; n < x * y * z; ++n) part.push_back(ofBlock(std::size_t(n / x * row + n % x)));
    return part;
  };
  const auto near0 = [&](std::uint8_t bits) {
    return blocks([&](std::size_t n) { return std::uint8_t(map.near[n] & bits); });
  };
  const auto packed = [&](int layer) {
    return blocks(
        [&](std::size_t n) { return std::uint8_t(map.near[map.layerAt(layer) + n / 8] >> n % 8 & 1); });
  };
  for (int farther = 0; farther < 8; ++farther) {
    const auto bit = std::uint8_t(1 << farther);
    QCOMPARE(near0(bit), near(count, visible, {farther & 1, farther >> 1 & 1, farther >> 2}, bit));
  }
  if (layers > 1) QCOMPARE(packed(layers - 1), near(count, visible, glm::ivec3(reach), 1));
  if (layers > 2) QCOMPARE(packed(1), near(count, visible, glm::ivec3(reach - 1), 1));
}

VOLUMEN_TEST(TestEmptySpaceMap);
#include "tst_empty_space_map.moc"
