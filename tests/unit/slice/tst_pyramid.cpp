// Guards slices.md 2 (reduced copies of large frames): each pixel of a copy is the mean of a block, a copy
// shows what the whole picture shows, and it is used only where its pixels are much smaller than the plane's.
#include <algorithm>
#include <cmath>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/slice/pyramid.h"
#include "viewer/slice/slice.h"

using namespace volumen;
using namespace volumen::tests;

class TestPyramid : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void blocksHaveTheirMeans_data();
  void blocksHaveTheirMeans();
  void aRampStaysARamp_data();
  void aRampStaysARamp();
  void paddingMixesAtItsBorderAlone();
  void theWholeIsSeenFromNear();
  void smallPicturesHaveNoCopies();
};

namespace {

const glm::ivec2 large(2603, 1701);

// Each pixel of the plane as large as so many of the picture's.
SlicePlane wholeAt(const Volume& picture, double pixels) {
  SlicePlane plane = planeAlong(picture.geometry(), {1, 0, 0}, {0, 1, 0});
  plane.mmPerPixel = pixels * std::max(picture.geometry().spacing().x, picture.geometry().spacing().y);
  plane.size = sizeToCover(picture.geometry(), plane);
  plane.average = true;
  return plane;
}

SliceValues sliceOf(const Volume& volume, const SlicePlane& plane) {
  const auto slice = resampleSlice(volume, plane);
  if (!slice) throw std::runtime_error(slice.message());
  return *slice;
}

// Calls use(place in the plane, n, the pixel's place in the picture) where the picture is farther than
// `margin` pixels from the edges.
template <class Use>
void overInner(const Volume& picture, const SlicePlane& plane, double margin, const Use& use) {
  const glm::dvec2 last = glm::dvec2(picture.size()) - 1.0;
  for (int y = 0; y < plane.size.y; ++y)
    for (int x = 0; x < plane.size.x; ++x) {
      const glm::dvec2 at(picture.geometry().voxelFromPatient(plane.patientFromPixel({x + 0.5, y + 0.5})));
      if (std::min(std::min(at.x, at.y), std::min(last.x - at.x, last.y - at.y)) < margin) continue;
      use(std::size_t(y) * std::size_t(plane.size.x) + std::size_t(x), at);
    }
}

}  // namespace

void TestPyramid::blocksHaveTheirMeans_data() {
  QTest::addColumn<QString>("type");
  QTest::addColumn<QSize>("size");
  QTest::addColumn<int>("edge");
  for (const char* type : {"uint8", "int16", "uint16", "float32"}) {
    const auto row = [&](const char* name, QSize size, int edge) {
      QTest::newRow(qPrintable(QStringLiteral("%1, %2").arg(QLatin1String(type), QLatin1String(name))))
          << QString::fromLatin1(type) << size << edge;
    };
    row("whole blocks", {16, 8}, 4);
    row("odd sizes", {13, 7}, 4);
    row("a row", {50, 1}, 4);
    row("less than a block", {3, 2}, 16);
  }
}

void TestPyramid::blocksHaveTheirMeans() {
  QFETCH(QString, type);
  QFETCH(QSize, size);
  QFETCH(int, edge);
  const glm::ivec3 n(size.width(), size.height(), 1);
  const VolumePtr picture = type == QLatin1String("uint8")    ? randomVolume<std::uint8_t>(n, 0, 256)
                            : type == QLatin1String("int16")  ? randomVolume<std::int16_t>(n, -32768, 32767)
                            : type == QLatin1String("uint16") ? randomVolume<std::uint16_t>(n, 0, 65535)
                                                              : randomVolume<float>(n, -1e5, 1);
  const std::vector<float> means = blockMeans(picture->stored(), glm::ivec2(n), edge);
  const int across = (n.x + edge - 1) / edge, down = (n.y + edge - 1) / edge;
  QCOMPARE(means.size(), std::size_t(across * down));
  for (int y = 0; y < down; ++y)
    for (int x = 0; x < across; ++x) {
      double sum = 0;
      int count = 0;
      for (int j = y * edge; j < std::min(n.y, (y + 1) * edge); ++j)
        for (int i = x * edge; i < std::min(n.x, (x + 1) * edge); ++i)
          sum += picture->value(i, j, 0), ++count;
      QCOMPARE(means[std::size_t(y * across + x)], float(sum / count));
    }
}

