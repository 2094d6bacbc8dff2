// Guards picture.md 8 (without a camera): thin volumes are not seen edge-on.
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "tests/unit/suite.h"
#include "viewer/scene/first_camera.h"

using namespace volumen;

namespace {

VoxelGeometry grid(glm::ivec3 size, glm::dvec3 i, glm::dvec3 j, glm::dvec3 k) {
  VoxelGeometry g;
  g.size = size;
  g.patientFromVoxelStep = {i, j, k};
  return g;
}

}  // namespace

class TestFirstCamera : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void looksWhereThereIsMostToSee_data();
  void looksWhereThereIsMostToSee();
};

void TestFirstCamera::looksWhereThereIsMostToSee_data() {
  QTest::addColumn<VoxelGeometry>("geometry");
  QTest::addColumn<glm::dvec3>("direction");
  QTest::addColumn<glm::dvec3>("up");
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const auto row = [](const char* name, const VoxelGeometry& g, glm::dvec3 direction, glm::dvec3 up) {
    QTest::newRow(name) << g << direction << up;
  };
  row("a chest", grid({512, 512, 138}, 0.8 * x, 0.8 * y, 2.0 * z), y, z);
  row("a head of thick slices", grid({512, 512, 28}, 0.49 * x, 0.49 * y, 5.3 * z), y, z);
  row("functional MR, axial", grid({64, 64, 10}, 3.75 * x, 3.75 * y, 3.0 * z), z, -y);
  row("axial, from the head down", grid({64, 64, 10}, 3.75 * x, 3.75 * y, -3.0 * z), z, -y);
  row("a spine, sagittal", grid({512, 512, 15}, 0.6 * y, -0.6 * z, 4.0 * x), -x, z);
  row("a whole body, coronal", grid({400, 1000, 30}, x, -z, 6.0 * y), y, z);
  row("few slices far apart", grid({256, 256, 7}, 0.9 * x, 0.9 * y, 20.0 * z), z, -y);
  row("one slice", grid({128, 128, 1}, 2.0 * x, 2.0 * y, z), z, -y);
  const glm::dvec3 back(0, 0.8, 0.6), out(0, -0.6, 0.8);
  row("oblique", grid({256, 256, 12}, x, back, 4.0 * out), out, -back);
  row("a row of voxels", grid({1000, 1, 1}, x, y, z), y, z);
  row("a small cube", grid({8, 8, 8}, x, y, z), y, z);
}

void TestFirstCamera::looksWhereThereIsMostToSee() {
  QFETCH(VoxelGeometry, geometry);
  QFETCH(glm::dvec3, direction);
  QFETCH(glm::dvec3, up);
  const Camera camera = firstCamera(geometry);
  QVERIFY(glm::length(glm::normalize(camera.direction) - direction) < 1e-9);
  QVERIFY(glm::length(glm::normalize(camera.up) - up) < 1e-9);
  QVERIFY(!camera.target);
}

VOLUMEN_TEST(TestFirstCamera);
#include "tst_first_camera.moc"
