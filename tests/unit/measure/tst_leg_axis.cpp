// Guards the mechanical axis of a leg: its deviation from straight and, if the side is known, varus or
// valgus. Covers measurements in patient space and on frames.
#include <cmath>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/measure/frame_measure.h"
#include "viewer/measure/leg_axis.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

class TestLegAxis : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void legsByChance();
  void theSideNamesTheBend_data();
  void theSideNamesTheBend();
  void pixelsThatAreNoSquares();
  void pointsInOnePlaceAreRefused();
};

// The expected angle is a closed form of the knee's offset from the line between hip and ankle. It is the sum
// of the angles at both ends of that line.
void TestLegAxis::legsByChance() {
  Chance chance(5);
  for (int n = 0; n < 500; ++n) {
    const double thigh = chance.between(300, 500), shank = chance.between(300, 500),
                 off = chance.between(-60, 60);
    const std::vector<dvec3> leg{{0, 0, thigh}, {off, 0, 0}, {0, 0, -shank}};
    const double degrees =
        (std::atan(std::abs(off) / thigh) + std::atan(std::abs(off) / shank)) * 180 / std::acos(-1.0);
    const auto found = measureLegAxis(leg, 1);
    QVERIFY(found.ok() && found->leg);
    QVERIFY(std::abs(found->number - degrees) < 1e-9);
    QVERIFY(std::abs(found->leg->hka - (180 - degrees)) < 1e-9);
    QVERIFY(found->leg->bend == (off > 0 ? LegAxis::Bend::varus : LegAxis::Bend::valgus));
    const std::vector<dvec3> fromBelow(leg.rbegin(), leg.rend());
    QVERIFY(measureLegAxis(fromBelow, 1)->leg->bend == found->leg->bend);
    QVERIFY(measureLegAxis(leg, 0)->leg->bend == LegAxis::Bend::unknown);
  }
}

void TestLegAxis::theSideNamesTheBend_data() {
  QTest::addColumn<double>("knee");  // column offset from hip and ankle, to the right
  QTest::addColumn<int>("outwards");
  QTest::addColumn<int>("bend");
  using enum LegAxis::Bend;
  QTest::newRow("outwards, rows lead out") << 20.0 << 1 << int(varus);
  QTest::newRow("inwards, rows lead out") << -20.0 << 1 << int(valgus);
  QTest::newRow("outwards, rows lead in") << -20.0 << -1 << int(varus);
  QTest::newRow("inwards, rows lead in") << 20.0 << -1 << int(valgus);
  QTest::newRow("of no known side") << 20.0 << 0 << int(unknown);
  QTest::newRow("straight") << 0.0 << 1 << int(unknown);
}

void TestLegAxis::theSideNamesTheBend() {
  QFETCH(double, knee);
  QFETCH(int, outwards);
  QFETCH(int, bend);
  FramePixels frame;
  frame.values = volumeOf<float>({200, 400, 1}, glm::dmat3(1), [](dvec3) { return 0; });
  frame.outwards = outwards;
  const Shape shape{ShapeKind::legAxis,  "", {{100, 0, 0}, {100 + knee, 200, 0}, {100, 390, 0}}, {}, {},
                    ShapeFrame{"1.2", 0}};
  const auto found = measureOnFrame(shape, frame, "");
  QVERIFY2(found.ok(), found.ok() ? "" : found.message().c_str());
  QCOMPARE(int(found->leg->bend), bend);
  QCOMPARE(found->unit, std::string("degrees"));
}

// Pixels are twice as wide as high. The angle is 45 degrees in the displayed picture.
void TestLegAxis::pixelsThatAreNoSquares() {
  FramePixels frame;
  frame.values = volumeOf<float>({200, 400, 1}, glm::dmat3(1), [](dvec3) { return 0; });
  frame.pixel.mm = {2, 1};
  const Shape shape{ShapeKind::legAxis,  "", {{100, 0, 0}, {100, 200, 0}, {150, 300, 0}}, {}, {},
                    ShapeFrame{"1.2", 0}};
  QVERIFY(std::abs(measureOnFrame(shape, frame, "")->number - 45) < 1e-9);
}

void TestLegAxis::pointsInOnePlaceAreRefused() {
  QVERIFY(!measureLegAxis(std::vector<dvec3>{{0, 0, 1}, {0, 0, 1}, {0, 0, 2}}, 1));
  QVERIFY(!measureLegAxis(std::vector<dvec3>{{0, 0, 1}, {0, 0, 2}, {0, 0, 2}}, 1));
  const auto folded = measureLegAxis(std::vector<dvec3>{{0, 0, 1}, {0, 0, 2}, {0, 0, 1}}, 1);
  QVERIFY(folded.ok() && std::abs(folded->number - 180) < 1e-9);
}

VOLUMEN_TEST(TestLegAxis);
#include "tst_leg_axis.moc"
