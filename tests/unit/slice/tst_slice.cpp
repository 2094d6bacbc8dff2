// Guards slices.md 1: closed forms of planes through a volume, and refusals.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/fixtures/real_volume.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/slice/slice.h"

using namespace volumen;
using namespace volumen::tests;

class TestSlice : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void acquiredValuesStayThemselves_data();
  void acquiredValuesStayThemselves();
  void polynomialsAreReproduced_data();
  void polynomialsAreReproduced();
  void aWidePlaneDoesNotDrift();
  void constantsStayConstant_data();
  void constantsStayConstant();
  void onlyTheBoxHasValues_data();
  void onlyTheBoxHasValues();
  void theMiddleOfTwoVoxelsIsOneOfThem();
  void slabsOfARamp_data();
  void slabsOfARamp();
  void averagesHoldTheShareOfThinLines();
  void hugeSlabsAndPixelsEnd();
  void rowsAreThoseOfTheWhole_data();
  void rowsAreThoseOfTheWhole();
  void realStudiesShowTheirVoxels_data();
  void realStudiesShowTheirVoxels();
  void whatIsNoPlaneIsRefused_data();
  void whatIsNoPlaneIsRefused();
  void whatIsCancelledIsAnError();
};

namespace {

// 0.7 mm and 1/3 mm are not exact in doubles.
const glm::dmat3 decimals{{0.7, 0, 0}, {0, 0, -0.7}, {0, 1. / 3, 0}};

template <class T>
VolumePtr someVolume(glm::ivec3 size, double low, double high, double slope, double intercept) {
  VolumeParts parts;
  const VolumePtr random = randomVolume<T>(size, low, high);
  parts.geometry = random->geometry();
  parts.geometry.patientFromVoxelStep = decimals;
  parts.geometry.origin = {-123.4, 56.7, -890.1};
  parts.values = random->stored();
  parts.slope = slope, parts.intercept = intercept;
  return volumeFrom(std::move(parts));
}

VolumePtr someVolume(const QString& type) {
  const glm::ivec3 size(37, 29, 11);
  if (type == QLatin1String("uint8")) return someVolume<std::uint8_t>(size, 0, 256, 1, 0);
  if (type == QLatin1String("int16")) return someVolume<std::int16_t>(size, -32768, 32768, 0.1, -3);
  if (type == QLatin1String("uint16")) return someVolume<std::uint16_t>(size, 0, 65536, -1, 7);
  return someVolume<float>(size, -1e30, 1, 1, 0);
}

SliceValues sliceOf(const Volume& volume, const SlicePlane& plane) {
  const auto slice = resampleSlice(volume, plane);
  if (!slice) throw std::runtime_error(slice.message());
  return *slice;
}

// Returns a plane along the voxel axes i and j through slice k, with one pixel per voxel.
SlicePlane alongSlice(const Volume& volume, double k) {
  const VoxelGeometry& g = volume.geometry();
  SlicePlane plane =
      planeAlong(g, glm::normalize(g.patientFromVoxelStep[0]), glm::normalize(g.patientFromVoxelStep[1]));
  plane.centre = g.patientFromVoxel({(g.size.x - 1) / 2., (g.size.y - 1) / 2., k});
  return plane;
}

}  // namespace

void TestSlice::acquiredValuesStayThemselves_data() {
  QTest::addColumn<QString>("type");
  QTest::addColumn<int>("how");
  for (const QString& type : {QStringLiteral("uint8"), QStringLiteral("int16"), QStringLiteral("uint16"),
                              QStringLiteral("float32")})
    for (int how = 0; how < 3; ++how)
      QTest::newRow(qPrintable(QStringLiteral("%1, %2").arg(type).arg(how))) << type << how;
}

