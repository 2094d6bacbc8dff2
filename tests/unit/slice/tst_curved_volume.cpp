// Guards curved volumes: values are those of the patient points that the grid names, frames do not turn about
// the curve, closed forms of lines, helices and arcs hold, and what cannot be laid out is refused.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/grids.h"
#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/slice/curved_volume.h"

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
  void outsideIsPadding();
  void paddingIsNotInterpolated_data();
  void paddingIsNotInterpolated();
  void paddingBeyondFloat32IsTold();
  void largeOnesBecomeCoarser();
  void aTurnBackIsFinite();
  void whatCannotBeLaidOutIsRefused_data();
  void whatCannotBeLaidOutIsRefused();
  void whatIsCancelledIsAnError();
};

namespace {

constexpr double pi = std::numbers::pi;

CurvedRecipe recipeOf(CurvedKind kind, const std::vector<dvec3>& points, double halfWidth = 6) {
  return {kind, points, {0, 0, 1}, halfWidth};
}

CurvedGrid gridOf(const CurvedRecipe& recipe, const VoxelGeometry& source) {
  const auto grid = CurvedGrid::make(recipe, source);
  if (!grid) throw std::runtime_error(grid.message());
  return *grid;
}

VolumePtr laidOut(const Volume& source, const CurvedRecipe& recipe) {
  const auto volume = curvedVolume(source, recipe);
  if (!volume) throw std::runtime_error(volume.message());
  return *volume;
}

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

// How far a point lies from the helix, by its nearest angle, which lies close to that of its height.
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

// Bends of up to about 40 degrees every 10 to 20 mm.
std::vector<dvec3> randomWalk(Chance& chance) {
  std::vector<dvec3> points{{0, 0, 0}};
  dvec3 way = glm::normalize(chance.vector() + dvec3(0, 0, 2));
  for (int n = 2 + chance.below(5); n > 0; --n) {
    way = glm::normalize(way + 0.6 * chance.vector());
    points.push_back(points.back() + chance.between(10, 20) * way);
  }
  return points;
}

VoxelGeometry boxOf(double spacing = 1, int size = 64) {
  VoxelGeometry geometry;
  geometry.size = glm::ivec3(size);
  geometry.patientFromVoxelStep = glm::dmat3(spacing);
  geometry.origin = dvec3(-spacing * (size - 1) / 2);
  return geometry;
}

// The smallest turn that takes one unit vector to another.
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

// The same picture as of the slices themselves, whichever way the curve runs. Positions are rounded to 2^-24
// voxels, and neighbours differ by up to 2000.
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

// The bound: 0.1 mm for trilinear interpolation of a distance (1/8 mm^2 of a curvature of 1/2 per mm, twice),
// 0.02 mm for the curve through the points.
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

// Against the normal of Frenet's frame a frame that does not turn goes back by torsion times length.
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

// Against a twin that carries the first frame along by small turns, a fiftieth of a voxel each.
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

// Trilinear interpolation of a ramp is the ramp: what is left is float32 and 2^-24 voxels.
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

// Half a circle of radius 20 mm in an axial plane: the arc becomes a line of its length, its centre lies
// 20 mm across.
void TestCurvedVolume::anArcIsUnrolled() {
  std::vector<dvec3> points;
  for (int n = 0; n <= 12; ++n)
    points.emplace_back(-20 * std::cos(n * pi / 12), -20 * std::sin(n * pi / 12), 3);
  CurvedRecipe recipe = recipeOf(CurvedKind::stretched, points);
  recipe.ruled = ruledDirection(points, {1, 0, 0});
  QVERIFY(glm::distance(recipe.ruled, dvec3(0, 0, 1)) < 1e-9);
  const CurvedGrid grid = gridOf(recipe, boxOf());
  QVERIFY(std::abs(grid.length() / (20 * pi) - 1) < 2e-4);
  // From the patient's right to the left in front: across is backwards, to the centre.
  for (int n = 0; n <= 20; ++n) {
    const double s = grid.length() * n / 20, angle = pi * n / 20;
    const dvec3 onArc(-20 * std::cos(angle), -20 * std::sin(angle), 3);
    QVERIFY(glm::distance(grid.patientFromCurved({s, 0, 0}), onArc) < 0.05);
    // Between two sections a place goes straight on from the nearer one: by half of their 1 mm at most, which
    // is 5/20 too far where the arc is 5 mm further out; and 0.02 mm of the arc's own.
    QVERIFY(glm::distance(grid.patientFromCurved({s, 5, 4}),
                          0.75 * dvec3(onArc.x, onArc.y, 0) + dvec3(0, 0, 7)) < 0.5 * 5 / 20 + 0.02);
  }
  // As high as the volume: its box ends 32 mm above and below its middle.
  const VoxelGeometry& g = grid.geometry();
  QVERIFY(g.patientFromVoxel({0, 0, 0}).z >= -35 && g.patientFromVoxel({0, 0, 0}).z < -34 + 1e-6);
  QVERIFY(g.patientFromVoxel({0, g.size.y - 1, 0}).z <= 29 &&
          g.patientFromVoxel({0, g.size.y - 1, 0}).z > 28 - 1e-6);
}

// Of curves that leave their plane, too: every place of the curve lies on the line that the surface is ruled
// by at its arc length, and that length is told.
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
    // Its own arc length is what x counts.
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

// Near the curve. Between two cross-sections, which lean to each other by up to 0.19 mm there, it may be told
// by either.
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

// Of lines: as close to (0, 0.6, 0.8) as can be; where they run along it, at right angles.
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

void TestCurvedVolume::outsideIsPadding() {
  const VolumePtr source = randomVolume<std::int16_t>({12, 12, 12}, 100, 200);
  const CurvedRecipe recipe = recipeOf(CurvedKind::straightened, {{5, 5, 2}, {5, 5, 9}}, 20);
  const VolumePtr volume = laidOut(*source, recipe);
  const auto padding = volume->attributes().padding;
  QVERIFY(padding.has_value());
  QCOMPARE(double(volume->value(0, 0, 0)), padding->low);
  QVERIFY(padding->high < 100);
  QVERIFY(volume->value(20, 20, 3) >= 100);

  VolumeParts parts{source->geometry(), source->stored(), 1, 0, {}};
  parts.attributes.padding = ValueRange{-2000, -1990};
  const VolumePtr padded = laidOut(*volumeFrom(std::move(parts)), recipe);
  QVERIFY(padded->attributes().padding == (ValueRange{-2000, -1990}));
  QCOMPARE(padded->value(0, 0, 0), -2000.f);
}

// A row of voxels of padding beside some of 100 to 200, seen along a line between voxels: what padding has a
// part in is padding, whatever else is what interpolation gives of the voxels around.
void TestCurvedVolume::paddingIsNotInterpolated_data() {
  QTest::addColumn<double>("low");
  QTest::newRow("whole numbers") << -2000.0;
  QTest::newRow("float32 that is not what the file says") << -2000.3;
}

void TestCurvedVolume::paddingIsNotInterpolated() {
  QFETCH(double, low);
  const glm::ivec3 size(12, 12, 12);
  const auto isPadding = [](glm::ivec3 v) { return v.x < 4 || (v.x + v.y + v.z) % 11 == 0; };
  VolumeParts parts;
  parts.geometry = randomVolume<std::int16_t>(size, 100, 200)->geometry();
  std::vector<float> stored;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i)
        stored.push_back(isPadding({i, j, k}) ? float(low) : float(100 + (7 * i + j + k) % 100));
  if (low == std::round(low))
    parts.values = std::vector<std::int16_t>(stored.begin(), stored.end());
  else
    parts.values = std::move(stored);
  parts.attributes.padding = ValueRange{low, low};
  const VolumePtr source = volumeFrom(std::move(parts));
  int blank = 0, seen = 0;
  for (const double shift : {0.0, 0.3}) {
    const CurvedRecipe recipe = recipeOf(CurvedKind::straightened, {{5 + shift, 5, 2}, {5 + shift, 5, 9}}, 4);
    const CurvedGrid grid = gridOf(recipe, source->geometry());
    const VolumePtr volume = laidOut(*source, recipe);
    const ValueRange told = *volume->attributes().padding;
    QVERIFY(std::abs(told.low - low) < 1e-3 && std::abs(told.high - low) < 1e-3);
    for (int k = 0; k < volume->size().z; ++k)
      for (int j = 0; j < volume->size().y; ++j)
        for (int i = 0; i < volume->size().x; ++i) {
          const dvec3 p = grid.patientFromCurved(volume->geometry().patientFromVoxel({i, j, k}));
          const dvec3 x = source->geometry().voxelFromPatient(p);
          const glm::ivec3 from(glm::floor(x + 1e-6)), to(glm::ceil(x - 1e-6));
          if (glm::any(glm::lessThan(from, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(to, size)))
            continue;
          bool beside = false;
          for (int n = 0; n < 8; ++n)
            beside |= isPadding({n & 1 ? to.x : from.x, n & 2 ? to.y : from.y, n & 4 ? to.z : from.z});
          const float value = volume->value(i, j, k);
          ++(beside ? blank : seen);
          QVERIFY(beside ? value == float(low) : value > 100 - 1e-3f && value < 200);
        }
  }
  QVERIFY(blank > 100 && seen > 100);
}

// As a file may say it in doubles: what is written of it is told to be padding, too.
void TestCurvedVolume::paddingBeyondFloat32IsTold() {
  const VolumePtr plain = randomVolume<std::int16_t>({12, 12, 12}, 100, 200);
  for (const double low : {-2000.3, -2000.1}) {
    VolumeParts parts{plain->geometry(), plain->stored(), 1, 0, {}};
    parts.attributes.padding = ValueRange{low, low};
    const VolumePtr volume = laidOut(*volumeFrom(std::move(parts)),
                                     recipeOf(CurvedKind::straightened, {{5, 5, 2}, {5, 5, 9}}, 20));
    const double written = double(volume->value(0, 0, 0));
    const ValueRange padding = *volume->attributes().padding;
    QVERIFY(written != low && written >= padding.low && written <= padding.high);
    QVERIFY(low >= padding.low && low <= padding.high);
  }
}

void TestCurvedVolume::largeOnesBecomeCoarser() {
  const std::vector<dvec3> points{{0, 0, 0}, {100, 20, 0}, {200, 0, 0}};
  for (const CurvedKind kind : {CurvedKind::straightened, CurvedKind::stretched})
    for (const double spacing : {1.0, 0.1, 0.01}) {
      const CurvedGrid grid = gridOf(recipeOf(kind, points, 25), boxOf(spacing, 4000));
      const VoxelGeometry& g = grid.geometry();
      QVERIFY(double(g.voxelCount()) < 1.1 * CurvedGrid::mostVoxels);
      QVERIFY(g.spacing().x >= spacing - 1e-9);
      QVERIFY(std::abs(g.spacing().x / g.spacing().z - 1) < 0.01);
      if (spacing == 1) QVERIFY(std::abs(g.spacing().x - 1) < 1e-9);
    }
  // Thin ones, too: of a long curve there are no more cross-sections than can be held.
  const CurvedGrid thin =
      gridOf(recipeOf(CurvedKind::straightened, {{0, 0, 0}, {5000, 0, 0}}, 0.001), boxOf(0.001));
  QVERIFY(double(thin.sections().size()) < CurvedGrid::mostSections + 2);
}

void TestCurvedVolume::aTurnBackIsFinite() {
  for (const CurvedKind kind : {CurvedKind::straightened, CurvedKind::stretched}) {
    const CurvedGrid grid = gridOf(recipeOf(kind, {{0, 0, 0}, {10, 0, 0}, {2, 0, 0}}), boxOf());
    for (const CurvedGrid::Section& section : grid.sections()) {
      QVERIFY(std::abs(glm::length(section.right) - 1) < 1e-9);
      QVERIFY(glm::distance(glm::cross(section.right, section.down), section.along) < 1e-9);
    }
  }
}

void TestCurvedVolume::whatCannotBeLaidOutIsRefused_data() {
  QTest::addColumn<QList<double>>("zs");  // of points on a line
  QTest::addColumn<bool>("stretched");
  QTest::addColumn<double>("halfWidth");
  QTest::addColumn<double>("ruled");
  QTest::addColumn<bool>("calibrated");
  QTest::addColumn<QString>("says");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto row = [](const char* name, const QList<double>& zs, const char* says, bool stretched = false,
                      double halfWidth = 5, double ruled = 1, bool calibrated = true) {
    QTest::newRow(name) << zs << stretched << halfWidth << ruled << calibrated << QString::fromLatin1(says);
  };
  row("no point", {}, "two different places");
  row("no point, stretched", {}, "two different places", true);
  row("one point", {3}, "two different places");
  row("no number", {3, nan}, "1e9 mm");
  row("no number, stretched", {3, nan}, "1e9 mm", true);
  row("shorter than a voxel", {3, 3.5}, "shorter than a voxel");
  row("longer than a building", {-9000, 9000}, "longer than 10 m");
  row("more points than a hand sets", QList<double>(2001, 3), "2000 points");
  row("seen along its own line", {-9, 0, 9}, "two different places", true);
  row("no width", {3, 9}, "across", false, 0);
  row("a width that is no number", {3, 9}, "across", false, nan);
  row("no unit vector", {3, 9}, "unit vector", true, 5, 2);
  row("no millimetres", {3, 9}, "not calibrated", false, 5, 1, false);
  row("outside", {300, 309}, "outside");
}

void TestCurvedVolume::whatCannotBeLaidOutIsRefused() {
  QFETCH(QList<double>, zs);
  QFETCH(bool, stretched);
  QFETCH(double, halfWidth);
  QFETCH(double, ruled);
  QFETCH(bool, calibrated);
  QFETCH(QString, says);
  VolumeParts parts;
  parts.geometry = boxOf(1, 21);
  parts.geometry.calibrated = calibrated;
  parts.values = std::vector<float>(std::size_t(parts.geometry.voxelCount()), 1);
  CurvedRecipe recipe = recipeOf(stretched ? CurvedKind::stretched : CurvedKind::straightened, {}, halfWidth);
  recipe.ruled *= ruled;
  for (const double z : zs) recipe.points.emplace_back(0, 0, z);
  const auto volume = curvedVolume(*volumeFrom(std::move(parts)), recipe);
  QVERIFY(!volume);
  QVERIFY2(QString::fromStdString(volume.message()).contains(says), volume.message().c_str());
}

void TestCurvedVolume::whatIsCancelledIsAnError() {
  const VolumePtr source = randomVolume<std::int16_t>({12, 12, 12}, 100, 200);
  CancelToken cancel;
  std::size_t heard = 0;
  const auto volume = curvedVolume(
      *source, recipeOf(CurvedKind::straightened, {{5, 5, 2}, {5, 5, 9}}),
      [&](std::size_t done, std::size_t total) {
        heard = done;
        QCOMPARE(total, std::size_t(8));
        if (done == 3) cancel.cancel();
      },
      cancel);
  QVERIFY(!volume);
  QCOMPARE(heard, std::size_t(3));
}

VOLUMEN_TEST(TestCurvedVolume);
#include "tst_curved_volume.moc"
