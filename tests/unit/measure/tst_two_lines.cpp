// Guards the numbers of two lines: long and short axis (RECIST 1.1, WHO) and the cardiothoracic ratio. Covers
// measurements in patient space and on frames.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/grids.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/measure/frame_measure.h"
#include "viewer/measure/shape_json.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

class TestTwoLines : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void axesByChance_data();
  void axesByChance();
  void theRatioNeedsNoCalibration();
  void theLongerLineIsNamedSo_data();
  void theLongerLineIsNamedSo();
  void onFrames();
  void whatIsNoPairIsRefused();
  void asJson();
};

namespace {

Shape pairOfLines(ShapeKind kind, std::vector<dvec3> points) {
  return {kind, "", std::move(points), {}, {}, {}};
}

VolumePtr emptyOn(const glm::dmat3& step, bool calibrated = true) {
  VolumeParts parts;
  parts.geometry.size = {5, 5, 5};
  parts.geometry.patientFromVoxelStep = step;
  parts.geometry.calibrated = calibrated;
  parts.values = std::vector<float>(125);
  return volumeFrom(std::move(parts));
}

}  // namespace

void TestTwoLines::axesByChance_data() {
  QTest::addColumn<glm::dmat3>("step");
  for (const Grid& g : grids) QTest::newRow(g.name) << g.patientFromVoxelStep;
}

// Positions are in patient mm, so that the grid has no influence.
void TestTwoLines::axesByChance() {
  QFETCH(glm::dmat3, step);
  const VolumePtr volume = emptyOn(step);
  Chance chance(3);
  for (int n = 0; n < 200; ++n) {
    const dvec3 u = glm::normalize(chance.vector()), v = glm::normalize(glm::cross(u, chance.vector()));
    const double length = chance.between(1, 100), width = chance.between(0.1, 80);
    const dvec3 a = 50.0 * chance.vector(),
                c = a + chance.between(0, length) * u - chance.share() * width * v;
    const auto found =
        measure(pairOfLines(ShapeKind::bidirectional, {a, a + length * u, c, c + width * v}), *volume, "HU");
    QVERIFY2(found.ok(), found.ok() ? "" : found.message().c_str());
    // The line drawn last is sometimes the longer one.
    const double longer = std::max(length, width), shorter = std::min(length, width);
    QVERIFY(std::abs(found->number - longer) < 1e-9);
    QVERIFY(std::abs(found->lines->first - longer) < 1e-9 && std::abs(found->lines->second - shorter) < 1e-9);
    QCOMPARE(found->unit, std::string("mm"));
    QCOMPARE(found->lines->unit, std::string("mm"));
    QVERIFY(found->plusMinus.has_value());
    const auto ratio =
        measure(pairOfLines(ShapeKind::cardiothoracic, {c, c + width * v, a, a + length * u}), *volume, "HU");
    QVERIFY(std::abs(ratio->number - shorter / longer) < 1e-12);
    QVERIFY(std::abs(ratio->lines->first - shorter) < 1e-9 && std::abs(ratio->lines->second - longer) < 1e-9);
    QVERIFY(ratio->unit.empty() && !ratio->plusMinus);
  }
}

void TestTwoLines::theRatioNeedsNoCalibration() {
  const std::vector<dvec3> points{{1, 1, 0}, {13, 1, 0}, {-5, 4, 0}, {19, 4, 0}};
  const auto ratio =
      measure(pairOfLines(ShapeKind::cardiothoracic, points), *emptyOn(glm::dmat3(1), false), "");
  QCOMPARE(ratio->number, 0.5);
  QCOMPARE(ratio->lines->unit, std::string("px"));
  QCOMPARE(ratio->lines->first, 12.0);
  const auto axes =
      measure(pairOfLines(ShapeKind::bidirectional, {{0, 0, 0}, {8, 0, 0}, {3, -1, 0}, {3, 2, 0}}),
              *emptyOn(glm::dmat3(1), false), "");
  QCOMPARE(axes->unit, std::string("px"));
}

void TestTwoLines::theLongerLineIsNamedSo_data() {
  QTest::addColumn<int>("kind");
  QTest::addColumn<bool>("longerFirst");
  QTest::addColumn<double>("number");
  QTest::addColumn<double>("first");
  for (const bool longerFirst : {false, true}) {
    const char* when = longerFirst ? "first" : "last";
    QTest::addRow("long axis drawn %s", when) << int(ShapeKind::bidirectional) << longerFirst << 8.0 << 8.0;
    QTest::addRow("thorax drawn %s", when) << int(ShapeKind::cardiothoracic) << longerFirst << 0.25 << 2.0;
  }
}

