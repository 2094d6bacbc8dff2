// Guards design.md 5, empty blocks: a block's bounds enclose all its values and are close to them.
#include <algorithm>
#include <random>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/volume/block_ranges.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

using Values = std::vector<float>;

/// Returns `count` random values, `value` of a uniform number in 0..1.
Values chance(int count, unsigned seed, float (*value)(float)) {
  std::minstd_rand random(seed);
  std::uniform_real_distribution<float> share(0, 1);
  Values values(count);
  for (float& v : values) v = value(share(random));
  return values;
}

/// Returns whether `level` is the nearest one at or below `value` (`up`: at or above).
bool isNext(const Values& levels, float level, float value, bool up) {
  const auto at = up ? std::lower_bound(levels.begin(), levels.end(), value)
                     : std::upper_bound(levels.begin(), levels.end(), value) - 1;
  return *at == level;
}

}  // namespace

Q_DECLARE_METATYPE(Values)

class TestBlockRanges : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void blocksBoundEveryVoxel_data();
  void blocksBoundEveryVoxel();
  void levelsLieNextToValues_data();
  void levelsLieNextToValues();
};

void TestBlockRanges::blocksBoundEveryVoxel_data() {
  QTest::addColumn<VolumePtr>("volume");
  QTest::addColumn<int>("edge");
  const auto row = [](const char* name, const VolumePtr& volume, int edge) {
    QTest::newRow(name) << volume << edge;
  };
  row("few voxels: blocks of one cell", randomVolume<std::int16_t>({17, 5, 9}, -1000, 1000), 1);
  row("one voxel", randomVolume<std::uint8_t>({1, 1, 1}, 0, 255), 1);
  row("one column", randomVolume<float>({1, 40, 1}, -1, 1), 1);
  row("32 voxels an edge", randomVolume<std::uint8_t>({32, 32, 32}, 0, 255), 1);
  row("more: of two", randomVolume<std::uint16_t>({33, 32, 32}, 0, 65535, -2.5, -100), 2);
  row("64 voxels an edge", randomVolume<float>({64, 64, 64}, -1, 1), 2);
  row("more: of four", randomVolume<std::int16_t>({67, 65, 62}, -32768, 32767), 4);
  row("floats", randomVolume<float>({131, 50, 41}, -1e30f, 1e-30f), 4);
}

void TestBlockRanges::blocksBoundEveryVoxel() {
  QFETCH(VolumePtr, volume);
  QFETCH(int, edge);
  const glm::ivec3 size = volume->size();
  const BlockRanges b = blockRanges(*volume);
  QCOMPARE(b.edge, edge);
  QCOMPARE(b.count, (size + (edge - 1)) / edge);
  QVERIFY(b.levels.size() <= 256 && std::is_sorted(b.levels.begin(), b.levels.end()));
  std::size_t n = 0;
  for (int d = 0; d < b.count.z; ++d)
    for (int c = 0; c < b.count.y; ++c)
      for (int a = 0; a < b.count.x; ++a, ++n) {
        float low = std::numeric_limits<float>::max(), high = -low;
        const glm::ivec3 last = glm::min(glm::ivec3(a, c, d) * edge + edge, size - 1);
        for (int k = d * edge; k <= last.z; ++k)
          for (int j = c * edge; j <= last.y; ++j)
            for (int i = a * edge; i <= last.x; ++i) {
              low = std::min(low, volume->value(i, j, k));
              high = std::max(high, volume->value(i, j, k));
            }
        QVERIFY2(isNext(b.levels, b.low(n), low, false) && isNext(b.levels, b.high(n), high, true),
                 qPrintable(QStringLiteral("%1, %2, %3").arg(a).arg(c).arg(d)));
      }
}

void TestBlockRanges::levelsLieNextToValues_data() {
  QTest::addColumn<Values>("low");
  QTest::addColumn<Values>("high");
  QTest::addColumn<bool>("exact");
  const auto row = [](const char* name, const Values& low, const Values& high, bool exact) {
    QTest::newRow(name) << low << high << exact;
  };
  const auto even = [](float x) { return x; };
  const auto above = [](float x) { return 1 + x; };
  row("one block", {-3.5f}, {7}, true);
  row("blocks of one value", Values(5000, 12), Values(5000, 12), true);
  row("few different values: each is a level", chance(9000, 1, [](float x) { return std::floor(80 * x); }),
      chance(9000, 2, [](float x) { return 90 + std::floor(150 * x); }), true);
  row("many values", chance(100000, 3, even), chance(100000, 4, above), false);
  Values outlier = chance(100000, 6, above);
  outlier[777] = 3e38f;
  row("one value is far away", chance(100000, 5, even), outlier, false);
  row("some that all share: a level each",
      chance(100000, 7, [](float x) { return x < 0.3f   ? -1024.5f
                                             : x < 0.5f ? 0.25f
                                                        : x - 0.5f; }),
      chance(100000, 8, [](float x) { return x < 0.5f ? 1000.125f : 600 * x; }), false);
  row("ever fewer of larger ones", chance(100000, 9, [](float x) { return -x; }),
      chance(100000, 10, [](float x) { return 1 / (x + 1e-4f); }), false);
}

void TestBlockRanges::levelsLieNextToValues() {
  QFETCH(Values, low);
  QFETCH(Values, high);
  QFETCH(bool, exact);
  const BlockRanges b = blockRangesOf(4, {int(low.size()), 1, 1}, low, high);
  Values lows, highs;
  for (std::size_t n = 0; n < low.size(); ++n) {
    QVERIFY(isNext(b.levels, b.low(n), low[n], false));
    QVERIFY(isNext(b.levels, b.high(n), high[n], true));
    if (exact) QVERIFY(b.low(n) == low[n] && b.high(n) == high[n]);
    lows.push_back(b.low(n)), highs.push_back(b.high(n));
  }
  QCOMPARE(b.levels.front(), *std::min_element(low.begin(), low.end()));
  QCOMPARE(b.levels.back(), *std::max_element(high.begin(), high.end()));
  if (b.levels.front() < 0 && b.levels.back() > 0)
    QVERIFY(std::binary_search(b.levels.begin(), b.levels.end(), 0.0f));
  for (Values* v : {&low, &high, &lows, &highs}) std::sort(v->begin(), v->end());
  // Bounds rounded to levels may raise the number of blocks that reach a value by one tenth, plus a
  // thousandth of all blocks. The latter is needed as levels are chosen from a sample of blocks.
  const double most = 0.001 * double(low.size());
  for (std::size_t n = 0; n < low.size(); n += 1 + low.size() / 500) {
    const auto from = [&](const Values& v, float value) {
      return double(v.end() - std::lower_bound(v.begin(), v.end(), value));
    };
    const auto upTo = [&](const Values& v, float value) {
      return double(std::upper_bound(v.begin(), v.end(), value) - v.begin());
    };
    QVERIFY(from(highs, high[n]) <= 1.1 * from(high, high[n]) + most);
    QVERIFY(upTo(lows, low[n]) <= 1.1 * upTo(low, low[n]) + most);
  }
}

VOLUMEN_TEST(TestBlockRanges);
#include "tst_block_ranges.moc"
