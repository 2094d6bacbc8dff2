// Guards SmoothCurve: it passes through its points, has the length of closed forms, and refuses invalid
// input.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "viewer/slice/smooth_curve.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

class TestSmoothCurve : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void twoPointsAreALine();
  void circlesAndHelicesHaveTheirLength_data();
  void circlesAndHelicesHaveTheirLength();
  void randomCurvesRunThroughTheirPoints();
  void scaleAndPlaceChangeNothing();
  void whatRepeatsIsLeftOut();
  void aTurnBackIsACurve();
  void whatIsNoCurveIsRefused_data();
  void whatIsNoCurveIsRefused();
};

namespace {

SmoothCurve curveOf(const std::vector<dvec3>& points) { return *SmoothCurve::through(points); }

// Returns a helix about z of radius `a`, rising by `b` a radian, with a point every `degrees`.
std::vector<dvec3> helix(double a, double b, int degrees, int count) {
  std::vector<dvec3> points;
  for (int n = 0; n < count; ++n) {
    const double angle = n * degrees * std::numbers::pi / 180;
    points.emplace_back(a * std::cos(angle), a * std::sin(angle), b * angle);
  }
  return points;
}

std::vector<dvec3> randomPoints(Chance& chance) {
  std::vector<dvec3> points;
  for (int n = 2 + chance.below(8); n > 0; --n) points.push_back(50.0 * chance.vector());
  return points;
}

}  // namespace

void TestSmoothCurve::twoPointsAreALine() {
  const SmoothCurve curve = curveOf({{1, 2, 3}, {1, 5, 7}});
  QVERIFY(std::abs(curve.length() - 5) < 1e-9);
  QVERIFY(glm::distance(curve.at(2.5), dvec3(1, 3.5, 5)) < 1e-9);
  QVERIFY(glm::distance(curve.tangent(4), dvec3(0, 0.6, 0.8)) < 1e-9);
  QVERIFY(curve.at(-1) == dvec3(1, 2, 3));
  QVERIFY(glm::distance(curve.at(99), dvec3(1, 5, 7)) < 1e-12);
}

// Cubic pieces deviate from a circle of radius R by about R angle^4 / 43 if points are `angle` apart. The
// bounds are twice that.
void TestSmoothCurve::circlesAndHelicesHaveTheirLength_data() {
  QTest::addColumn<double>("rise");
  QTest::addColumn<int>("degrees");
  QTest::addColumn<double>("relative");
  QTest::addColumn<double>("off");
  QTest::newRow("circle, every 15 degrees") << 0. << 15 << 2e-4 << 0.01;
  QTest::newRow("circle, every 30 degrees") << 0. << 30 << 2e-3 << 0.15;
  QTest::newRow("helix, every 15 degrees") << 6.5 << 15 << 2e-4 << 0.01;
  QTest::newRow("helix, every 30 degrees") << 6.5 << 30 << 2e-3 << 0.15;
}

void TestSmoothCurve::circlesAndHelicesHaveTheirLength() {
  QFETCH(double, rise);
  QFETCH(int, degrees);
  QFETCH(double, relative);
  QFETCH(double, off);
  constexpr double radius = 30;
  const int count = 1 + 270 / degrees;
  const SmoothCurve curve = curveOf(helix(radius, rise, degrees, count));
  const double angle = (count - 1) * degrees * std::numbers::pi / 180;
  const double truth = std::hypot(radius, rise) * angle;
  QVERIFY2(std::abs(curve.length() / truth - 1) < relative,
           qPrintable(QString::number(curve.length() - truth)));
  for (int n = 0; n <= 500; ++n) {
    const dvec3 p = curve.at(curve.length() * n / 500);
    QVERIFY(std::abs(std::hypot(p.x, p.y) - radius) < off);
    QVERIFY(std::abs(glm::length(curve.tangent(curve.length() * n / 500)) - 1) < 1e-9);
  }
}

