// Guards design.md 3 (stored precision of 8 bits: the paper's four bytes a voxel, 2.3).
#include <cmath>
#include <random>

#include "tests/unit/suite.h"
#include "viewer/volume/bytes.h"
#include "viewer/volume/histogram.h"

using namespace volumen;

class TestBytes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void valuesAreOffByHalfAUnitAtMost_data() { addVolumes(); }
  void valuesAreOffByHalfAUnitAtMost();
  void gradientsAreOffByHalfAUnitAtMost_data();
  void gradientsAreOffByHalfAUnitAtMost();
  void bothKindsHoldTheSameDensities_data() { addVolumes(); }
  void bothKindsHoldTheSameDensities();

 private:
  static void addVolumes();
};

namespace {

constexpr glm::ivec3 small{17, 6, 5}, wide{512, 2, 3};  // rows of 2048 bytes, so that words are far apart

VolumePtr made(VoxelValues values, double slope, double intercept, glm::ivec3 size = small) {
  VolumeParts parts;
  parts.geometry.size = size;
  parts.values = std::move(values);
  parts.slope = slope;
  parts.intercept = intercept;
  std::vector<std::string> warnings;
  return *Volume::make(std::move(parts), warnings);
}

template <class T>
VolumePtr noise(double low, double high, double slope = 1, double intercept = 0, glm::ivec3 size = small) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> value(low, high);
  std::vector<T> values(std::size_t(size.x) * size.y * size.z);
  for (T& v : values) v = std::is_same_v<T, float> ? T(value(random)) : T(std::floor(value(random)));
  values[3] = T(low), values[77] = T(high);
  return made(std::move(values), slope, intercept, size);
}

struct Case {
  const char* name;
  bool exact;
  VolumePtr volume;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"uint8 of all values", true, noise<std::uint8_t>(0, 255)},
      {"int16 of 256 values", true, noise<std::int16_t>(-300, -45)},
      {"int16 of 257 values", false, noise<std::int16_t>(-300, -44)},
      {"uint16 of 256 values, steps of 0.1", true, noise<std::uint16_t>(60000, 60255, 0.1, -3.7)},
      {"uint8, falling", true, noise<std::uint8_t>(0, 255, -2.5, 40)},
      {"int16 of all values", false, noise<std::int16_t>(-32768, 32767)},
      {"uint16 of all values, falling", false, noise<std::uint16_t>(0, 65535, -0.3, 5)},
      {"int16 of 257 values, rows of 2048 bytes", false, noise<std::int16_t>(-300, -44, 1, 0, wide)},
      {"small floats", false, noise<float>(-1e-6, 2e-6)},
      {"floats as large as can be", false, noise<float>(-1e30, 1e30)},
      {"floats, all the same", false, made(std::vector<float>(17 * 6 * 5, 0.1f), 1, 0)},
      {"integers, all the same", true, made(std::vector<std::int16_t>(17 * 6 * 5, 40), 0.3, 1)},
  };
  return all;
}

// Returns the word of voxel n, not counting the padding between rows.
std::uint32_t wordOf(const Voxels8& v, const Volume& volume, std::size_t n) {
  const std::size_t row = std::size_t(volume.size().x);
  return v.row(n / row)[n % row];
}

}  // namespace

void TestBytes::addVolumes() {
  QTest::addColumn<int>("index");
  for (std::size_t n = 0; n < cases().size(); ++n) QTest::newRow(cases()[n].name) << int(n);
}

void TestBytes::valuesAreOffByHalfAUnitAtMost() {
  QFETCH(int, index);
  const Case& c = cases()[index];
  const Volume& volume = *c.volume;
  const ValueRange range = valueRange(volume);
  const ByteScale scale = byteScale(volume, range);
  QCOMPARE(scale.exact, c.exact);
  // Values are rounded to floats before they are compared.
  const double ulp = 1.2e-7 * std::max(std::abs(range.low), std::abs(range.high));
  if (!c.exact && range.high > range.low)
    QVERIFY(std::abs(scale.unit - (range.high - range.low) / 255) <= ulp);
  const Density8 d = densities8(volume, scale);
  for (std::size_t n = 0; n < d.bytes.size(); ++n) {
    const double value = d.scale.low + d.scale.unit * d.bytes[n];
    if (c.exact)
      QCOMPARE(float(value), volume.valueAt(n));
    else
      QVERIFY(std::abs(value - volume.valueAt(n)) <= 0.5 * scale.unit + ulp);
  }
}

void TestBytes::gradientsAreOffByHalfAUnitAtMost_data() {
  QTest::addColumn<int>("index");
  QTest::addColumn<int>("by");
  for (std::size_t n = 0; n < cases().size(); ++n)
    for (int by = 0; by < 3; ++by) QTest::addRow("%s, operator %d", cases()[n].name, by) << int(n) << by;
}

void TestBytes::gradientsAreOffByHalfAUnitAtMost() {
  QFETCH(int, index);
  QFETCH(int, by);
  const Volume& volume = *cases()[index].volume;
  const ValueRange range = valueRange(volume);
  const Voxels8 v = voxels8By(volume, GradientOperator(by), byteScale(volume, range));
  const Gradients32 g = gradients32By(volume, GradientOperator(by));
  int largest = 0;
  for (std::size_t n = 0; n < std::size_t(volume.geometry().voxelCount()); ++n)
    for (int a = 0; a < 3; ++a) {
      const int byte = std::int8_t(wordOf(v, volume, n) >> 8 * a & 255);
      largest = std::max(largest, std::abs(byte));
      // 1e-6 allows for rounded products of doubles.
      QVERIFY(std::abs(v.gradientUnit * byte - g.scale * g.xyz0[4 * n + a]) <= (0.5 + 1e-6) * v.gradientUnit);
      if (g.xyz0[4 * n + a] == 0) QCOMPARE(byte, 0);
    }
  QCOMPARE(largest, range.high > range.low ? 127 : 0);
}

void TestBytes::bothKindsHoldTheSameDensities() {
  QFETCH(int, index);
  const Volume& volume = *cases()[index].volume;
  const ByteScale scale = byteScale(volume, valueRange(volume));
  const Density8 d = densities8(volume, scale);
  const Voxels8 v = voxels8By(volume, GradientOperator::sobel, scale);
  for (std::size_t n = 0; n < d.bytes.size(); ++n)
    QCOMPARE(wordOf(v, volume, n) >> 24, std::uint32_t(d.bytes[n]));
}

VOLUMEN_TEST(TestBytes);
#include "tst_bytes.moc"
