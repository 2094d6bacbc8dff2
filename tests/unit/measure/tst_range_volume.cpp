// Guards slices.md 4: the volume of a range of values, by voxels and, to 0.1 %, as drawn.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/measure/cell_part.h"
#include "viewer/measure/range_volume.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

class TestRangeVolume : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void ramps_data();
  void ramps();
  void spheres_data();
  void spheres();
  void peaksOfOneVoxel_data();
  void peaksOfOneVoxel();
  void thinSheets_data();
  void thinSheets();
  void cellsByChance_data();
  void cellsByChance();
  void partsAddUp();
  void emptyAndWhole_data();
  void emptyAndWhole();
  void paddingHasNoVolume();
  void endsWithDecimalsAreIncluded();
};

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

RangeVolume volumeOfRange(const Volume& volume, double low, double high) {
  return *rangeVolume(volume, {low, high});
}

/// Returns whether the error is within the bound of slices.md 4.
bool toATenthPerCent(double found, double exact) { return std::abs(found - exact) <= 1e-3 * exact; }

}  // namespace

void TestRangeVolume::ramps_data() {
  QTest::addColumn<double>("low");
  QTest::addColumn<double>("high");
  QTest::addColumn<int>("voxels");  // number of voxels of 10 x 4 x 3
  QTest::addColumn<double>("drawn");
  QTest::newRow("inside") << 2.25 << 6.5 << 4 * 12 << 4.25 * 12;
  QTest::newRow("between voxels") << 3.25 << 3.75 << 0 << 0.5 * 12;
  QTest::newRow("one value") << 3.0 << 3.0 << 12 << 0.0;
  QTest::newRow("with the half cell at the end") << 8.5 << infinity << 12 << 1.0 * 12;
  QTest::newRow("the last value alone: that half cell") << 9.0 << infinity << 12 << 0.5 * 12;
  QTest::newRow("from below") << -infinity << 0.25 << 12 << 0.75 * 12;
}

void TestRangeVolume::ramps() {
  QFETCH(double, low);
  QFETCH(double, high);
  QFETCH(int, voxels);
  QFETCH(double, drawn);
  for (int axis = 0; axis < 3; ++axis) {
    glm::ivec3 size(4, 3, 4);
    size[axis] = 10;
    size[(axis + 1) % 3] = 3;
    size[(axis + 2) % 3] = 4;
    const VolumePtr volume = volumeOf<float>(size, glm::dmat3(1), [&](dvec3 p) { return p[axis]; });
    const RangeVolume found = volumeOfRange(*volume, low, high);
    QCOMPARE(found.voxels, std::int64_t(voxels));
    QVERIFY2(toATenthPerCent(found.drawnVoxels, drawn), qPrintable(QString::number(found.drawnVoxels)));
  }
}

void TestRangeVolume::spheres_data() {
  QTest::addColumn<double>("radius");
  QTest::addColumn<double>("bound");
  // Between voxels the distance to the centre is interpolated trilinearly. The relative error of the volume
  // falls with the square of the radius.
  QTest::newRow("20 voxels") << 20.0 << 0.01;
  QTest::newRow("20.37 voxels") << 20.37 << 0.01;
  QTest::newRow("6 voxels") << 6.0 << 0.05;
}

void TestRangeVolume::spheres() {
  QFETCH(double, radius);
  QFETCH(double, bound);
  const dvec3 centre(23.8, 23.3, 23.6);
  const VolumePtr volume =
      volumeOf<float>({48, 48, 48}, glm::dmat3(1), [&](dvec3 p) { return radius - glm::length(p - centre); });
  const double exact = 4.0 / 3 * std::acos(-1.0) * radius * radius * radius;
  const RangeVolume found = volumeOfRange(*volume, 0, infinity);
  QVERIFY(std::abs(found.drawnVoxels - exact) <= bound * exact);
  QVERIFY(std::abs(double(found.voxels) - exact) <= bound * exact);
}

void TestRangeVolume::peaksOfOneVoxel_data() {
  QTest::addColumn<double>("threshold");
  for (double threshold : {0.01, 0.3, 0.9, 0.99, 0.999}) QTest::addRow("%g", threshold) << threshold;
}

