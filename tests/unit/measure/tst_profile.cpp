// Guards the values along a line and the histogram of a region. Compares with closed forms and independent
// implementations.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/grids.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/measure/profile.h"
#include "viewer/measure/region.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

class TestProfile : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void isTheDefinition_data();
  void isTheDefinition();
  void aRampRises();
  void whatHasNoLengthHasNone();
  void longLinesStayShort();
  void countsAreThoseOfTheRegion_data();
  void countsAreThoseOfTheRegion();
  void wholeNumbersHaveBinsOfTheirOwn();
};

namespace {

// Returns the value at one point by slices.md 1; empty outside the box of the voxels.
std::optional<double> valueByHand(const Volume& volume, dvec3 p, bool nearest) {
  const VoxelGeometry& g = volume.geometry();
  const dvec3 x = g.voxelFromPatient(p), last = dvec3(g.size - 1);
  for (int a = 0; a < 3; ++a)
    if (x[a] < -0.5 || x[a] > last[a] + 0.5) return {};
  const dvec3 within = glm::clamp(nearest ? glm::floor(x + 0.5) : x, dvec3(0), last);
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    dvec3 voxel = glm::floor(within);
    double weight = 1;
    for (int a = 0; a < 3; ++a) {
      const bool upper = (corner >> a & 1) != 0;
      const double part = within[a] - std::floor(within[a]);
      weight *= upper ? part : 1 - part;
      voxel[a] = std::min(voxel[a] + (upper ? 1 : 0), last[a]);
    }
    if (weight > 0) sum += weight * double(volume.value(int(voxel.x), int(voxel.y), int(voxel.z)));
  }
  return sum;
}

Shape squareOn(dvec3 centre, double half) {
  Shape shape{ShapeKind::rectangle,
              "",
              {centre - dvec3(half, half, 0), centre + dvec3(half, half, 0)},
              ShapePlane{centre, {1, 0, 0}, {0, 1, 0}},
              {},
              {}};
  return shape;
}

}  // namespace

void TestProfile::isTheDefinition_data() {
  QTest::addColumn<glm::dmat3>("step");
  QTest::addColumn<bool>("nearest");
  for (const Grid& g : grids)
    for (const bool nearest : {false, true})
      QTest::addRow("%s, %s", g.name, nearest ? "nearest" : "linear") << g.patientFromVoxelStep << nearest;
}

// Random lines run in and out of the box. Positions are rounded to 2^-24 voxels, so that values of 0 to 1000
// differ by less than 1e-3. With `nearest`, a point within 1e-6 of the midpoint between two voxels may get
// either value.
void TestProfile::isTheDefinition() {
  QFETCH(glm::dmat3, step);
  QFETCH(bool, nearest);
  Chance chance(11);
  const VolumePtr volume = volumeOf<std::int16_t>(
      {9, 8, 7}, step, [&](dvec3) { return std::floor(1000 * chance.share()); }, 0.5, -20);
  int outside = 0, inside = 0;
  for (int n = 0; n < 60; ++n) {
    std::vector<dvec3> line;
    for (int k = 2 + chance.below(3); k > 0; --k) line.push_back(7.0 * chance.vector());
    double length = 0;
    for (std::size_t k = 1; k < line.size(); ++k) length += glm::length(line[k] - line[k - 1]);
    const auto profile =
        profileAlong(line, *volume, nearest ? Interpolation::nearest : Interpolation::linear);
    QVERIFY(profile.size() > line.size());
    QCOMPARE(profile.front().share, 0.0);
    QVERIFY(std::abs(profile.back().share - 1) < 1e-12);
    std::size_t segment = 1;
    double before = 0;
    for (const ProfilePoint& point : profile) {
      double at = point.share * length - before;
      while (segment + 1 < line.size() && at > glm::length(line[segment] - line[segment - 1]) + 1e-9) {
        at -= glm::length(line[segment] - line[segment - 1]);
        before += glm::length(line[segment] - line[segment - 1]);
        ++segment;
      }
      const dvec3 p = line[segment - 1] + at * glm::normalize(line[segment] - line[segment - 1]);
      const dvec3 x = volume->geometry().voxelFromPatient(p);
      bool onLimit = false;
      for (int a = 0; a < 3; ++a) {
        const double part = x[a] + 0.5 - std::floor(x[a] + 0.5);
        onLimit = onLimit || std::min(part, 1 - part) < 1e-6;
      }
      if (onLimit) continue;
      const std::optional<double> wanted = valueByHand(*volume, p, nearest);
      QCOMPARE(std::isnan(point.value), !wanted.has_value());
      ++(wanted ? inside : outside);
      if (wanted) QVERIFY(std::abs(point.value - *wanted) < 1e-3);
    }
  }
  QVERIFY(inside > 200 && outside > 100);
}

