// Guards numbers.h: values and histograms of a segment against voxel-by-voxel implementations.
#include <tbb/global_control.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/segment/bit_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/numbers.h"

using namespace volumen;
using namespace volumen::tests;
using glm::ivec3;

class TestNumbers : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void valuesAreThoseOfTheVoxels_data();
  void valuesAreThoseOfTheVoxels();
  void nothingHasNoValues_data();
  void nothingHasNoValues();
  void digitsFarFromZeroAreKept();
  void histogramsCountEachVoxelOnce_data();
  void histogramsCountEachVoxelOnce();
  void histogramsOfFewValues_data();
  void histogramsOfFewValues();
};

namespace {

VolumePtr anyVolume(const VoxelGeometry& grid, const QString& type, std::mt19937& random) {
  VolumeParts parts;
  parts.geometry = grid;
  const auto count = std::size_t(grid.voxelCount());
  const auto filled = [&](auto of, int low, int high) {
    std::vector<decltype(of)> values(count);
    for (auto& v : values) v = decltype(of)(low + int(random() % unsigned(high - low + 1)));
    return values;
  };
  if (type == QLatin1String("uint8")) parts.values = filled(std::uint8_t(), 0, 255);
  if (type == QLatin1String("int16")) parts.values = filled(std::int16_t(), -32768, 32767);
  if (type == QLatin1String("uint16")) parts.values = filled(std::uint16_t(), 0, 65535);
  if (type == QLatin1String("few")) parts.values = filled(std::int16_t(), -3, 4);
  if (type == QLatin1String("float")) {
    std::vector<float> values = filled(float(), -1000, 1000);
    for (float& v : values) v = v / 7 + 0.5f;
    parts.values = values;
  }
  if (type == QLatin1String("negative slope")) {
    parts.values = filled(std::int16_t(), -50, 900);
    parts.slope = -0.37, parts.intercept = 12.5;
  }
  if (type == QLatin1String("padding")) {
    parts.values = filled(std::int16_t(), -5, 5);
    parts.attributes.padding = ValueRange{-2, 0};
  }
  return volumeFrom(std::move(parts));
}

std::vector<double> valuesOneByOne(const BitMask& mask, const Volume& volume) {
  std::vector<double> values;
  const auto& padding = volume.attributes().padding;
  for (const ivec3 v : voxelsOf(mask.geometry())) {
    const double value = double(volume.value(v.x, v.y, v.z));
    if (mask.at(v) && !(padding && padding->low <= value && value <= padding->high)) values.push_back(value);
  }
  return values;
}

double atRank(const std::vector<double>& sorted, double percent) {
  const auto rank = std::max(1.0, std::ceil(percent * double(sorted.size()) / 100 - 1e-9));
  return sorted[std::size_t(rank) - 1];
}

void addTypes() {
  QTest::addColumn<QString>("type");
  for (const char* type : {"uint8", "int16", "uint16", "few", "float", "negative slope", "padding"})
    QTest::newRow(type) << QString::fromLatin1(type);
}

}  // namespace

void TestNumbers::valuesAreThoseOfTheVoxels_data() { addTypes(); }

void TestNumbers::valuesAreThoseOfTheVoxels() {
  QFETCH(QString, type);
  std::mt19937 random(11);
  for (int n = 0; n < 200; ++n) {
    const VoxelGeometry grid = anyGrid(random);
    const BitMask mask = anyMask(random, grid);
    const VolumePtr volume = anyVolume(grid, type, random);
    const SegmentValues found = valuesIn(mask, *volume);
    std::vector<double> values = valuesOneByOne(mask, *volume);
    QCOMPARE(found.voxels, std::int64_t(values.size()));
    if (values.empty()) {
      QCOMPARE(found.mean, 0.0);
      QCOMPARE(found.max, 0.0);
      continue;
    }
    double sum = 0, squares = 0;
    for (const double v : values) sum += v;
    const double mean = sum / double(values.size());
    for (const double v : values) squares += (v - mean) * (v - mean);
    QVERIFY(std::abs(found.mean - mean) < 1e-8);
    QVERIFY(std::abs(found.sd - std::sqrt(squares / double(values.size()))) < 1e-8);
    for (const ivec3 v : tests::voxelsOf(grid)) {
      if (!mask.at(v) || double(volume->value(v.x, v.y, v.z)) != found.max) continue;
      QVERIFY2(found.maxAt == v, caseOf(n, mask).c_str());
      break;
    }
    std::ranges::sort(values);
    QCOMPARE(found.min, values.front());
    QCOMPARE(found.max, values.back());
    QCOMPARE(found.p10, atRank(values, 10));
    QCOMPARE(found.median, atRank(values, 50));
    QCOMPARE(found.p90, atRank(values, 90));
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    QCOMPARE(valuesIn(mask, *volume).mean, found.mean);
    QCOMPARE(valuesIn(mask, *volume).sd, found.sd);
  }
}

void TestNumbers::nothingHasNoValues_data() {
  QTest::addColumn<bool>("some");
  QTest::newRow("no voxels") << false;
  QTest::newRow("padding alone") << true;
}