// (1 - |x|)(1 - |y|)(1 - |z|) >= t holds in a volume of 8 (1 - t (1 - ln t + (ln t)^2 / 2)).
void TestRangeVolume::peaksOfOneVoxel() {
  QFETCH(double, threshold);
  const VolumePtr volume =
      volumeOf<float>({5, 5, 5}, glm::dmat3(1), [](dvec3 p) { return p == dvec3(2) ? 1.0 : 0.0; });
  const double l = std::log(threshold);
  const double exact = 8 * (1 - threshold * (1 - l + l * l / 2));
  const double found = volumeOfRange(*volume, threshold, infinity).drawnVoxels;
  QVERIFY2(toATenthPerCent(found, exact), qPrintable(QStringLiteral("%1 %2").arg(found).arg(exact)));
}

void TestRangeVolume::thinSheets_data() {
  QTest::addColumn<dvec3>("normal");
  QTest::addColumn<double>("thickness");
  for (double thickness : {0.5, 0.01, 1e-4}) {
    QTest::addRow("along an axis, %g voxels", thickness) << dvec3(0, 1, 0) << thickness;
    QTest::addRow("across, %g voxels", thickness) << glm::normalize(dvec3(1, 1, 1)) << thickness;
    QTest::addRow("slanted, %g voxels", thickness) << glm::normalize(dvec3(0.1, -0.3, 1)) << thickness;
  }
}

// The range of a linear value is a sheet between two planes. One cell is compared with 1000 x 1000 lines
// along z.
void TestRangeVolume::thinSheets() {
  QFETCH(dvec3, normal);
  QFETCH(double, thickness);
  std::array<double, 8> cell;
  for (int n = 0; n < 8; ++n) cell[std::size_t(n)] = glm::dot(normal, dvec3(n & 1, n >> 1 & 1, n >> 2));
  const double middle = glm::dot(normal, dvec3(0.5));
  const ValueRange range{middle - thickness / 2, middle + thickness / 2};
  const Part part = partInRange(cell, range, 1e-4 * thickness);
  double exact = 0;
  constexpr int rows = 1000;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < rows; ++x) {
      const double start = normal.x * (x + 0.5) / rows + normal.y * (y + 0.5) / rows;
      if (normal.z == 0) {
        exact += start >= range.low && start <= range.high;
        continue;
      }
      const double a = (range.low - start) / normal.z, b = (range.high - start) / normal.z;
      exact += std::max(0.0, std::min(1.0, std::max(a, b)) - std::max(0.0, std::min(a, b)));
    }
  exact /= rows * rows;
  if (normal.z == 0) exact = thickness;
  QVERIFY2(toATenthPerCent(part.part, exact), qPrintable(QStringLiteral("%1 %2").arg(part.part).arg(exact)));
}

void TestRangeVolume::cellsByChance_data() {
  QTest::addColumn<quint64>("seed");
  for (quint64 seed = 1; seed <= 60; ++seed) QTest::addRow("seed %llu", seed) << seed;
}

// Compares with 160^3 points of a cell. They misjudge at most three layers of points on each face of the
// range, and in practice far fewer. No observed error reaches 1e-3 of the cell.
void TestRangeVolume::cellsByChance() {
  QFETCH(quint64, seed);
  Chance chance(seed);
  std::array<double, 8> c;
  for (double& v : c) v = chance.between(-1, 1);
  const double low = chance.between(-1, 1);
  const ValueRange range{low, chance.oneIn(2) ? infinity : low + chance.power(-2, 0)};
  constexpr int places = 160;
  const auto between = [](double a, double b, double t) { return a + t * (b - a); };
  std::int64_t inside = 0;
  for (int z = 0; z < places; ++z)
    for (int y = 0; y < places; ++y) {
      const double v = (y + 0.5) / places, w = (z + 0.5) / places;
      const double from = between(between(c[0], c[2], v), between(c[4], c[6], v), w);
      const double to = between(between(c[1], c[3], v), between(c[5], c[7], v), w);
      for (int x = 0; x < places; ++x) {
        const double value = between(from, to, (x + 0.5) / places);
        inside += value >= range.low && value <= range.high;
      }
    }
  const double counted = double(inside) / (double(places) * places * places);
  const Part part = partInRange(c, range, 1e-4);
  QVERIFY2(std::abs(part.part - counted) <= 1e-3,
           qPrintable(QStringLiteral("%1 %2").arg(part.part).arg(counted)));
  QVERIFY(part.error <= 1e-3);
}

