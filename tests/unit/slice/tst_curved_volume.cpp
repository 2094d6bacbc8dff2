// Guards curved volumes: values are those at the patient points that the grid names. Frames do not turn about
// the curve, and closed forms of lines, helices and arcs hold.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/grids.h"
#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/slice/curved.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

class TestCurvedVolume : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aLineThroughVoxelsShowsThem_data();
  void aLineThroughVoxelsShowsThem();
  void aHelicalTubeBecomesStraight();
  void theFrameOfAHelixTurnsBackByItsTorsion();
  void framesDoNotTurn();
  void aRampIsThatOfThePatient_data();
  void aRampIsThatOfThePatient();
  void anArcIsUnrolled();
  void theFootOfTheCurveIsOnTheSurface();
  void placesComeBack();
  void theBestPlaneGivesTheDirection_data();
  void theBestPlaneGivesTheDirection();
};

namespace {

constexpr double pi = std::numbers::pi;

// Radius 20 mm, 40 mm a turn: a point every 15 degrees, 1.2 turns about the middle of the volume.
constexpr double helixRadius = 20, helixRise = 40 / (2 * pi), helixFrom = -1.2 * pi;
dvec3 onHelix(double angle) {
  return {helixRadius * std::cos(angle), helixRadius * std::sin(angle), helixRise * angle};
}
std::vector<dvec3> helixPoints() {
  std::vector<dvec3> points;
  for (double angle = helixFrom; angle < -helixFrom + 1e-9; angle += 0.05 * 2 * pi * 0.8)
    points.push_back(onHelix(angle));
  return points;
}

// Returns the distance of a point from the helix. The nearest angle is searched near that of the same height.
double fromHelix(dvec3 p) {
  const auto squared = [&](double angle) {
    const dvec3 way = p - onHelix(angle);
    return glm::dot(way, way);
  };
  double best = p.z / helixRise, width = 1.6;
  for (int n = 0; n < 8; ++n, width /= 4) {
    const double middle = best;
    for (int part = -8; part <= 8; ++part)
      if (const double angle = middle + width * part / 8; squared(angle) < squared(best)) best = angle;
  }
  return std::sqrt(squared(best));
}

// Returns points with bends of up to about 40 degrees every 10 to 20 mm.
std::vector<dvec3> randomWalk(Chance& chance) {
  std::vector<dvec3> points{{0, 0, 0}};
  dvec3 way = glm::normalize(chance.vector() + dvec3(0, 0, 2));
  for (int n = 2 + chance.below(5); n > 0; --n) {
    way = glm::normalize(way + 0.6 * chance.vector());
    points.push_back(points.back() + chance.between(10, 20) * way);
  }
  return points;
}

// Applies to `v` the smallest rotation from one unit vector to another.
dvec3 turned(dvec3 v, dvec3 from, dvec3 to) {
  const dvec3 axis = glm::cross(from, to);
  const double sine = glm::length(axis), cosine = glm::dot(from, to);
  if (sine < 1e-14) return v;
  const dvec3 k = axis / sine;
  return v * cosine + glm::cross(k, v) * sine + k * glm::dot(k, v) * (1 - cosine);
}

}  // namespace

void TestCurvedVolume::aLineThroughVoxelsShowsThem_data() {
  QTest::addColumn<bool>("up");
  QTest::newRow("towards the head") << true;
  QTest::newRow("towards the feet") << false;
}

// The picture must equal the slices themselves in either direction of the curve. Positions are rounded to
// 2^-24 voxels, and neighbours differ by up to 2000.
void TestCurvedVolume::aLineThroughVoxelsShowsThem() {
  QFETCH(bool, up);
  const VolumePtr source = randomVolume<std::int16_t>({21, 19, 17}, -1000, 1000);
  std::vector<dvec3> points{{10, 9, 3}, {10, 9, 8.5}, {10, 9, 14}};
  if (!up) std::ranges::reverse(points);
  const VolumePtr volume = laidOut(*source, recipeOf(CurvedKind::straightened, points, 5));
  const VoxelGeometry& g = volume->geometry();
  QCOMPARE(g.size, glm::ivec3(11, 11, 12));
  QVERIFY(glm::determinant(g.patientFromVoxelStep) > 0);
  for (int k = 0; k < g.size.z; ++k)
    for (int j = 0; j < g.size.y; ++j)
      for (int i = 0; i < g.size.x; ++i) {
        const glm::ivec3 voxel(glm::round(g.patientFromVoxel({i, j, k}) + points[0]));
        const float truth = source->value(voxel.x, voxel.y, voxel.z);
        QVERIFY(std::abs(volume->value(i, j, k) - truth) < 2e-3f);
      }
}

