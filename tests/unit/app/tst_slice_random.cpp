// Guards slices.md 1: `volumen slice` gives the twin's values on random planes and small random volumes.
// VOLUMEN_RANDOM_CASES=N runs N seeds from VOLUMEN_RANDOM_SEED on.
#include <QTemporaryDir>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "io/files/write_volume.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/app/slice_case.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dmat3;
using glm::dvec3;

namespace {

dvec3 direction(Chance& chance) {
  for (;;) {
    const dvec3 v = chance.vector();
    if (glm::length(v) > 0.1 && glm::length(v) <= 1) return glm::normalize(v);
  }
}

/// Returns two orthogonal unit vectors, in one of three cases along patient axes.
std::pair<dvec3, dvec3> axes(Chance& chance) {
  if (chance.oneIn(3)) {
    const int a = chance.below(3);
    dvec3 right(0), down(0);
    right[a] = chance.oneIn(2) ? 1 : -1;
    down[(a + 1 + chance.below(2)) % 3] = chance.oneIn(2) ? 1 : -1;
    return {right, down};
  }
  const dvec3 right = direction(chance);
  dvec3 down = direction(chance);
  while (glm::length(glm::cross(right, down)) < 0.1) down = direction(chance);
  return {right, glm::normalize(down - glm::dot(down, right) * right)};
}

/// Returns straight, oblique, sheared and left-handed grids with cells of 0.3 to 3 mm.
dmat3 grid(Chance& chance) {
  for (;;) {
    dmat3 step;
    for (int a = 0; a < 3; ++a) {
      dvec3 axis(0);
      axis[a] = chance.oneIn(2) ? 1 : -1;
      step[a] =
          chance.power(-0.5, 0.5) * glm::normalize(axis + (chance.oneIn(2) ? 0.5 : 0.0) * chance.vector());
    }
    if (chance.oneIn(3)) std::swap(step[0], step[2]);
    const double cells = glm::length(step[0]) * glm::length(step[1]) * glm::length(step[2]);
    if (std::abs(glm::determinant(step)) > 0.3 * cells) return step;
  }
}

VolumePtr someVolume(Chance& chance) {
  VolumeParts parts;
  parts.geometry.size = {1 + chance.below(12), 1 + chance.below(12), 1 + chance.below(12)};
  parts.geometry.patientFromVoxelStep = grid(chance);
  parts.geometry.origin = 300.0 * chance.vector();
  const std::size_t count = parts.geometry.voxelCount();
  const double low = chance.between(-2000, 1000), high = low + chance.power(0, 4);
  if (chance.oneIn(2)) {
    std::vector<float> values(count);
    for (float& v : values) v = float(chance.between(low, high));
    parts.values = std::move(values);
  } else {
    std::vector<std::int16_t> values(count);
    for (std::int16_t& v : values) v = std::int16_t(chance.between(low, high));
    parts.values = std::move(values);
  }
  return volumeFrom(std::move(parts));
}

TwinPlane somePlane(Chance& chance, const VoxelGeometry& geometry) {
  const auto [right, down] = axes(chance);
  TwinPlane plane = twinPlane(geometry, right, down);
  const double spacing = plane.mmPerPixel;
  plane.centre += spacing * (chance.oneIn(4) ? 8.0 : 2.0) * chance.vector();
  plane.mmPerPixel = spacing * chance.power(-0.8, 0.6);
  plane.size = {1 + chance.below(50), 1 + chance.below(50)};
  if (chance.oneIn(2)) plane.slabMm = spacing * chance.power(-1, 1);
  plane.slab = TwinSlab(chance.below(3));
  plane.interpolation = TwinInterpolation(chance.below(3));
  plane.average = chance.oneIn(3);
  return plane;
}

}  // namespace

class TestSliceRandom : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void isTheTwins_data();
  void isTheTwins();

 private:
  QTemporaryDir folder_;
};

void TestSliceRandom::isTheTwins_data() {
  QTest::addColumn<quint64>("seed");
  const Seeds seeds = seedsOf(20, 60);
  for (int n = seeds.first; n < seeds.behindLast(); ++n) QTest::addRow("seed %d", n) << quint64(n);
}

void TestSliceRandom::isTheTwins() {
  QFETCH(quint64, seed);
  Chance chance(seed);
  const VolumePtr made = someVolume(chance);
  const QString path = folder_.filePath(QStringLiteral("a.nrrd"));
  QVERIFY(writeVolume(*made, path.toStdString()).ok());
  const VolumePtr volume = volumeAt(path.toStdString());
  const TwinPlane plane = somePlane(chance, volume->geometry());
  const QStringList options = planeOptions(plane);
  const QString faults = faultsOf(runSlice(path, options), *volume, plane);
  QVERIFY2(faults.isEmpty(), qPrintable(faults + QStringLiteral("; ") + options.join(QLatin1Char(' '))));
}

VOLUMEN_TEST(TestSliceRandom);
#include "tst_slice_random.moc"
