// Guards design.md 8 (segmentation by value range) and picture.md 1 (voxel volume).
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/segment/bit_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/range.h"

using namespace volumen;
using namespace volumen::tests;

class TestRange : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void findsExactlyTheClosedRange_data();
  void findsExactlyTheClosedRange();
  void anyRangeOfAnyVolume();
  void endsWithDecimalsAreIncluded_data();
  void endsWithDecimalsAreIncluded();
  void paddingIsNoTissue_data();
  void paddingIsNoTissue();
};

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

template <class T>
VolumePtr volumeOf(glm::ivec3 size, std::vector<T> values, double slope = 1, double intercept = 0) {
  VolumeParts parts;
  parts.geometry.size = size;
  parts.values = std::move(values);
  parts.slope = slope;
  parts.intercept = intercept;
  return volumeFrom(std::move(parts));
}

VolumePtr randomVolume(const QString& type) {
  std::mt19937 bits(7);
  const glm::ivec3 size(37, 29, 11);
  const auto fill = [&](auto value) {
    std::vector<decltype(value)> values(std::size_t(size.x * size.y * size.z));
    for (auto& v : values) v = decltype(value)(int(bits() % 200));
    return values;
  };
  if (type == QLatin1String("uint8")) return volumeOf(size, fill(std::uint8_t()));
  if (type == QLatin1String("int16")) return volumeOf(size, fill(std::int16_t()), 2, -150);
  if (type == QLatin1String("uint16")) return volumeOf(size, fill(std::uint16_t()), -0.1, 7);
  return volumeOf(size, fill(float()), 0.25, -10);
}

}  // namespace

void TestRange::findsExactlyTheClosedRange_data() {
  QTest::addColumn<QString>("type");
  QTest::addColumn<double>("low");
  QTest::addColumn<double>("high");
  for (const char* type : {"uint8", "int16", "uint16", "float32"}) {
    const QString t = QLatin1String(type);
    QTest::addRow("%s, inner", type) << t << -10.0 << 20.0;
    QTest::addRow("%s, one value", type) << t << 4.0 << 4.0;
    QTest::addRow("%s, all", type) << t << -infinity << infinity;
    QTest::addRow("%s, from below", type) << t << -infinity << 3.5;
    QTest::addRow("%s, upside down", type) << t << 5.0 << 1.0;
  }
}

void TestRange::findsExactlyTheClosedRange() {
  QFETCH(QString, type);
  QFETCH(double, low);
  QFETCH(double, high);
  const VolumePtr volume = randomVolume(type);
  const BitMask mask = voxelsInRange(*volume, {low, high});
  QVERIFY(mask.geometry() == volume->geometry());
  QVERIFY(isExactly(mask, [&](glm::ivec3 v) {
    const double value = double(volume->value(v.x, v.y, v.z));
    return value >= low && value <= high;
  }));
}