// The bound is 0.1 mm for trilinear interpolation of a distance plus 0.02 mm for the curve through the
// points. The former is 1/8 mm^2 of a curvature of 1/2 per mm, twice.
void TestCurvedVolume::aHelicalTubeBecomesStraight() {
  const glm::ivec3 size(61, 61, 61);
  const VolumePtr source = volumeOf(size, glm::dmat3(1), [&](dvec3 x) {
    const dvec3 p = x - (dvec3(size) - 1.0) / 2.0;
    return std::abs(std::hypot(p.x, p.y) - helixRadius) < 9 ? fromHelix(p) : 20;
  });
  const VolumePtr volume = laidOut(*source, recipeOf(CurvedKind::straightened, helixPoints()));
  const VoxelGeometry& g = volume->geometry();
  const double truth = std::hypot(helixRadius, helixRise) * -2 * helixFrom;
  const double length = g.spacing().z * (g.size.z - 1);
  QVERIFY2(std::abs(length / truth - 1) < 2e-4, qPrintable(QString::number(length / truth - 1)));
  double worst = 0;
  for (int k = 2; k < g.size.z - 2; ++k)
    for (int j = 0; j < g.size.y; ++j)
      for (int i = 0; i < g.size.x; ++i) {
        const dvec3 p = g.patientFromVoxel({i, j, k});
        const double radius = std::hypot(p.x, p.y);
        if (radius < 2 || radius > 5) continue;
        worst = std::max(worst, std::abs(double(volume->value(i, j, k)) - radius));
      }
  QVERIFY2(worst < 0.15, qPrintable(QString::number(worst)));
}

// Relative to the Frenet normal, a frame that does not turn rotates back by torsion times length.
void TestCurvedVolume::theFrameOfAHelixTurnsBackByItsTorsion() {
  const CurvedGrid grid = gridOf(recipeOf(CurvedKind::straightened, helixPoints()), boxOf());
  const double squared = helixRadius * helixRadius + helixRise * helixRise;
  const auto angleOf = [](const CurvedGrid::Section& section) {
    const double angle = section.at.z / helixRise;
    const dvec3 normal(-std::cos(angle), -std::sin(angle), 0), binormal = glm::cross(section.along, normal);
    return std::atan2(glm::dot(section.right, binormal), glm::dot(section.right, normal));
  };
  double turn = 0;
  for (std::size_t n = 1; n < grid.sections().size(); ++n)
    turn += std::remainder(angleOf(grid.sections()[n]) - angleOf(grid.sections()[n - 1]), 2 * pi);
  const double truth = -helixRise / squared * grid.length();
  QVERIFY2(std::abs(turn - truth) < 0.01, qPrintable(QString::number(turn - truth)));
}

// Compares with a first frame carried along by small rotations, one for each fiftieth of a section.
void TestCurvedVolume::framesDoNotTurn() {
  const Seeds seeds = seedsOf(25, 300);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const std::vector<dvec3> points = randomWalk(chance);
    const CurvedGrid grid = gridOf(recipeOf(CurvedKind::straightened, points), boxOf());
    const SmoothCurve curve = *SmoothCurve::through(points);
    const std::size_t last = grid.sections().size() - 1;
    dvec3 carried = grid.sections()[0].right;
    for (std::size_t n = 0; n <= last; ++n) {
      const CurvedGrid::Section& section = grid.sections()[n];
      const double at = curve.length() * double(n) / double(last);
      QVERIFY(glm::distance(section.at, curve.at(at)) < 1e-9);
      QVERIFY(std::abs(glm::length(section.right) - 1) < 1e-9);
      QVERIFY(std::abs(glm::dot(section.right, section.along)) < 1e-9);
      QVERIFY(glm::distance(glm::cross(section.right, section.down), section.along) < 1e-9);
      QVERIFY2(glm::distance(section.right, carried) < 0.02, qPrintable(QString::number(seed)));
      for (int part = 0; part < 50 && n < last; ++part) {
        const double step = curve.length() / double(last) / 50;
        carried = turned(carried, curve.tangent(at + part * step), curve.tangent(at + (part + 1) * step));
      }
    }
  }
}

void TestCurvedVolume::aRampIsThatOfThePatient_data() {
  QTest::addColumn<int>("grid");
  QTest::addColumn<int>("kind");
  for (int n = 0; n < int(std::size(grids)); ++n)
    for (const CurvedKind kind : {CurvedKind::straightened, CurvedKind::stretched})
      QTest::addRow("%s, %s", grids[n].name, kind == CurvedKind::stretched ? "stretched" : "straightened")
          << n << int(kind);
}