void TestTwoLines::theLongerLineIsNamedSo() {
  QFETCH(int, kind);
  QFETCH(bool, longerFirst);
  QFETCH(double, number);
  QFETCH(double, first);
  std::vector<dvec3> points{{0, 0, 0}, {8, 0, 0}, {3, -1, 0}, {3, 1, 0}};
  if (!longerFirst) std::ranges::rotate(points, points.begin() + 2);
  const auto found = measure(pairOfLines(ShapeKind(kind), points), *emptyOn(glm::dmat3(1)), "HU");
  QCOMPARE(found->number, number);
  QCOMPARE(found->lines->first, first);
  QCOMPARE(found->lines->first * found->lines->second, 16.0);
}

void TestTwoLines::onFrames() {
  FramePixels frame;
  VolumeParts parts;
  parts.geometry.size = {40, 40, 1};
  parts.values = std::vector<float>(1600);
  frame.values = volumeFrom(std::move(parts));
  Shape axes = pairOfLines(ShapeKind::bidirectional, {{0, 0, 0}, {8, 0, 0}, {3, -1, 0}, {3, 2, 0}});
  axes.frame = ShapeFrame{"1.2.3", 0};
  Shape ratio = axes;
  ratio.kind = ShapeKind::cardiothoracic;
  const auto inPixels = measureOnFrame(axes, frame, "");
  QCOMPARE(inPixels->unit, std::string("px"));
  QCOMPARE(inPixels->lines->second, 3.0);
  QCOMPARE(measureOnFrame(ratio, frame, "")->number, 3.0 / 8);
  frame.pixel = {{0.5, 2}, PixelSizeKind::atDetector};
  const auto inMm = measureOnFrame(axes, frame, "");
  QCOMPARE(inMm->unit, std::string("mm"));
  QCOMPARE(inMm->number, 6.0);
  QCOMPARE(inMm->lines->second, 4.0);
  QCOMPARE(inMm->frame->calibration, std::string(pixelSizeWord(PixelSizeKind::atDetector)));
  const auto inMmRatio = measureOnFrame(ratio, frame, "");
  QCOMPARE(inMmRatio->number, 4.0 / 6);
  QCOMPARE(inMmRatio->frame->calibration, std::string(pixelSizeWord(PixelSizeKind::atDetector)));
  // The lines are perpendicular in mm, not in pixels.
  axes.points = {{0, 0, 0}, {8, 2, 0}, {0, 0, 0}, {8, -2, 0}};  // (4, 4) mm and (4, -4) mm
  QVERIFY(measureOnFrame(axes, frame, "").ok());
  axes.points[3] = {2, -8, 0};
  QVERIFY(!measureOnFrame(axes, frame, "").ok());
}

void TestTwoLines::whatIsNoPairIsRefused() {
  const VolumePtr grid = emptyOn(glm::dmat3(1));
  const auto message = [&](const Shape& shape) {
    const auto found = measure(shape, *grid, "");
    return QString::fromStdString(found ? std::string() : found.message());
  };
  using enum ShapeKind;
  QVERIFY(message(pairOfLines(bidirectional, {{0, 0, 0}, {8, 0, 0}, {3, 0, 0}}))
              .contains(QStringLiteral("not 3.")));
  QCOMPARE(message(pairOfLines(bidirectional, {{0, 0, 0}, {8, 0, 0}, {3, 0, 0}, {4, 3, 0}})),
           QStringLiteral("The short axis must be at right angles to the long one."));
  QCOMPARE(message(pairOfLines(bidirectional, {{0, 0, 0}, {8, 0, 0}, {3, 0, 0}, {3.01, 3, 0}})), QString());
  QCOMPARE(message(pairOfLines(cardiothoracic, {{0, 0, 0}, {8, 0, 0}, {3, 0, 0}, {3, 0, 0}})),
           QStringLiteral("There is no ratio where the thorax has no width."));
  QCOMPARE(message(pairOfLines(label, {{0, 0, 0}})), QStringLiteral("A label has no number."));
}

void TestTwoLines::asJson() {
  const VolumePtr volume = emptyOn(glm::dmat3(1));
  const Shape axes = pairOfLines(ShapeKind::bidirectional, {{0, 0, 0}, {8, 0, 0}, {3, -1, 0}, {3, 2, 0}});
  const auto json = measuredToJson(axes, measure(axes, *volume, "HU"));
  QCOMPARE(json["number"].get<double>(), 8.0);
  QCOMPARE(json["short"].get<double>(), 3.0);
  QCOMPARE(json["product"].get<double>(), 24.0);
  QCOMPARE(json["productUnit"].get<std::string>(), std::string("mm^2"));
  const Shape ratio = pairOfLines(ShapeKind::cardiothoracic, axes.points);
  const auto other = measuredToJson(ratio, measure(ratio, *volume, "HU"));
  QCOMPARE(other["heart"].get<double>(), 3.0);
  QCOMPARE(other["thorax"].get<double>(), 8.0);
  QCOMPARE(other["lengthUnit"].get<std::string>(), std::string("mm"));
  QVERIFY(other["unit"].is_null());
}

VOLUMEN_TEST(TestTwoLines);
#include "tst_two_lines.moc"