// Values are exact on every slice, also at the edges and with pixels of a third of a voxel.
void TestSlice::acquiredValuesStayThemselves() {
  QFETCH(QString, type);
  QFETCH(int, how);
  const VolumePtr volume = someVolume(type);
  const glm::ivec3 n = volume->size();
  for (const int finer : {1, 3})
    for (int k = 0; k < n.z; ++k) {
      SlicePlane plane = alongSlice(*volume, k);
      plane.interpolation = Interpolation(how);
      plane.mmPerPixel = 0.7 / finer;
      plane.size = {n.x * finer, n.y * finer};
      const SliceValues slice = sliceOf(*volume, plane);
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i) {
          const int middle = finer / 2, at = (j * finer + middle) * plane.size.x + i * finer + middle;
          QVERIFY(slice.values[at] == volume->value(i, j, k));
        }
    }
}

void TestSlice::polynomialsAreReproduced_data() {
  QTest::addColumn<int>("how");
  QTest::addColumn<int>("degree");
  QTest::newRow("linear, linear") << int(Interpolation::linear) << 1;
  QTest::newRow("cubic, linear") << int(Interpolation::cubic) << 1;
  QTest::newRow("cubic, quadratic") << int(Interpolation::cubic) << 2;
}

// Covers the inside, where no neighbour is clamped. Values of -2000 to 2000 are within 1e-6 of that.
void TestSlice::polynomialsAreReproduced() {
  QFETCH(int, how);
  QFETCH(int, degree);
  const glm::dmat3 L{{0.6, 0.3, 0}, {-0.2, 0.8, 0.1}, {0.1, 0.5, 2.5}};
  const auto value = [&](glm::dvec3 x) {
    const double linear = 13 * x.x - 17 * x.y + 29 * x.z;
    return degree == 1 ? linear : linear + 0.5 * x.x * x.x - x.x * x.y + 0.25 * x.z * x.z;
  };
  const VolumePtr volume = volumeOf<float>({40, 36, 20}, L, value);
  const VoxelGeometry& g = volume->geometry();
  SlicePlane plane = planeAlong(g, glm::normalize(glm::dvec3(1, 0.4, 0.2)),
                                glm::normalize(glm::cross(glm::dvec3(1, 0.4, 0.2), {0.3, 0.5, 1})));
  plane.interpolation = Interpolation(how);
  plane.mmPerPixel = 0.31;
  plane.size = {120, 100};
  const SliceValues slice = sliceOf(*volume, plane);
  int tested = 0;
  for (int y = 0; y < plane.size.y; ++y)
    for (int x = 0; x < plane.size.x; ++x) {
      const glm::dvec3 at = g.voxelFromPatient(plane.patientFromPixel({x + 0.5, y + 0.5}));
      const glm::dvec3 room = glm::min(at - 1.0, glm::dvec3(g.size) - 2.0 - at);
      if (std::min({room.x, room.y, room.z}) < 0) continue;
      QVERIFY(std::abs(slice.values[y * plane.size.x + x] - value(at)) < 2e-3);
      ++tested;
    }
  QVERIFY2(tested > 3000, qPrintable(QString::number(tested)));
}

// 5000 pixels lie along a ramp of 1 a voxel. The last one must be as exact as the first.
void TestSlice::aWidePlaneDoesNotDrift() {
  const VolumePtr volume =
      volumeOf<std::int16_t>({1000, 3, 3}, glm::dmat3(0.7), [](glm::dvec3 x) { return x.x; });
  SlicePlane plane = namedPlane(volume->geometry(), NamedPlane::axial);
  plane.mmPerPixel = 0.7 * 999 / 5000;
  plane.size = {5000, 1};
  const SliceValues slice = sliceOf(*volume, plane);
  for (int x = 0; x < 5000; ++x)  // a float of 999 holds 3e-5
    QVERIFY(std::abs(slice.values[x] - (x + 0.5) * 999 / 5000) < 6e-5);
}

void TestSlice::constantsStayConstant_data() { acquiredValuesStayThemselves_data(); }