// Trilinear interpolation reproduces a ramp up to float32 and 2^-24 voxels.
void TestCurvedVolume::aRampIsThatOfThePatient() {
  QFETCH(int, grid);
  QFETCH(int, kind);
  const glm::dmat3 step = grids[grid].patientFromVoxelStep;
  const glm::ivec3 size(40, 40, 40);
  const dvec3 slope(3, -2, 1.5), middle = step * ((dvec3(size) - 1.0) / 2.0);
  const auto ramp = [&](dvec3 p) { return glm::dot(slope, p) + 7; };
  const VolumePtr source = volumeOf(size, step, [&](dvec3 x) { return ramp(step * x - middle); });
  const CurvedRecipe recipe = recipeOf(CurvedKind(kind), {{-4, 2, -3}, {0, -3, 0}, {4, 1, 2}, {3, 5, 6}}, 5);
  const CurvedGrid curved = gridOf(recipe, source->geometry());
  const VolumePtr volume = laidOut(*source, recipe);
  QVERIFY(volume->geometry() == curved.geometry());
  int seen = 0;
  for (int k = 0; k < volume->size().z; ++k)
    for (int j = 0; j < volume->size().y; ++j)
      for (int i = 0; i < volume->size().x; ++i) {
        const dvec3 p = curved.patientFromCurved(volume->geometry().patientFromVoxel({i, j, k}));
        const dvec3 x = source->geometry().voxelFromPatient(p);
        if (glm::any(glm::lessThan(x, dvec3(0))) || glm::any(glm::greaterThan(x, dvec3(size) - 1.0)))
          continue;
        ++seen;
        QVERIFY(std::abs(double(volume->value(i, j, k)) - ramp(p)) < 2e-3);
      }
  QVERIFY2(seen > 1000, qPrintable(QString::number(seen)));
}

// Half a circle of radius 20 mm in an axial plane becomes a line of its length. Its centre lies 20 mm across.
void TestCurvedVolume::anArcIsUnrolled() {
  std::vector<dvec3> points;
  for (int n = 0; n <= 12; ++n)
    points.emplace_back(-20 * std::cos(n * pi / 12), -20 * std::sin(n * pi / 12), 3);
  CurvedRecipe recipe = recipeOf(CurvedKind::stretched, points);
  recipe.ruled = ruledDirection(points, {1, 0, 0});
  QVERIFY(glm::distance(recipe.ruled, dvec3(0, 0, 1)) < 1e-9);
  const CurvedGrid grid = gridOf(recipe, boxOf());
  QVERIFY(std::abs(grid.length() / (20 * pi) - 1) < 2e-4);
  // The arc runs in front, from the patient's right to the left. Across is backwards, to the centre.
  for (int n = 0; n <= 20; ++n) {
    const double s = grid.length() * n / 20, angle = pi * n / 20;
    const dvec3 onArc(-20 * std::cos(angle), -20 * std::sin(angle), 3);
    QVERIFY(glm::distance(grid.patientFromCurved({s, 0, 0}), onArc) < 0.05);
    // Between two sections a position continues straight from the nearer one, by at most half of their 1 mm.
    // At 5 mm further out that is 5/20 too far. The arc itself is off by 0.02 mm.
    QVERIFY(glm::distance(grid.patientFromCurved({s, 5, 4}),
                          0.75 * dvec3(onArc.x, onArc.y, 0) + dvec3(0, 0, 7)) < 0.5 * 5 / 20 + 0.02);
  }
  // The surface is as high as the volume, whose box ends 32 mm above and below its middle.
  const VoxelGeometry& g = grid.geometry();
  QVERIFY(g.patientFromVoxel({0, 0, 0}).z >= -35 && g.patientFromVoxel({0, 0, 0}).z < -34 + 1e-6);
  QVERIFY(g.patientFromVoxel({0, g.size.y - 1, 0}).z <= 29 &&
          g.patientFromVoxel({0, g.size.y - 1, 0}).z > 28 - 1e-6);
}