void TestPyramid::aRampStaysARamp_data() {
  QTest::addColumn<double>("slope");
  QTest::addColumn<double>("intercept");
  QTest::addColumn<double>("mmDown");
  QTest::addColumn<double>("pixels");
  QTest::newRow("as stored") << 1. << 0. << 1. << 8.;
  QTest::newRow("signed, rescaled") << 0.5 << -1024. << 1. << 9.3;
  QTest::newRow("falling") << -2. << 100. << 1. << 20.;
  QTest::newRow("oblong pixels") << 1. << 0. << 1.5 << 8.5;
  QTest::newRow("the smallest copy") << 1. << 0. << 1. << 40.;
}

// A closed form: means of a ramp are the ramp at the middle.
void TestPyramid::aRampStaysARamp() {
  QFETCH(double, slope);
  QFETCH(double, intercept);
  QFETCH(double, mmDown);
  QFETCH(double, pixels);
  const auto ramp = [](glm::dvec2 p) { return 3 * p.x - 2 * p.y; };
  const VolumePtr picture = volumeOf<std::int16_t>(
      {large, 1}, {1, 0, 0, 0, mmDown, 0, 0, 0, 1}, [&](glm::dvec3 p) { return ramp(glm::dvec2(p)); }, slope,
      intercept);
  const Pyramid pyramid(picture);
  const SlicePlane plane = wholeAt(*picture, pixels);
  const VolumePtr& copy = pyramid.seenOn(plane);
  QVERIFY(copy != picture);
  QVERIFY(copy->bytes() * 7 <= picture->bytes());
  QVERIFY2(subSamples(plane, copy->geometry()) * 3 < subSamples(plane, picture->geometry()),
           "a copy is drawn faster");
  const SliceValues seen = sliceOf(*copy, plane), whole = sliceOf(*picture, plane);
  int compared = 0;
  overInner(*picture, plane, 2 * pixels + 32, [&](std::size_t n, glm::dvec2 at) {
    const double expected = slope * ramp(at) + intercept;
    QVERIFY2(std::abs(seen.values[n] - expected) < 0.01 * std::abs(slope), qPrintable(QString::number(n)));
    QVERIFY(std::abs(whole.values[n] - expected) < 0.01 * std::abs(slope));
    ++compared;
  });
  QVERIFY(compared > 1000);
}

// As in the whole picture, whose averages take in padding as any value.
void TestPyramid::paddingMixesAtItsBorderAlone() {
  constexpr double padding = -2000, tissue = 300, border = 1301;
  const VolumePtr picture = volumeOf<std::int16_t>(
      {large, 1}, glm::dmat3(1), [](glm::dvec3 p) { return p.x < border ? padding : tissue; });
  const Pyramid pyramid(picture);
  const SlicePlane plane = wholeAt(*picture, 10);
  QVERIFY(pyramid.seenOn(plane) != picture);
  const SliceValues seen = sliceOf(*pyramid.seenOn(plane), plane);
  overInner(*picture, plane, 20, [&](std::size_t n, glm::dvec2 at) {
    const double value = seen.values[n];
    if (std::abs(at.x - border) > 12)
      QCOMPARE(value, at.x < border ? padding : tissue);
    else
      QVERIFY(value >= padding && value <= tissue);
  });
}

void TestPyramid::theWholeIsSeenFromNear() {
  const VolumePtr picture = randomVolume<std::uint16_t>({large, 1}, 0, 4096);
  const Pyramid pyramid(picture);
  QCOMPARE(pyramid.whole(), picture);
  for (const double pixels : {0.1, 1., 2., 7.9}) QCOMPARE(pyramid.seenOn(wholeAt(*picture, pixels)), picture);
  SlicePlane sampled = wholeAt(*picture, 20);
  sampled.average = false;
  QCOMPARE(pyramid.seenOn(sampled), picture);
  QVERIFY(pyramid.bytes() > 0 && pyramid.bytes() * 7 < picture->bytes());
}

void TestPyramid::smallPicturesHaveNoCopies() {
  const VolumePtr picture = randomVolume<std::uint16_t>({2048, 2047, 1}, 0, 4096);
  const Pyramid pyramid(picture);
  QCOMPARE(pyramid.bytes(), std::size_t(0));
  QCOMPARE(pyramid.seenOn(wholeAt(*picture, 100)), picture);
}

VOLUMEN_TEST(TestPyramid);
#include "tst_pyramid.moc"