// Covers all sample types and slopes of both signs, with and without padding. Ends are at values, beside them
// and beyond all.
void TestRange::anyRangeOfAnyVolume() {
  const Seeds seeds = seedsOf(1500, 60000);
  int some = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    VolumeParts parts;
    parts.geometry = anyGrid(random, {140, 5, 4});
    const auto fill = [&]<class T>(T) {
      std::vector<T> values(std::size_t(parts.geometry.voxelCount()));
      const bool everywhere = random() % 2;
      for (auto& v : values)
        v = std::is_same_v<T, float> ? T(int(random() % 4001) - 2000) / 7
                                     : T(everywhere ? random() : random() % 50);
      return values;
    };
    switch (random() % 4) {
      case 0:
        parts.values = fill(std::uint8_t());
        break;
      case 1:
        parts.values = fill(std::int16_t());
        break;
      case 2:
        parts.values = fill(std::uint16_t());
        break;
      default:
        parts.values = fill(float());
    }
    parts.slope = std::vector{1.0, -1.0, 0.1, -0.37, 12.5}[random() % 5];
    parts.intercept = std::vector{0.0, -1024.0, 0.3}[random() % 3];
    const auto count = parts.geometry.voxelCount();
    const VolumePtr plain = volumeFrom(parts);
    const auto anyEnd = [&](double open) {
      const double value = double(plain->valueAt(std::size_t(random()) % std::size_t(count)));
      return std::vector{
          open,  value, std::nextafter(value, -infinity), std::nextafter(value, infinity), value + 0.01,
          1e300, -1e300}[random() % (random() % 4 ? 5 : 7)];
    };
    const ValueRange range{anyEnd(-infinity), anyEnd(infinity)};
    std::optional<ValueRange> padding;
    if (random() % 2) padding = ValueRange{anyEnd(-infinity), anyEnd(infinity)};
    parts.attributes.padding = padding;
    const VolumePtr volume = volumeFrom(std::move(parts));
    const BitMask mask = voxelsInRange(*volume, range);
    some += !mask.empty();
    const auto holds = [](ValueRange r, double value) {
      return double(float(r.low)) <= value && value <= double(float(r.high));
    };
    QVERIFY2(isExactly(mask,
                       [&](glm::ivec3 v) {
                         const double value = double(volume->value(v.x, v.y, v.z));
                         return holds(range, value) && !(padding && holds(*padding, value));
                       }),
             qPrintable(QStringLiteral("seed %1: %2 to %3").arg(seed).arg(range.low).arg(range.high)));
  }
  QVERIFY2(some > seeds.count / 5, "most ranges hold nothing");
}

// Values are 0.0, 0.1 ... 99.9, of which float32 holds only some exactly.
void TestRange::endsWithDecimalsAreIncluded_data() {
  QTest::addColumn<VolumePtr>("volume");
  std::vector<std::uint16_t> stored(1000);
  std::vector<float> floats(1000);
  for (int n = 0; n < 1000; ++n)
    stored[std::size_t(n)] = std::uint16_t(n), floats[std::size_t(n)] = float(n / 10.0);
  QTest::newRow("stored as whole numbers") << volumeOf({10, 100, 1}, stored, 0.1);
  QTest::newRow("stored as they are") << volumeOf({10, 100, 1}, floats);
}

void TestRange::endsWithDecimalsAreIncluded() {
  QFETCH(VolumePtr, volume);
  for (int n = 0; n < 1000; ++n) {
    const double end = n / 10.0;
    QCOMPARE(voxelsInRange(*volume, {end, end}).count(), std::int64_t(1));
    QCOMPARE(voxelsInRange(*volume, {end, infinity}).count(), std::int64_t(1000 - n));
    QCOMPARE(voxelsInRange(*volume, {-infinity, end}).count(), std::int64_t(n + 1));
    QVERIFY(isPadding(ValueRange{end, end}, volume->valueAt(std::size_t(n))));
  }
}

void TestRange::paddingIsNoTissue_data() {
  QTest::addColumn<double>("low");
  QTest::addColumn<double>("high");
  QTest::addColumn<int>("voxels");
  QTest::newRow("padding alone") << -infinity << -300.0 << 0;
  QTest::newRow("everything") << -infinity << infinity << 6;
  QTest::newRow("what lies beside it") << -1999.0 << 0.0 << 4;
}

void TestRange::paddingIsNoTissue() {
  QFETCH(double, low);
  QFETCH(double, high);
  QFETCH(int, voxels);
  VolumeParts parts;
  parts.geometry.size = {2, 2, 2};
  parts.values = std::vector<std::int16_t>{-1000, -1000, 0, 0, 0, 0, 7, 8};
  parts.slope = 2;  // padding is -2000
  parts.attributes.padding = ValueRange{-2000, -2000};
  const VolumePtr volume = volumeFrom(std::move(parts));
  QCOMPARE(voxelsInRange(*volume, {low, high}).count(), std::int64_t(voxels));
}

VOLUMEN_TEST(TestRange);
#include "tst_range.moc"