void TestProfile::aRampRises() {
  const VolumePtr volume = volumeOf<float>({21, 5, 5}, glm::dmat3(2), [](dvec3 x) { return 10 * x.x; });
  const std::vector<dvec3> line{{-20, 0, 0}, {20, 0, 0}};  // from the first voxel to the last
  const auto profile = profileAlong(line, *volume, Interpolation::linear);
  QCOMPARE(profile.size(), std::size_t(81));  // 20 steps between voxels, four samples each
  for (const ProfilePoint& point : profile) QVERIFY(std::abs(point.value - 200 * point.share) < 1e-4);
  const auto steps = profileAlong(line, *volume, Interpolation::nearest);
  for (std::size_t n = 0; n < steps.size(); ++n)
    QVERIFY(std::abs(steps[n].value - 10 * std::floor(double(n) / 4 + 0.5)) < 1e-4);
}

void TestProfile::whatHasNoLengthHasNone() {
  const VolumePtr volume = volumeOf<float>({3, 3, 3}, glm::dmat3(1), [](dvec3) { return 1; });
  QVERIFY(profileAlong(std::vector<dvec3>{}, *volume, Interpolation::linear).empty());
  QVERIFY(profileAlong(std::vector<dvec3>{{0, 0, 0}, {0, 0, 0}}, *volume, Interpolation::linear).empty());
  QVERIFY(!profileAlong(std::vector<dvec3>{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}, *volume, Interpolation::linear)
               .empty());
}

void TestProfile::longLinesStayShort() {
  const VolumePtr volume = volumeOf<float>({3, 3, 3}, glm::dmat3(0.001), [](dvec3) { return 1; });
  const std::vector<dvec3> line{{-500, 0, 0}, {500, 0, 0}, {500, 3, 0}};
  const auto profile = profileAlong(line, *volume, Interpolation::linear);
  QVERIFY(profile.size() > 3900 && profile.size() < 4100);
}

void TestProfile::countsAreThoseOfTheRegion_data() {
  QTest::addColumn<glm::dmat3>("step");
  QTest::addColumn<bool>("whole");
  for (const Grid& g : grids)
    for (const bool whole : {false, true})
      QTest::addRow("%s, %s", g.name, whole ? "whole numbers" : "fractions")
          << g.patientFromVoxelStep << whole;
}

// Counts every voxel of the region in the bin whose limits enclose its value.
void TestProfile::countsAreThoseOfTheRegion() {
  QFETCH(glm::dmat3, step);
  QFETCH(bool, whole);
  Chance chance(2);
  const VolumePtr volume = volumeOf<float>({14, 13, 12}, step, [&](dvec3) {
    const double value = chance.between(-300, 700);
    return whole ? std::floor(value) : value;
  });
  for (int n = 0; n < 20; ++n) {
    const Shape region = squareOn(2.0 * chance.vector(), chance.between(1, 8));
    const ValueCounts counts = countsOf(region, *volume);
    QVERIFY(counts.counts.size() <= 64);
    std::vector<double> values;
    forEachVoxelOf(region, *volume, [&](glm::ivec3, double value) { values.push_back(value); });
    std::vector<std::int64_t> wanted(counts.counts.size());
    for (const double value : values)
      for (std::size_t bin = 0; bin < wanted.size(); ++bin) {
        const double low = counts.low + counts.width * double(bin), high = low + counts.width;
        const bool isLast = bin + 1 == wanted.size();
        if (value >= low && (value < high || isLast)) {
          ++wanted[bin];
          break;
        }
      }
    // Rounded limits may move a value into the next bin.
    std::int64_t sum = 0, off = 0;
    for (std::size_t bin = 0; bin < wanted.size(); ++bin) {
      sum += counts.counts[bin];
      off += std::abs(counts.counts[bin] - wanted[bin]);
    }
    QCOMPARE(sum, std::int64_t(values.size()));
    QVERIFY(off <= (whole ? 0 : 2));
    if (whole) QCOMPARE(counts.width, std::round(counts.width));
  }
}

void TestProfile::wholeNumbersHaveBinsOfTheirOwn() {
  const VolumePtr volume =
      volumeOf<std::int16_t>({4, 4, 1}, glm::dmat3(1), [](dvec3 x) { return 7 + 2 * std::floor(x.x / 2); });
  const ValueCounts counts = countsOf(squareOn({0, 0, 0}, 2), *volume);
  QCOMPARE(counts.low, 6.5);
  QCOMPARE(counts.width, 1.0);
  QVERIFY((counts.counts == std::vector<std::int64_t>{8, 0, 8}));
  const VolumePtr equal = volumeOf<float>({4, 4, 1}, glm::dmat3(1), [](dvec3) { return 0.25; });
  const ValueCounts one = countsOf(squareOn({0, 0, 0}, 2), *equal);
  QCOMPARE(one.low, 0.25);
  QVERIFY(one.counts == std::vector<std::int64_t>{16});
  QVERIFY(countsOf(squareOn({0, 0, 0}, 0.1), *equal).counts.empty());
}

VOLUMEN_TEST(TestProfile);
#include "tst_profile.moc"
