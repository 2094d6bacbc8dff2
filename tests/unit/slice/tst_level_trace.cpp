// Guards level_trace.h: the closed line at the value of a position, by closed forms and by properties of any
// such line. It consists of crossings between inside and outside pixels, each sharing a cell with the next
// one. The nearest crossing is among them.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <set>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "viewer/slice/level_trace.h"

using namespace volumen;
using namespace volumen::tests;

class TestLevelTrace : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aConeIsTracedByACircle_data();
  void aConeIsTracedByACircle();
  void aRampIsClosedByTheEdges();
  void aFlatAreaIsTracedAroundItsPixels();
  void whatHasNoValueIsBelow();
  void nothingWhereThereIsNoValue_data();
  void nothingWhereThereIsNoValue();
  void theNearerOfTwoIsTaken();
  void aSaddleIsPartedAsItsFunctionIs();
  void anyLineIsClosedAndAtItsValue();
};

namespace {

using TracePoints = std::vector<glm::dvec2>;
constexpr float noValue = std::numeric_limits<float>::quiet_NaN();

// Returns a slice of `value` at pixel centres.
template <class Value>
SliceValues tracedSlice(glm::ivec2 size, const Value& value) {
  SliceValues slice{size, {}};
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) slice.values.push_back(float(value(glm::dvec2(x + 0.5, y + 0.5))));
  return slice;
}

double signedArea(const TracePoints& line) {
  double area = 0;
  for (std::size_t n = 0; n < line.size(); ++n) {
    const glm::dvec2 a = line[n], b = line[(n + 1) % line.size()];
    area += (a.x * b.y - a.y * b.x) / 2;
  }
  return area;
}

bool isInside(const TracePoints& line, glm::dvec2 p) {
  bool inside = false;
  for (std::size_t n = 0; n < line.size(); ++n) {
    const glm::dvec2 a = line[n], b = line[(n + 1) % line.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

}  // namespace

void TestLevelTrace::aConeIsTracedByACircle_data() {
  QTest::addColumn<double>("sign");
  QTest::newRow("bright in the middle") << 1.0;
  QTest::newRow("dark in the middle") << -1.0;
}

void TestLevelTrace::aConeIsTracedByACircle() {
  QFETCH(double, sign);
  const glm::dvec2 middle(31.3, 28.8);
  const SliceValues slice =
      tracedSlice({64, 60}, [&](glm::dvec2 p) { return -sign * glm::distance(p, middle); });
  for (const double radius : {2.5, 7.0, 20.0}) {
    const TracePoints line = levelTrace(slice, middle + radius * glm::dvec2(0.6, 0.8));
    QVERIFY(!line.empty());
    for (const glm::dvec2 p : line) QVERIFY(std::abs(glm::distance(p, middle) - radius) < 0.05);
    const double circle = std::acos(-1.0) * radius * radius;
    QVERIFY2(std::abs(std::abs(signedArea(line)) / circle - 1) < 0.06,
             qPrintable(QString::number(signedArea(line) / circle)));
  }
}

// All pixels to the right are brighter. The line is a rectangle that ends half a pixel beyond the outermost
// centres.
void TestLevelTrace::aRampIsClosedByTheEdges() {
  const SliceValues slice = tracedSlice({20, 10}, [](glm::dvec2 p) { return 3 * p.x + 100; });
  const TracePoints line = levelTrace(slice, {7.3, 4.1});
  double left = 100;
  for (const glm::dvec2 p : line) {
    left = std::min(left, p.x);
    QVERIFY(p.x <= 20 && p.y >= 0 && p.y <= 10);
  }
  QVERIFY(std::abs(left - 7.3) < 1e-5);
  QVERIFY(std::abs(std::abs(signedArea(line)) - (20 - 7.3) * 10) < 1);  // its corners are cut
}

// All pixels of the flat area have one value. Their centres are inside, neighbouring ones are not.
void TestLevelTrace::aFlatAreaIsTracedAroundItsPixels() {
  const auto isFlat = [](glm::dvec2 p) { return p.x > 5 && p.x < 9 && p.y > 3 && p.y < 6; };
  const SliceValues slice = tracedSlice({16, 12}, [&](glm::dvec2 p) { return isFlat(p) ? 1000 : 0; });
  const TracePoints line = levelTrace(slice, {7, 4.5});
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 16; ++x) {
      const glm::dvec2 p(x + 0.5, y + 0.5);
      QCOMPARE(isInside(line, p), isFlat(p));
    }
  // A picture of one value lies completely inside.
  const TracePoints all = levelTrace(tracedSlice({4, 3}, [](glm::dvec2) { return 5; }), {1.5, 1.5});
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) QVERIFY(isInside(all, {x + 0.5, y + 0.5}));
}

void TestLevelTrace::whatHasNoValueIsBelow() {
  const auto hasValue = [](glm::dvec2 p) { return glm::distance(p, glm::dvec2(10)) < 6; };
  const SliceValues slice =
      tracedSlice({20, 20}, [&](glm::dvec2 p) { return hasValue(p) ? -900 : double(noValue); });
  const TracePoints line = levelTrace(slice, {10.2, 10.7});
  QVERIFY(!line.empty());
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) {
      const glm::dvec2 p(x + 0.5, y + 0.5);
      QCOMPARE(isInside(line, p), hasValue(p));
    }
}

void TestLevelTrace::nothingWhereThereIsNoValue_data() {
  QTest::addColumn<QPointF>("at");
  QTest::newRow("on a pixel without one") << QPointF(1.5, 1.5);
  QTest::newRow("left of all") << QPointF(-0.1, 1.5);
  QTest::newRow("below all") << QPointF(1.5, 3);
}

