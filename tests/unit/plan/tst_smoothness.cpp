// Guards design.md 5, "curve smooth: plain steps": how strongly the curve amplifies changes from voxel to
// voxel.
#include <cmath>
#include <limits>

#include "tests/unit/suite.h"
#include "viewer/plan/facts.h"
#include "viewer/plan/smoothness.h"

namespace {

using namespace volumen;

constexpr double never = std::numeric_limits<double>::infinity();

// Values are 0 .. 256. They rise by 2 a voxel up to 128 and by 10 above.
VolumeFacts someFacts() {
  VolumeFacts facts;
  facts.range = {0, 256};
  facts.gradientBounds.assign(256, 2.0f);
  std::fill(facts.gradientBounds.begin() + 128, facts.gradientBounds.end(), 10.0f);
  return facts;
}

using Points = std::vector<CurvePoint>;

}  // namespace

Q_DECLARE_METATYPE(Points)

class TestSmoothness : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aCurveIsAsSteepAs_data();
  void aCurveIsAsSteepAs();
};

void TestSmoothness::aCurveIsAsSteepAs_data() {
  QTest::addColumn<Points>("points");
  QTest::addColumn<double>("perMm");
  QTest::addColumn<double>("change");
  const auto row = [](const char* name, Points points, double perMm, double change) {
    QTest::newRow(name) << points << perMm << change;
  };
  const glm::dvec3 grey(0.5), white(1);
  const double half = std::log(2.0), tenth = -std::log(0.9);
  row("nothing to see", {{0, white, 0}, {100, white, 0}}, 0, 0);
  row("the same everywhere", {{0, white, 0.5}}, half, 0);
  // d(-ln(1 - a))/da is 1 / (1 - a), at most 2 here. The curve spans 64 values that rise by 2 a voxel.
  row("rises where values rise slowly", {{0, white, 0}, {64, white, 0.5}}, half, 0.5 * 2 / 64 * 2);
  row("rises where they rise fast", {{160, white, 0}, {224, white, 0.5}}, half, 0.5 * 2 / 64 * 10);
  row("the steepest part counts", {{0, white, 0}, {64, white, 0.1}, {65, white, 0}}, tenth,
      0.1 / 0.9 / 1 * 2);
  row("colour changes, opacity does not", {{0, grey, 0.5}, {64, white, 0.5}}, half, half * 0.5 / 64 * 2);
  row("colours of what is not seen", {{0, grey, 0}, {64, white, 0}, {128, white, 0}}, 0, 0);
  row("jumps", {{64, white, 0}, {64, white, 0.1}}, tenth, never);
  row("rises to opaque", {{0, white, 0}, {64, white, 1}}, never, never);
  row("opaque in one colour", {{0, white, 1}, {64, white, 1}}, never, 0);
  row("opaque in two", {{0, white, 1}, {64, grey, 1}}, never, never);
  row("jumps below all values", {{-20, white, 0}, {-20, white, 0.5}, {300, white, 0.5}}, half, 0);
  row("jumps above all values", {{0, white, 0}, {400, white, 0}, {400, white, 0.5}}, 0, 0);
}

void TestSmoothness::aCurveIsAsSteepAs() {
  QFETCH(Points, points);
  QFETCH(double, perMm);
  QFETCH(double, change);
  TransferFunction curve;
  curve.points = points;
  curve.unitDistance = 1;
  const Steepness once = steepnessOf(curve, someFacts());
  QCOMPARE(once.perMm, perMm);
  QCOMPARE(once.change, change);
  if (!std::isfinite(change)) return;
  // The same opacity over twice the distance is half the extinction.
  curve.unitDistance = 2;
  QCOMPARE(steepnessOf(curve, someFacts()).change, change / 2);
}

VOLUMEN_TEST(TestSmoothness);
#include "tst_smoothness.moc"