// Adjacent ranges partition the box.
void TestRangeVolume::partsAddUp() {
  const VolumePtr volume = randomVolume<float>({13, 9, 7}, -100, 100);
  const double ends[] = {-infinity, -60, -3, 0.5, 44, infinity};
  double drawn = 0;
  std::int64_t voxels = 0;
  for (int n = 0; n < 5; ++n) {
    const RangeVolume part = volumeOfRange(*volume, ends[n], ends[n + 1]);
    drawn += part.drawnVoxels;
    voxels += part.voxels;
  }
  QCOMPARE(voxels, std::int64_t(13 * 9 * 7));
  QVERIFY(toATenthPerCent(drawn, 13 * 9 * 7));
}

void TestRangeVolume::emptyAndWhole_data() {
  QTest::addColumn<glm::ivec3>("size");
  QTest::newRow("one voxel") << glm::ivec3(1);
  QTest::newRow("a row") << glm::ivec3(5, 1, 1);
  QTest::newRow("a slice") << glm::ivec3(4, 6, 1);
}

void TestRangeVolume::emptyAndWhole() {
  QFETCH(glm::ivec3, size);
  const VolumePtr volume = randomVolume<std::int16_t>(size, 5, 50);
  const double all = double(volume->geometry().voxelCount());
  const RangeVolume whole = volumeOfRange(*volume, 0, 60), none = volumeOfRange(*volume, 60, infinity);
  QCOMPARE(double(whole.voxels), all);
  QCOMPARE(whole.drawnVoxels, all);
  QCOMPARE(none.voxels, std::int64_t(0));
  QCOMPARE(none.drawnVoxels, 0.0);
}

// Half of the slices are padding, far below other values. No range without padding may have volume between
// padding and tissue.
void TestRangeVolume::paddingHasNoVolume() {
  VolumeParts parts;
  parts.geometry.size = {4, 4, 4};
  std::vector<float> values(64, 100.f);
  std::fill_n(values.begin(), 32, -2000.f);
  parts.values = std::move(values);
  parts.attributes.padding = ValueRange{-2000, -2000};
  const VolumePtr volume = volumeFrom(std::move(parts));
  const RangeVolume low = volumeOfRange(*volume, -infinity, 0),
                    all = volumeOfRange(*volume, -infinity, infinity);
  QCOMPARE(low.voxels, std::int64_t(0));
  QCOMPARE(low.drawnVoxels, 0.0);
  QCOMPARE(all.voxels, std::int64_t(32));
  QCOMPARE(all.drawnVoxels, 32.0);
}

// Ends such as 0.7 and 0.3 are not exact in float32.
void TestRangeVolume::endsWithDecimalsAreIncluded() {
  VolumeParts parts;
  parts.geometry.size = {100, 1, 1};
  parts.values = std::vector<std::uint8_t>(100);
  for (int n = 0; n < 100; ++n)
    std::get<std::vector<std::uint8_t>>(parts.values)[std::size_t(n)] = std::uint8_t(n);
  parts.slope = 0.1;
  const VolumePtr volume = volumeFrom(std::move(parts));
  for (int n = 0; n < 100; ++n) {
    QCOMPARE(volumeOfRange(*volume, n / 10.0, n / 10.0).voxels, std::int64_t(1));
    QCOMPARE(volumeOfRange(*volume, n / 10.0, infinity).voxels, std::int64_t(100 - n));
  }
}

VOLUMEN_TEST(TestRangeVolume);
#include "tst_range_volume.moc"