// A curve or a threshold may have a step exactly there (picture.md 2).
void TestSlice::constantsStayConstant() {
  QFETCH(QString, type);
  QFETCH(int, how);
  const auto made = [&]<class T>(T) {
    return volumeOf<T>(
        {9, 8, 7}, glm::dmat3(0.7), [](glm::dvec3) { return 123; }, 0.37, 11);
  };
  const VolumePtr volume = type == QLatin1String("uint8")    ? made(std::uint8_t())
                           : type == QLatin1String("int16")  ? made(std::int16_t())
                           : type == QLatin1String("uint16") ? made(std::uint16_t())
                                                             : made(0.f);
  SlicePlane plane = planeAlong(volume->geometry(), glm::normalize(glm::dvec3(1, 2, 3)),
                                glm::normalize(glm::dvec3(3, 0, -1)));
  plane.interpolation = Interpolation(how);
  for (const SlabMode mode : {SlabMode::max, SlabMode::min, SlabMode::mean})
    for (const double slab : {0., 3.})
      for (const bool average : {false, true}) {
        plane.slabMode = mode, plane.slabMm = slab, plane.average = average;
        plane.mmPerPixel = average ? 1.9 : 0.3;
        const SliceValues slice = sliceOf(*volume, plane);
        int inside = 0;
        for (float v : slice.values) {
          if (std::isnan(v)) continue;
          QVERIFY(v == volume->valueAt(0));
          ++inside;
        }
        QVERIFY(inside > 4);
      }
}

void TestSlice::onlyTheBoxHasValues_data() {
  QTest::addColumn<double>("z");
  QTest::addColumn<bool>("inside");
  // Slices are at 0 and 1 mm. The box is -0.5 to 1.5 mm, faces included.
  QTest::newRow("below") << -0.5001 << false;
  QTest::newRow("lower face") << -0.5 << true;
  QTest::newRow("middle") << 0.7 << true;
  QTest::newRow("upper face") << 1.5 << true;
  QTest::newRow("above") << 1.5001 << false;
}

void TestSlice::onlyTheBoxHasValues() {
  QFETCH(double, z);
  QFETCH(bool, inside);
  VolumeParts parts;
  parts.geometry.size = {4, 3, 2};
  parts.values = std::vector<std::uint8_t>(24, 7);
  const VolumePtr volume = volumeFrom(std::move(parts));
  SlicePlane plane = namedPlane(volume->geometry(), NamedPlane::axial);
  plane.size = {8, 5};  // two extra pixels at the left and at the right, one above and one below
  plane.centre.z = z;
  const SliceValues slice = sliceOf(*volume, plane);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 8; ++x) {
      const bool in = inside && x >= 2 && x < 6 && y >= 1 && y < 4;
      QCOMPARE(std::isnan(slice.values[y * 8 + x]), !in);
      if (in) QCOMPARE(slice.values[y * 8 + x], 7.f);
    }
}

// The plane lies midway between two slices. Rounding must not mix both in the picture.
void TestSlice::theMiddleOfTwoVoxelsIsOneOfThem() {
  const glm::dmat3 turned{{0.6 * 0.7, 0.8 * 0.7, 0}, {-0.8 * 0.7, 0.6 * 0.7, 0}, {0, 0, 1.3}};
  const VolumePtr volume = volumeOf<std::int16_t>({64, 64, 2}, turned, [](glm::dvec3 x) { return x.z; });
  SlicePlane plane = alongSlice(*volume, 0.5);
  plane.interpolation = Interpolation::nearest;
  for (float v : sliceOf(*volume, plane).values) QCOMPARE(v, 1.f);
}

void TestSlice::slabsOfARamp_data() {
  QTest::addColumn<int>("mode");
  QTest::addColumn<double>("slope");
  QTest::addColumn<double>("value");
  // The value is z in mm. Samples are at -1.75, -1.25 .. 1.75 mm from the plane at z = 5 mm.
  QTest::newRow("max") << int(SlabMode::max) << 1.0 << 6.75;
  QTest::newRow("min") << int(SlabMode::min) << 1.0 << 3.25;
  QTest::newRow("mean") << int(SlabMode::mean) << 1.0 << 5.0;
  QTest::newRow("max, stored upside down") << int(SlabMode::max) << -1.0 << 6.75;
  QTest::newRow("min, stored upside down") << int(SlabMode::min) << -1.0 << 3.25;
}