// Curves may leave their plane. Each point of the curve lies on the ruling line at its arc length, and that
// length is returned.
void TestCurvedVolume::theFootOfTheCurveIsOnTheSurface() {
  const Seeds seeds = seedsOf(40, 400);
  int steep = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    CurvedRecipe recipe = recipeOf(CurvedKind::stretched, randomWalk(chance));
    recipe.ruled = ruledDirection(recipe.points, {0, 0, 1});
    const CurvedGrid grid = gridOf(recipe, boxOf());
    const SmoothCurve curve = *SmoothCurve::through(recipe.points);
    steep += grid.length() < curve.length() - 0.1;
    double before = -1, furthest = 0;
    for (const CurvedGrid::Section& section : grid.sections()) {
      QVERIFY(section.mm > before);
      before = section.mm;
      const dvec3 way = curve.at(section.mm) - section.at;
      furthest = std::max(furthest, glm::length(way - recipe.ruled * glm::dot(way, recipe.ruled)));
    }
    QVERIFY2(furthest < 1e-9, qPrintable(QString::number(seed)));
    QCOMPARE(grid.sections().front().mm, 0.0);
    QVERIFY(std::abs(before - curve.length()) < 1e-9);
    // x counts the arc length of the curve's projection along the ruling direction.
    double feet = 0;
    const int parts = 4000;
    const auto footAt = [&](int n) {
      const dvec3 p = curve.at(curve.length() * n / parts);
      return p - recipe.ruled * glm::dot(p, recipe.ruled);
    };
    for (int n = 1; n <= parts; ++n) feet += glm::distance(footAt(n - 1), footAt(n));
    QVERIFY2(std::abs(feet / grid.length() - 1) < 1e-4, qPrintable(QString::number(feet / grid.length())));
    for (std::size_t n = 0; n < grid.sections().size(); ++n) {
      const double x = grid.length() * double(n) / double(grid.sections().size() - 1);
      QVERIFY(std::abs(grid.alongCurve({x, 2, -3}) - grid.sections()[n].mm) < 1e-6);
    }
  }
  if (seeds.count >= 40) QVERIFY2(steep > 3, "some of them leave their plane");
}

// Positions are near the curve. Neighbouring cross-sections lean to each other by up to 0.19 mm there, so
// that either may be used.
void TestCurvedVolume::placesComeBack() {
  const CurvedGrid grid = gridOf(recipeOf(CurvedKind::straightened, helixPoints()), boxOf());
  const double sign = grid.geometry().patientFromVoxelStep[2].z < 0 ? -1 : 1;
  const Seeds seeds = seedsOf(200, 2000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const double x = chance.between(-3, 3), y = chance.between(-3, 3);
    const dvec3 p(x, y, sign * chance.between(2, grid.length() - 2));
    const dvec3 back = grid.curvedFromPatient(grid.patientFromCurved(p));
    QVERIFY2(glm::distance(back, p) < 0.3, qPrintable(QString::number(glm::distance(back, p))));
  }
}

void TestCurvedVolume::theBestPlaneGivesTheDirection_data() {
  QTest::addColumn<QList<QList<double>>>("points");
  QTest::addColumn<QList<double>>("direction");
  QTest::newRow("axial") << QList<QList<double>>{{-9, 0, 5}, {0, -7, 5}, {8, 1, 5}} << QList<double>{0, 0, 1};
  QTest::newRow("sagittal") << QList<QList<double>>{{2, 0, 5}, {2, -7, 9}, {2, 1, 0}}
                            << QList<double>{1, 0, 0};
  QTest::newRow("nearly axial") << QList<QList<double>>{{-9, 0, 5.001}, {0, -7, 5}, {8, 1, 4.999}, {9, 9, 5}}
                                << QList<double>{0, 0, 1};
  QTest::newRow("oblique") << QList<QList<double>>{{0, 0, 0}, {10, 0, 0}, {10, 6, 8}, {0, 3, 4}}
                           << QList<double>{0, -0.8, 0.6};
  QTest::newRow("a line across the view")
      << QList<QList<double>>{{0, 0, 0}, {5, 0, 0}} << QList<double>{0, 0.6, 0.8};
  QTest::newRow("three on a line along the view")
      << QList<QList<double>>{{0, 0, 0}, {0, 3, 4}, {0, 6, 8}} << QList<double>{0, 0, 0};
}

// For lines, the direction is as close to (0, 0.6, 0.8) as possible. If they run along it, any perpendicular
// direction is right.
void TestCurvedVolume::theBestPlaneGivesTheDirection() {
  QFETCH(QList<QList<double>>, points);
  QFETCH(QList<double>, direction);
  std::vector<dvec3> p;
  for (const QList<double>& x : points) p.emplace_back(x[0], x[1], x[2]);
  const dvec3 found = ruledDirection(p, {0, 0.6, 0.8}), wanted(direction[0], direction[1], direction[2]);
  QVERIFY(std::abs(glm::length(found) - 1) < 1e-9);
  if (wanted == dvec3(0))
    QVERIFY(std::abs(glm::dot(found, glm::normalize(p.back() - p.front()))) < 1e-9);
  else
    QVERIFY2(std::min(glm::distance(found, wanted), glm::distance(-found, wanted)) < 1e-3,
             qPrintable(QStringLiteral("%1 %2 %3").arg(found.x).arg(found.y).arg(found.z)));
}

VOLUMEN_TEST(TestCurvedVolume);
#include "tst_curved_volume.moc"
