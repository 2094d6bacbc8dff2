// Guards slices.md 4: a shape on ultrasound is measured by the innermost region that holds its points.
#include <algorithm>
#include <cmath>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/measure/frame_measure.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

class TestUltrasoundRegions : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void lengthsHaveTheScaleOfTheirRegion_data();
  void lengthsHaveTheScaleOfTheirRegion();
};

namespace {

constexpr int centimetres = 3, seconds = 4, cmPerSecond = 7;

UltrasoundRegion region(glm::ivec2 from, glm::ivec2 to, double delta, int unitX = centimetres,
                        int unitY = centimetres) {
  UltrasoundRegion r;
  r.from = from;
  r.to = to;
  r.unitX = unitX;
  r.unitY = unitY;
  r.delta = glm::dvec2(delta);
  return r;
}

}  // namespace

void TestUltrasoundRegions::lengthsHaveTheScaleOfTheirRegion_data() {
  QTest::addColumn<dvec3>("from");
  QTest::addColumn<dvec3>("to");
  QTest::addColumn<bool>("backwards");  // reverses the order of the regions in the file
  QTest::addColumn<double>("number");
  QTest::addColumn<QString>("unit");
  const auto row = [](const char* name, dvec3 from, dvec3 to, double number, const char* unit) {
    for (const bool backwards : {false, true})
      QTest::addRow("%s%s", name, backwards ? ", listed backwards" : "")
          << from << to << backwards << number << QString::fromLatin1(unit);
  };
  row("in the outer region", {2, 2, 0}, {10, 2, 0}, 16, "mm");
  row("in the inset", {41, 41, 0}, {49, 41, 0}, 8, "mm");
  row("in the inset of the inset", {44, 44, 0}, {46, 44, 0}, 1, "mm");
  row("from one to the other", {2, 41, 0}, {42, 41, 0}, 40, "px");
  row("in the box of colour, which has the same scale", {62, 62, 0}, {66, 62, 0}, 8, "mm");
  row("out of that box", {62, 62, 0}, {82, 62, 0}, 40, "mm");
  row("in a spectrum inside", {22, 62, 0}, {26, 62, 0}, 4, "px");
  row("outside of all", {2, 120, 0}, {6, 120, 0}, 4, "px");
}

void TestUltrasoundRegions::lengthsHaveTheScaleOfTheirRegion() {
  QFETCH(dvec3, from);
  QFETCH(dvec3, to);
  QFETCH(bool, backwards);
  QFETCH(double, number);
  QFETCH(QString, unit);
  FramePixels frame;
  VolumeParts parts;
  parts.geometry.size = {128, 128, 1};
  parts.values = std::vector<std::uint8_t>(128 * 128, 1);
  frame.values = volumeFrom(std::move(parts));
  frame.regions = {region({0, 0}, {99, 99}, 0.2), region({40, 40}, {50, 50}, 0.1),
                   region({43, 43}, {47, 47}, 0.05), region({60, 60}, {70, 70}, 0.2),
                   region({20, 60}, {30, 70}, 0.01, seconds, cmPerSecond)};
  if (backwards) std::ranges::reverse(frame.regions);
  Shape shape;
  shape.kind = ShapeKind::length;
  shape.points = {from, to};
  const auto measured = measureOnFrame(shape, frame, {});
  QVERIFY(measured.ok());
  QVERIFY2(std::abs(measured->number - number) < 1e-9, qPrintable(QString::number(measured->number)));
  QCOMPARE(QString::fromStdString(measured->unit), unit);
}

VOLUMEN_TEST(TestUltrasoundRegions);
#include "tst_ultrasound_regions.moc"