void TestSlice::slabsOfARamp() {
  QFETCH(int, mode);
  QFETCH(double, slope);
  QFETCH(double, value);
  VolumeParts parts;
  parts.geometry.size = {4, 4, 11};
  std::vector<std::int16_t> values;
  for (int n = 0; n < 4 * 4 * 11; ++n) values.push_back(std::int16_t(slope * (n / 16)));
  parts.values = std::move(values), parts.slope = slope;
  const VolumePtr volume = volumeFrom(std::move(parts));
  SlicePlane plane = namedPlane(volume->geometry(), NamedPlane::axial);
  plane.slabMm = 4, plane.slabMode = SlabMode(mode);
  for (float v : sliceOf(*volume, plane).values) QCOMPARE(v, float(value));
  // Half of the slab lies beyond the last slice. Those samples do not count.
  plane.centre.z = 10.5;
  const double last = mode == int(SlabMode::max)   ? 10
                      : mode == int(SlabMode::min) ? 8.75
                                                   : (8.75 + 9.25 + 9.75 + 10) / 4;
  for (float v : sliceOf(*volume, plane).values) QCOMPARE(v, float(last));
}

// Lines are one voxel wide, four apart, at four voxels a pixel. Every pixel holds a quarter, without
// aliasing.
void TestSlice::averagesHoldTheShareOfThinLines() {
  const VolumePtr volume = volumeOf<std::uint8_t>({64, 64, 1}, glm::dmat3(0.5),
                                                  [](glm::dvec3 x) { return int(x.x) % 4 == 1 ? 200 : 0; });
  SlicePlane plane = namedPlane(volume->geometry(), NamedPlane::axial);
  plane.mmPerPixel = 2, plane.size = {16, 16}, plane.average = true;
  QCOMPARE(subSamples(plane, volume->geometry()), std::int64_t(4));
  for (float v : sliceOf(*volume, plane).values) QCOMPARE(v, 50.f);
  plane.average = false;
  for (float v : sliceOf(*volume, plane).values) QVERIFY(v == 100 || v == 0);
}

// Samples outside the box cost no time.
void TestSlice::hugeSlabsAndPixelsEnd() {
  const VolumePtr volume =
      volumeOf<std::int16_t>({20, 20, 20}, glm::dmat3(1), [](glm::dvec3 x) { return x.z; });
  SlicePlane plane = namedPlane(volume->geometry(), NamedPlane::axial);
  plane.slabMm = 1e9;
  for (float v : sliceOf(*volume, plane).values) QCOMPARE(v, 19.f);
  plane.slabMm = 0, plane.mmPerPixel = 1e6, plane.average = true, plane.size = {3, 3};
  const SliceValues slice = sliceOf(*volume, plane);
  for (int n = 0; n < 9; ++n) QCOMPARE(std::isnan(slice.values[n]), n != 4);
  QCOMPARE(slice.values[4], 9.5f);
}

void TestSlice::rowsAreThoseOfTheWhole_data() {
  QTest::addColumn<QSize>("size");
  QTest::addColumn<double>("slabMm");
  QTest::newRow("at once") << QSize(60, 50) << 0.;
  QTest::newRow("in several parts, the last one smaller") << QSize(2100, 4503) << 0.;
  QTest::newRow("few long rows") << QSize(300000, 37) << 0.;
  QTest::newRow("a slab") << QSize(1100, 4001) << 3.;
}

void TestSlice::rowsAreThoseOfTheWhole() {
  QFETCH(QSize, size);
  QFETCH(double, slabMm);
  const VolumePtr volume = someVolume(QStringLiteral("int16"));
  SlicePlane plane = alongSlice(*volume, 4.3);
  plane.size = {size.width(), size.height()};
  plane.mmPerPixel = 40. / std::max(size.width(), size.height());
  plane.slabMm = slabMm;
  const SliceValues whole = sliceOf(*volume, plane);
  std::size_t seen = 0;
  const Status done = resampleSliceByRows(*volume, plane, [&](std::span<const float> rows) -> Status {
    if (rows.size() % std::size_t(plane.size.x) != 0) return Error{"a row is cut"};
    if (std::memcmp(rows.data(), whole.values.data() + seen, rows.size_bytes()) != 0)
      return Error{"other values"};
    seen += rows.size();
    return {};
  });
  QVERIFY2(done, done ? "" : done.message().c_str());
  QCOMPARE(seen, whole.values.size());
  QCOMPARE(resampleSliceByRows(*volume, plane, [](std::span<const float>) { return Status(Error{"full"}); })
               .message(),
           std::string("full"));
}