void TestLevelTrace::nothingWhereThereIsNoValue() {
  QFETCH(QPointF, at);
  const SliceValues slice =
      tracedSlice({4, 3}, [](glm::dvec2 p) { return p == glm::dvec2(1.5) ? double(noValue) : p.x; });
  QVERIFY(levelTrace(slice, {at.x(), at.y()}).empty());
  QVERIFY(!levelTrace(slice, {2.5, 1.5}).empty());
}

// Two discs have the same value, and the pointer is beside one of them.
void TestLevelTrace::theNearerOfTwoIsTaken() {
  const glm::dvec2 first(10, 10), second(30, 10);
  const SliceValues slice = tracedSlice({40, 20}, [&](glm::dvec2 p) {
    return std::max(0.0, 8 - std::min(glm::distance(p, first), glm::distance(p, second)));
  });
  QVERIFY(isInside(levelTrace(slice, {14, 10}), first) && !isInside(levelTrace(slice, {14, 10}), second));
  QVERIFY(isInside(levelTrace(slice, {26, 10}), second) && !isInside(levelTrace(slice, {26, 10}), first));
}

// Two diagonal corners of a cell are inside. They are connected exactly if the saddle is above the level.
void TestLevelTrace::aSaddleIsPartedAsItsFunctionIs() {
  Chance chance(5);
  int joined = 0, parted = 0;
  for (int n = 0; n < 400; ++n) {
    const double a = chance.between(5, 9), d = chance.between(5, 9), b = chance.between(0, 4),
                 c = chance.between(0, 4), level = chance.between(4.01, 4.99);
    const auto value = [&](double x, double y) {
      return (1 - y) * ((1 - x) * a + x * b) + y * ((1 - x) * c + x * d);
    };
    const double saddle = value((a - c) / (a + d - b - c), (a - b) / (a + d - b - c));
    if (std::abs(saddle - level) < 0.01) continue;
    // Position on the upper edge at the level.
    const double x = (a - level) / (a - b);
    SliceValues slice{{2, 2}, {float(a), float(b), float(c), float(d)}};
    const TracePoints line = levelTrace(slice, {0.5 + x, 0.5});
    QVERIFY(isInside(line, {0.5, 0.5}));
    QCOMPARE(isInside(line, {1.5, 1.5}), saddle > level);
    ++(saddle > level ? joined : parted);
  }
  QVERIFY(joined > 50 && parted > 50);
}

void TestLevelTrace::anyLineIsClosedAndAtItsValue() {
  const Seeds seeds = seedsOf(2000, 50000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const glm::ivec2 size(1 + chance.below(9), 1 + chance.below(9));
    const int kinds = 2 + chance.below(20);
    const bool hasGaps = chance.oneIn(3);
    const SliceValues slice = tracedSlice(size, [&](glm::dvec2) {
      return hasGaps && chance.oneIn(5) ? double(noValue) : double(chance.below(kinds));
    });
    // The level is the value at a pixel's centre.
    const glm::ivec2 pixel(chance.below(size.x), chance.below(size.y));
    const auto valueAt = [&](glm::ivec2 p) {
      const bool isThere = p.x >= 0 && p.y >= 0 && p.x < size.x && p.y < size.y;
      return isThere ? slice.values[std::size_t(p.y * size.x + p.x)] : noValue;
    };
    const float level = valueAt(pixel);
    const auto isIn = [&](glm::ivec2 p) { return valueAt(p) >= level; };
    const glm::dvec2 at = glm::dvec2(pixel) + 0.5;
    const TracePoints line = levelTrace(slice, at);
    QCOMPARE(line.empty(), std::isnan(level));
    if (line.empty()) continue;
    std::set<std::pair<double, double>> seen;
    double nearest = 1e9;
    for (std::size_t n = 0; n < line.size(); ++n) {
      const glm::dvec2 p = line[n], on = p - 0.5, next = line[(n + 1) % line.size()] - 0.5;
      QVERIFY2(seen.insert({p.x, p.y}).second, "no point twice");
      QVERIFY2((on.x == std::floor(on.x)) != (on.y == std::floor(on.y)), "between two pixels");
      const glm::ivec2 low(glm::floor(on)), high(glm::ceil(on));
      QVERIFY2(isIn(low) != isIn(high), "of which one is within");
      const double a = double(valueAt(low)), b = double(valueAt(high)),
                   way = glm::distance(on, glm::dvec2(low));
      const double expected =
          std::isnan(a) || std::isnan(b) ? 0.5 : std::clamp((double(level) - a) / (b - a), 0.02, 0.98);
      QVERIFY2(std::abs(way - expected) < 1e-9, qPrintable(QString::number(seed)));
      // The next crossing lies in the same cell.
      const glm::dvec2 cell = glm::floor((on + next) / 2.0);
      for (const glm::dvec2 q : {on, next})
        QVERIFY2(q.x >= cell.x && q.x <= cell.x + 1 && q.y >= cell.y && q.y <= cell.y + 1, "one cell");
      nearest = std::min(nearest, glm::distance(p, at));
    }
    // No crossing is nearer.
    for (int y = -1; y < size.y; ++y)
      for (int x = -1; x < size.x; ++x)
        for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(0, 1)}) {
          const glm::ivec2 p(x, y), q = p + step;
          if (isIn(p) == isIn(q)) continue;
          const double a = double(valueAt(p)), b = double(valueAt(q));
          const double way =
              std::isnan(a) || std::isnan(b) ? 0.5 : std::clamp((double(level) - a) / (b - a), 0.02, 0.98);
          QVERIFY(glm::distance(glm::dvec2(p) + 0.5 + way * glm::dvec2(step), at) > nearest - 1e-9);
        }
  }
}

VOLUMEN_TEST(TestLevelTrace);
#include "tst_level_trace.moc"
