// Guards picture.md 3 (Sobel, clamped), picture.md 5 (percentile ranks) and the counts of histograms.
#include <glm/geometric.hpp>
#include <numeric>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/volume/gradients.h"
#include "viewer/volume/histogram.h"

using namespace volumen;
using namespace volumen::tests;

class TestGradients : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void fastSobelEqualsTheDefinition_data();
  void fastSobelEqualsTheDefinition();
  void percentilesAreExactRanks_data();
  void percentilesAreExactRanks();
  void histogramCountsEveryVoxelButPadding();
};

namespace {

VolumePtr volumeOf(const QString& type, glm::ivec3 size) {
  if (type == QLatin1String("uint8")) return randomVolume<std::uint8_t>(size, 0, 255);
  if (type == QLatin1String("int16")) return randomVolume<std::int16_t>(size, -1000, 1000);
  if (type == QLatin1String("int16 full range")) return randomVolume<std::int16_t>(size, -32768, 32767);
  if (type == QLatin1String("uint16 slope -2.5"))
    return randomVolume<std::uint16_t>(size, 0, 65535, -2.5, -100);
  return randomVolume<float>(size, -1, 1);
}

void addTypesAndSizes() {
  QTest::addColumn<QString>("type");
  QTest::addColumn<int>("nx");
  QTest::addColumn<int>("ny");
  QTest::addColumn<int>("nz");
  const int sizes[][3] = {{17, 5, 9}, {1, 1, 1}, {1, 7, 3}, {40, 1, 2}, {3, 4, 1}, {16, 16, 16}, {256, 3, 4}};
  for (const char* type : {"uint8", "int16", "int16 full range", "uint16 slope -2.5", "float"})
    for (const auto& s : sizes)
      QTest::addRow("%s %dx%dx%d", type, s[0], s[1], s[2])
          << QString::fromLatin1(type) << s[0] << s[1] << s[2];
}

}  // namespace

void TestGradients::fastSobelEqualsTheDefinition_data() { addTypesAndSizes(); }

void TestGradients::fastSobelEqualsTheDefinition() {
  QFETCH(QString, type);
  QFETCH(int, nx);
  QFETCH(int, ny);
  QFETCH(int, nz);
  const VolumePtr v = volumeOf(type, {nx, ny, nz});
  const bool integers = type != QLatin1String("float");
  const Gradients16 g16 = integers ? sobel16(*v) : Gradients16{};
  const Gradients32 g32 = sobel32(*v);
  const ValueRange range = valueRange(*v);
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const std::size_t n = std::size_t(4) * ((k * ny + j) * nx + i);
        const glm::dvec3 g = sobelAt(*v, i, j, k);
        const glm::dvec3 fast = g32.scale * glm::dvec3(g32.xyz0[n], g32.xyz0[n + 1], g32.xyz0[n + 2]);
        // The bound allows for 27 float additions of values of the range's size.
        QVERIFY(glm::length(fast - g) <= 1e-5 * (range.high - range.low));
        if (!integers) continue;
        const std::int16_t* const xyzd = g16.row(std::size_t(k) * ny + j) + 4 * i;
        const glm::dvec3 packed = g16.scale * glm::dvec3(xyzd[0], xyzd[1], xyzd[2]);
        // Components are rounded to the nearest integer of `scale`, and are exact if the range is small.
        const double bound = range.high - range.low < 2047 ? 1e-9 : 0.5 * std::abs(g16.scale) * 1.0001;
        for (int a = 0; a < 3; ++a) QVERIFY(std::abs(packed[a] - g[a]) <= bound);
        const double unsignedShift = type.startsWith(QLatin1String("uint16")) ? 32768 : 0;
        QCOMPARE(v->realValue(xyzd[3] + unsignedShift), v->value(i, j, k));
      }
}

void TestGradients::percentilesAreExactRanks_data() { addTypesAndSizes(); }

void TestGradients::percentilesAreExactRanks() {
  QFETCH(QString, type);
  QFETCH(int, nx);
  QFETCH(int, ny);
  QFETCH(int, nz);
  const VolumePtr v = volumeOf(type, {nx, ny, nz});
  std::vector<float> sorted;
  for (std::int64_t n = 0; n < v->geometry().voxelCount(); ++n) sorted.push_back(v->valueAt(n));
  std::sort(sorted.begin(), sorted.end());
  const std::vector<int> perMille{0, 1, 10, 500, 990, 999, 1000};
  const auto found = percentiles(*v, perMille);
  for (std::size_t p = 0; p < perMille.size(); ++p) {
    const std::size_t rank = std::max<std::size_t>(1, (perMille[p] * sorted.size() + 999) / 1000);
    QCOMPARE(found[p], sorted[rank - 1]);
  }
  QCOMPARE(valueRange(*v), (ValueRange{sorted.front(), sorted.back()}));
}

void TestGradients::histogramCountsEveryVoxelButPadding() {
  VolumeParts parts;
  parts.geometry.size = {5, 1, 1};
  parts.values = std::vector<std::int16_t>{-2000, -1000, 0, 0, 1000};
  parts.attributes.padding = ValueRange{-2000, -2000};
  std::vector<std::string> warnings;
  const Histogram h = histogram(**Volume::make(parts, warnings), 100);
  QCOMPARE(h.counts.size(), std::size_t(100));
  QCOMPARE(std::accumulate(h.counts.begin(), h.counts.end(), std::int64_t(0)), std::int64_t(4));
  QCOMPARE(h.counts[std::size_t(2000 / h.binWidth())], std::int64_t(2));
}

VOLUMEN_TEST(TestGradients);
#include "tst_gradients.moc"