void TestSlice::realStudiesShowTheirVoxels_data() {
  QTest::addColumn<QString>("name");
  for (const char* name :
       {"ct-chest-lidc0314-138", "mr-head-siemens-gap-175", "dicom-geometry/ct-ge-tilt-varspacing-28"})
    QTest::newRow(name) << QString::fromLatin1(name);
}

void TestSlice::realStudiesShowTheirVoxels() {
  QFETCH(QString, name);
  const VolumePtr volume = realVolume(name.toStdString());
  NEED_VOLUME(volume);
  const glm::ivec3 n = volume->size();
  for (const int k : {0, n.z / 2, n.z - 1}) {
    SlicePlane plane = alongSlice(*volume, k);
    plane.mmPerPixel = volume->geometry().spacing().x;
    plane.size = {n.x, n.y};
    const SliceValues slice = sliceOf(*volume, plane);
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) QVERIFY(slice.values[j * n.x + i] == volume->value(i, j, k));
  }
}

void TestSlice::whatIsNoPlaneIsRefused_data() {
  QTest::addColumn<SlicePlane>("plane");
  QTest::addColumn<QString>("sentence");
  constexpr double noNumber = std::numeric_limits<double>::quiet_NaN(),
                   infinity = std::numeric_limits<double>::infinity();
  const auto row = [](const char* name, const char* sentence, auto change) {
    SlicePlane plane;
    change(plane);
    QTest::newRow(name) << plane << QString::fromLatin1(sentence);
  };
  row("centre", "centre", [](SlicePlane& p) { p.centre.y = noNumber; });
  row("right is too long", "unit vectors", [](SlicePlane& p) { p.right.x = 1.1; });
  row("down is nothing", "unit vectors", [](SlicePlane& p) { p.down = {}; });
  row("not orthogonal", "orthogonal", [](SlicePlane& p) { p.down = {0.6, 0.8, 0}; });
  row("direction is no number", "unit vectors", [](SlicePlane& p) { p.down.z = noNumber; });
  row("no pixel", "0 x 1 pixels", [](SlicePlane& p) { p.size.x = 0; });
  row("too many pixels", "16385 x 16384 pixels", [](SlicePlane& p) { p.size = {16385, 16384}; });
  row("more than an int holds", "pixels", [](SlicePlane& p) { p.size = glm::ivec2(1 << 30); });
  row("pixels of nothing", "above 0 mm", [](SlicePlane& p) { p.mmPerPixel = 0; });
  row("pixels without end", "above 0 mm", [](SlicePlane& p) { p.mmPerPixel = infinity; });
  row("slab", "slab", [](SlicePlane& p) { p.slabMm = -1; });
  row("slab without end", "slab", [](SlicePlane& p) { p.slabMm = infinity; });
}

void TestSlice::whatIsNoPlaneIsRefused() {
  QFETCH(SlicePlane, plane);
  QFETCH(QString, sentence);
  const auto slice = resampleSlice(*someVolume(QStringLiteral("uint8")), plane);
  QVERIFY(!slice.ok());
  QVERIFY2(slice.message().find(sentence.toStdString()) != std::string::npos, slice.message().c_str());
}

void TestSlice::whatIsCancelledIsAnError() {
  const CancelToken cancel;
  cancel.cancel();
  QVERIFY(!resampleSlice(*someVolume(QStringLiteral("uint8")), SlicePlane(), 0, cancel).ok());
}

VOLUMEN_TEST(TestSlice);
#include "tst_slice.moc"