void TestSmoothCurve::randomCurvesRunThroughTheirPoints() {
  const Seeds seeds = seedsOf(100, 1000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const std::vector<dvec3> points = randomPoints(chance);
    const SmoothCurve curve = curveOf(points);
    const std::vector<double> knots = curve.knots();
    QCOMPARE(knots.size(), points.size());
    QCOMPARE(knots.back(), curve.length());
    double chords = 0;
    for (std::size_t n = 0; n < points.size(); ++n) {
      QVERIFY2(glm::distance(curve.at(knots[n]), points[n]) < 1e-6, qPrintable(QString::number(seed)));
      if (n > 0) chords += glm::distance(points[n - 1], points[n]);
    }
    QVERIFY(curve.length() > chords * (1 - 1e-9));
    // Equal steps of arc length are equally long, except where pieces slow down at sharp turns.
    const double step = curve.length() / 4000;
    for (int n = 1; n <= 4000; ++n)
      QVERIFY(glm::distance(curve.at((n - 1) * step), curve.at(n * step)) < step * 1.03);
    const std::vector<dvec3> line = curve.line(16);
    QCOMPARE(line.size(), 1 + 16 * (points.size() - 1));
    QVERIFY(glm::distance(line.back(), points.back()) < 1e-9);
  }
}

void TestSmoothCurve::scaleAndPlaceChangeNothing() {
  const std::vector<dvec3> points = helix(10, 3, 40, 7);
  std::vector<dvec3> others;
  for (const dvec3 p : points) others.push_back(1000.0 * dvec3(p.y, p.z, p.x) + dvec3(5, -6, 7));
  const SmoothCurve one = curveOf(points), other = curveOf(others);
  QVERIFY(std::abs(other.length() / one.length() - 1000) < 1e-6);
  const dvec3 p = one.at(0.3 * one.length()), q = other.at(0.3 * other.length());
  QVERIFY(glm::distance(q, 1000.0 * dvec3(p.y, p.z, p.x) + dvec3(5, -6, 7)) < 1e-5);
}

void TestSmoothCurve::whatRepeatsIsLeftOut() {
  const SmoothCurve curve = curveOf({{0, 0, 0}, {0, 0, 0}, {5, 0, 0}, {5, 0, 0}, {5, 0, 0}, {9, 3, 0}});
  QCOMPARE(curve.knots().size(), std::size_t(3));
  QCOMPARE(curve.length(), curveOf({{0, 0, 0}, {5, 0, 0}, {9, 3, 0}}).length());
}

void TestSmoothCurve::aTurnBackIsACurve() {
  const SmoothCurve curve = curveOf({{0, 0, 0}, {10, 0, 0}, {2, 0, 0}});
  QVERIFY(curve.length() >= 18 - 1e-6);
  for (int n = 0; n <= 1000; ++n) {
    const dvec3 t = curve.tangent(curve.length() * n / 1000);
    QVERIFY(std::abs(std::abs(t.x) - 1) < 1e-9 && t.y == 0 && t.z == 0);
  }
}

void TestSmoothCurve::whatIsNoCurveIsRefused_data() {
  QTest::addColumn<QList<double>>("xs");
  QTest::addColumn<QString>("says");
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  QTest::newRow("no point") << QList<double>{} << QStringLiteral("two different places");
  QTest::newRow("one point") << QList<double>{1} << QStringLiteral("two different places");
  QTest::newRow("two equal points") << QList<double>{1, 1} << QStringLiteral("two different places");
  QTest::newRow("no number") << QList<double>{1, nan, 3} << QStringLiteral("1e9 mm");
  QTest::newRow("infinite") << QList<double>{1, infinity} << QStringLiteral("1e9 mm");
  QTest::newRow("too far") << QList<double>{1, 2e9} << QStringLiteral("1e9 mm");
}

void TestSmoothCurve::whatIsNoCurveIsRefused() {
  QFETCH(QList<double>, xs);
  QFETCH(QString, says);
  std::vector<dvec3> points;
  for (const double x : xs) points.emplace_back(x, 0, 0);
  const auto curve = SmoothCurve::through(points);
  QVERIFY(!curve);
  QVERIFY2(QString::fromStdString(curve.message()).contains(says), curve.message().c_str());
}

VOLUMEN_TEST(TestSmoothCurve);
#include "tst_smooth_curve.moc"