void TestNumbers::nothingHasNoValues() {
  QFETCH(bool, some);
  VolumeParts parts;
  parts.geometry.size = {2, 2, 2};
  parts.values = std::vector<std::int16_t>{-5, -5, -5, -5, 3, 3, 3, 3};
  parts.attributes.padding = ValueRange{-5, -5};
  BitMask mask(parts.geometry);
  if (some) mask.set({1, 1, 0});
  const SegmentValues found = valuesIn(mask, *volumeFrom(std::move(parts)));
  QCOMPARE(found.voxels, std::int64_t(0));
  QCOMPARE(found.mean, 0.0);
  QCOMPARE(found.max, 0.0);
  QVERIFY(found.histogram.counts.empty());
}

// Values are slightly above a million, where a sum of squares would lose the deviation.
void TestNumbers::digitsFarFromZeroAreKept() {
  const VoxelGeometry grid{.size = {100, 100, 20}};
  const BitMask all = inverted(BitMask(grid));
  VolumeParts parts;
  parts.geometry = grid;
  std::vector<float> values(std::size_t(grid.voxelCount()));
  for (std::size_t n = 0; n < values.size(); ++n) values[n] = n % 2 ? 1000000.25f : 1000000.0f;
  parts.values = values;
  const SegmentValues found = valuesIn(all, *volumeFrom(std::move(parts)));
  QVERIFY(std::abs(found.mean - 1000000.125) < 1e-9);
  QVERIFY(std::abs(found.sd - 0.125) < 1e-9);
}

void TestNumbers::histogramsCountEachVoxelOnce_data() { addTypes(); }

// The counts up to the end of each bin equal the number of smaller values. Fractional ends are rounded.
void TestNumbers::histogramsCountEachVoxelOnce() {
  QFETCH(QString, type);
  const Seeds seeds = seedsOf(60, 2000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    const VoxelGeometry grid = anyGrid(random);
    const BitMask mask = anyMask(random, grid);
    const VolumePtr volume = anyVolume(grid, type, random);
    const ValueCounts found = valuesIn(mask, *volume).histogram;
    std::vector<double> values = valuesOneByOne(mask, *volume);
    QCOMPARE(std::accumulate(found.counts.begin(), found.counts.end(), std::int64_t(0)),
             std::int64_t(values.size()));
    if (values.empty()) continue;
    std::ranges::sort(values);
    const double least = values.front(), most = values.back();
    const bool areWhole = std::ranges::all_of(values, [](double v) { return v == std::floor(v); });
    if (areWhole) {
      QCOMPARE(found.low, least - 0.5);
      QCOMPARE(found.width, std::ceil((most - least + 1) / 64));
    } else {
      QCOMPARE(found.low, least);
      QCOMPARE(found.counts.size(), std::size_t(most > least ? 64 : 1));
    }
    QVERIFY(found.counts.size() <= 64 && found.counts.front() > 0 && found.counts.back() > 0);
    const double room = areWhole ? 0 : 1e-9 * (most - least);
    std::int64_t below = 0;
    for (std::size_t bin = 0; bin + 1 < found.counts.size(); ++bin) {
      below += found.counts[bin];
      const double end = found.low + found.width * double(bin + 1);
      const auto fewest = std::ranges::lower_bound(values, end - room) - values.begin();
      const auto largest = std::ranges::lower_bound(values, end + room) - values.begin();
      QVERIFY2(fewest <= below && below <= largest, caseOf(seed, mask).c_str());
    }
  }
}

void TestNumbers::histogramsOfFewValues_data() {
  QTest::addColumn<QList<float>>("values");
  QTest::addColumn<double>("low");
  QTest::addColumn<double>("width");
  QTest::addColumn<QList<int>>("counts");
  QList<float> upTo64;
  for (int n = 0; n <= 64; ++n) upTo64 << float(n);
  QList<int> twoEach(32, 2);
  QTest::newRow("one voxel") << QList<float>{7} << 6.5 << 1.0 << QList<int>{1};
  QTest::newRow("one fraction") << QList<float>{0.25f} << 0.25 << 1.0 << QList<int>{1};
  QTest::newRow("equal whole numbers") << QList<float>{-3, -3, -3} << -3.5 << 1.0 << QList<int>{3};
  QTest::newRow("equal fractions") << QList<float>{0.5f, 0.5f} << 0.5 << 1.0 << QList<int>{2};
  QTest::newRow("a gap") << QList<float>{1, 3, 1} << 0.5 << 1.0 << QList<int>{2, 0, 1};
  QTest::newRow("more numbers than bins") << upTo64 << -0.5 << 2.0 << (twoEach << 1);
  QTest::newRow("NaN is the smallest")
      << QList<float>{std::numeric_limits<float>::quiet_NaN(), 5, 4} << 3.5 << 1.0 << QList<int>{2, 1};
}

void TestNumbers::histogramsOfFewValues() {
  QFETCH(QList<float>, values);
  QFETCH(double, low);
  QFETCH(double, width);
  QFETCH(QList<int>, counts);
  VolumeParts parts;
  parts.geometry.size = {int(values.size()), 1, 1};
  parts.values = std::vector<float>(values.begin(), values.end());
  const BitMask all = inverted(BitMask(parts.geometry));
  const ValueCounts found = valuesIn(all, *volumeFrom(std::move(parts))).histogram;
  QCOMPARE(found.low, low);
  QCOMPARE(found.width, width);
  QVERIFY(std::ranges::equal(found.counts, counts));
}

VOLUMEN_TEST(TestNumbers);
#include "tst_numbers.moc"
