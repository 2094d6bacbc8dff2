// Guards gradients that are kept in bricks: those that sobel16() has, in every cell of a brick that is kept,
// and nothing but a hidden value in the others.
#include <random>

#include "tests/unit/suite.h"
#include "viewer/volume/gradient_bricks.h"
#include "viewer/volume/gradients.h"

using namespace volumen;

namespace {

using Bricks = GradientBricks16;

template <class T>
VolumePtr noise(glm::ivec3 size) {
  VolumeParts parts;
  parts.geometry.size = size;
  std::mt19937 random(3);
  std::vector<T> values(std::size_t(parts.geometry.voxelCount()));
  for (T& v : values) v = T(random());
  parts.values = std::move(values);
  std::vector<std::string> warnings;
  return *Volume::make(std::move(parts), warnings);
}

}  // namespace

class TestGradientBricks : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theyHoldWhatAllGradientsHold_data();
  void theyHoldWhatAllGradientsHold();
};

void TestGradientBricks::theyHoldWhatAllGradientsHold_data() {
  QTest::addColumn<VolumePtr>("volume");
  QTest::newRow("uint8") << noise<std::uint8_t>({24, 16, 16});
  QTest::newRow("int16, sizes that are no multiples") << noise<std::int16_t>({21, 19, 10});
  QTest::newRow("uint16, a voxel beyond a brick") << noise<std::uint16_t>({17, 9, 9});
  QTest::newRow("one slice") << noise<std::int16_t>({30, 20, 1});
}

void TestGradientBricks::theyHoldWhatAllGradientsHold() {
  QFETCH(VolumePtr, volume);
  const glm::ivec3 size = volume->size(), count = Bricks::countOf(size);
  const Gradients16 all = sobel16(*volume);
  std::vector<std::uint8_t> kept(std::size_t(count.x) * count.y * count.z);
  for (std::size_t n = 0; n < kept.size(); ++n) kept[n] = n % 3 != 1;
  const GradientBricks16 bricks = sobelBricks16(*volume, kept);
  QCOMPARE(bricks.count, count);
  QCOMPARE(bricks.scale, all.scale);
  QCOMPARE(bricks.bytes(), std::size_t(Bricks::bytesOf(std::ranges::count(kept, 1), count)));
  for (std::size_t n = 0; n < kept.size(); ++n) {
    const glm::ivec3 brick(int(n) % count.x, int(n) / count.x % count.y, int(n) / (count.x * count.y));
    QCOMPARE(bricks.first[n] != 0, kept[n] != 0);
    const glm::ivec3 low = brick * Bricks::cells, high = glm::min(low + Bricks::row, size);
    for (int k = low.z; k < high.z; ++k)
      for (int j = low.y; j < high.y; ++j)
        for (int i = low.x; i < high.x; ++i) {
          const glm::ivec3 in = glm::ivec3(i, j, k) - low;
          const std::int16_t* is =
              bricks.xyzd.data() + 4 * (bricks.first[n] + in.x + in.y * Bricks::row + in.z * Bricks::slice);
          const std::int16_t* voxel = all.row(std::size_t(k) * size.y + j) + 4 * i;
          // Brick 1 is the first that is left out.
          const std::int16_t hidden[4] = {0, 0, 0, all.row(0)[4 * Bricks::cells + 3]};
          QVERIFY(std::equal(is, is + 4, kept[n] ? voxel : hidden));
        }
  }
}

VOLUMEN_TEST(TestGradientBricks);
#include "tst_gradient_bricks.moc"
