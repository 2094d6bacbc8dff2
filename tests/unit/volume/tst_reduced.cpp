// Guards copies of fewer voxels: means of cubes that lie where the cubes lie, padding left out, by a plain
// loop.
#include <random>

#include "tests/unit/suite.h"
#include "viewer/volume/reduced.h"

using namespace volumen;

namespace {

template <class T>
VolumePtr randomVolume(glm::ivec3 size, bool padded) {
  VolumeParts parts;
  parts.geometry.size = size;
  parts.geometry.patientFromVoxelStep = glm::dmat3(0.5, 0, 0.1, 0, 0.7, 0, 0, 0, 2);
  parts.geometry.origin = {10, -20, 30};
  parts.slope = std::is_same_v<T, float> ? 1 : 2;
  parts.intercept = std::is_same_v<T, float> ? 0 : -100;
  std::mt19937 random(7);
  std::vector<T> values(std::size_t(parts.geometry.voxelCount()));
  for (T& v : values) v = T(random() % 200);
  // A whole cube, and a part of another.
  if (padded)
    for (std::size_t n = 0; n < 5; ++n) values[n] = values[std::size_t(size.x) + n] = T(0);
  parts.values = std::move(values);
  if (padded) parts.attributes.padding = ValueRange{parts.intercept, parts.intercept};
  std::vector<std::string> warnings;
  return *Volume::make(std::move(parts), warnings);
}

double meanOfCube(const Volume& volume, glm::ivec3 cube, int factor) {
  double sum = 0, paddingSum = 0;
  int count = 0, padded = 0;
  const glm::ivec3 low = cube * factor, high = glm::min(low + factor, volume.size());
  for (int k = low.z; k < high.z; ++k)
    for (int j = low.y; j < high.y; ++j)
      for (int i = low.x; i < high.x; ++i) {
        const double v = volume.value(i, j, k);
        const bool isPad = isPadding(volume.attributes().padding, v);
        (isPad ? paddingSum : sum) += v, ++(isPad ? padded : count);
      }
  return count > 0 ? sum / count : paddingSum / padded;
}

}  // namespace

class TestReduced : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void voxelsAreMeansOfCubes_data();
  void voxelsAreMeansOfCubes();
};

void TestReduced::voxelsAreMeansOfCubes_data() {
  QTest::addColumn<VolumePtr>("volume");
  QTest::addColumn<int>("factor");
  QTest::addColumn<double>("rounding");
  QTest::newRow("uint8") << randomVolume<std::uint8_t>({8, 6, 4}, false) << 2 << 1.0;
  QTest::newRow("int16, sizes that are no multiples")
      << randomVolume<std::int16_t>({9, 7, 5}, false) << 2 << 1.0;
  QTest::newRow("uint16, by 3") << randomVolume<std::uint16_t>({9, 7, 5}, false) << 3 << 1.0;
  QTest::newRow("float32") << randomVolume<float>({9, 7, 5}, false) << 4 << 1e-4;
  QTest::newRow("padding") << randomVolume<std::int16_t>({10, 4, 1}, true) << 2 << 1.0;
  QTest::newRow("one voxel is left") << randomVolume<float>({3, 2, 1}, false) << 8 << 1e-4;
}

void TestReduced::voxelsAreMeansOfCubes() {
  QFETCH(VolumePtr, volume);
  QFETCH(int, factor);
  QFETCH(double, rounding);
  const VolumePtr copy = reducedVolume(*volume, factor);
  QCOMPARE(copy->geometry(), reducedGeometry(volume->geometry(), factor));
  QCOMPARE(std::string(copy->typeName()), std::string(volume->typeName()));
  QCOMPARE(copy->attributes().padding, volume->attributes().padding);
  const glm::ivec3 size = copy->size();
  QCOMPARE(size, (volume->size() + (factor - 1)) / factor);
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        QVERIFY(std::abs(copy->value(i, j, k) - meanOfCube(*volume, {i, j, k}, factor)) <= rounding);
        // The centre of a whole cube.
        const glm::dvec3 centre = glm::dvec3(i, j, k) * double(factor) + (factor - 1) / 2.0;
        QVERIFY(glm::distance(copy->geometry().patientFromVoxel({i, j, k}),
                              volume->geometry().patientFromVoxel(centre)) < 1e-9);
      }
}

VOLUMEN_TEST(TestReduced);
#include "tst_reduced.moc"
