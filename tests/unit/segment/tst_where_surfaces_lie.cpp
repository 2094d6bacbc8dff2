// Guards segment.md, "See segments in 3D", for phantoms and real segments on every kind of grid. Written
// surfaces are closed, lie at most half a voxel from the border of the voxels, and enclose what pictures
// draw. Random masks: VOLUMEN_RANDOM_CASES=N, VOLUMEN_RANDOM_SEED=S.
#include <cmath>

#include "tests/fixtures/grids.h"
#include "tests/fixtures/real_volume.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/segment/drawn_volume.h"
#include "tests/unit/segment/field_masks.h"
#include "tests/unit/segment/shape_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/range.h"
#include "viewer/segment/surface_mended.h"

using namespace volumen;
using namespace volumen::tests;

class TestWhereSurfacesLie : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void phantoms_data();
  void phantoms();
  void anyMask();
  void realSegments_data();
  void realSegments();
  void fewTrianglesAreThin_data();
  void fewTrianglesAreThin();
};

namespace {

using glm::dmat3, glm::dvec3, glm::ivec3;

constexpr double halfAVoxel = 0.5, roundedPoints = 1e-3;  // allows for floats of mm, in voxels
// Bounds of the enclosed volume relative to the drawn one. The drawn volume is counted at random points,
// which is off by about 0.3 % for a few hundred cells.
constexpr double ofSmallBodies = 0.01, ofRealSegments = 0.005;

// Returns the distance (voxels) from a point to the border of the voxels inside the point's cell.
double fromBorder(const BitMask& mask, dvec3 p) {
  const auto isIn = [&](ivec3 v) {
    for (int a = 0; a < 3; ++a)
      if (v[a] < 0 || v[a] >= mask.size()[a]) return false;
    return mask.at(v);
  };
  const ivec3 cell(glm::floor(p));
  double nearest = HUGE_VAL;
  for (int corner = 0; corner < 8; ++corner)
    for (int axis = 0; axis < 3; ++axis) {
      if (corner >> axis & 1) continue;
      const ivec3 v = cell + ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
      ivec3 next = v;
      next[axis] += 1;
      if (isIn(v) == isIn(next)) continue;
      // The face between both is a square of edge 1 about the midpoint.
      const dvec3 away = glm::abs(p - dvec3(v + next) / 2.0);
      dvec3 beyond = glm::max(away - 0.5, 0.0);
      beyond[axis] = away[axis];
      nearest = std::min(nearest, glm::length(beyond));
    }
  return nearest;
}

// Returns the largest distance of corners, edges and insides of all triangles, in voxels.
double farthestFromBorder(const Surface& surface, const BitMask& mask) {
  constexpr int parts = 3;
  double farthest = 0;
  for (const auto& t : surface.triangles)
    for (int a = 0; a <= parts; ++a)
      for (int b = 0; a + b <= parts; ++b) {
        const dvec3 share = dvec3(a, b, parts - a - b) / double(parts);
        dvec3 p(0);
        for (int n = 0; n < 3; ++n) p += share[n] * dvec3(surface.points[t[std::size_t(n)]]);
        farthest = std::max(farthest, fromBorder(mask, mask.geometry().voxelFromPatient(p)));
      }
  return farthest;
}

// Returns what is wrong with the surface; empty if nothing is. `off` bounds the relative difference of the
// enclosed from the drawn volume.
QString wrongSurface(const BitMask& mask, double off) {
  const OccupancyField field = occupancyOf(mask, surfaceSigma);
  const Surface surface = mended(*volumePreservingSurface(field), field);
  if (const std::string wrong = notClosed(surface); !wrong.empty()) return QString::fromStdString(wrong);
  const double farthest = farthestFromBorder(surface, mask);
  if (!(farthest < halfAVoxel + roundedPoints))
    return QStringLiteral("%1 voxels from the border").arg(farthest);
  const double ratio = volumeOf(surface) / drawnVolume(field);
  return std::abs(ratio - 1) <= off ? QString() : QStringLiteral("%1 of what is drawn").arg(ratio);
}

// Returns the first percentile of triangle quality.
double firstPercentile(const Surface& surface) {
  std::vector<double> qualities;
  for (const auto& [a, b, c] : surface.triangles) {
    const dvec3 p(surface.points[a]), q(surface.points[b]), r(surface.points[c]);
    const double squares = glm::dot(q - p, q - p) + glm::dot(r - q, r - q) + glm::dot(p - r, p - r);
    qualities.push_back(2 * std::sqrt(3.0) * glm::length(glm::cross(q - p, r - p)) / squares);
  }
  std::ranges::sort(qualities);
  return qualities[qualities.size() / 100];
}

}  // namespace

void TestWhereSurfacesLie::phantoms_data() {
  QTest::addColumn<dmat3>("step");
  QTest::addColumn<Shape3>("shape");
  QTest::addColumn<bool>("isCut");
  const Shape3 outer = ball(14), inner = ball(11);
  const std::pair<const char*, Shape3> shapes[] = {
      {"ball", ball(10)},
      {"tilted cylinder", cylinder(9, 30, {1, 2, 3})},
      {"long ellipsoid", ellipsoid({24, 8, 6})},
      {"hollow ball", [=](dvec3 p) { return outer(p) && !inner(p); }},
      {"two balls that touch",
       [=, left = ball(6, {-6, 1, 0}), right = ball(6, {6, 0, 1})](dvec3 p) { return left(p) || right(p); }},
  };
  const auto rows = [&](const Grid& grid) {
    for (const auto& [name, shape] : shapes)
      for (const bool isCut : {false, true})
        QTest::addRow("%s, %s%s", name, grid.name, isCut ? ", to the end of the grid" : "")
            << grid.patientFromVoxelStep << shape << isCut;
  };
  for (const Grid& grid : grids) rows(grid);
  for (const Grid& grid : thickGrids) rows(grid);  // bodies of two to six slices
}

// The grid ends in the middle of the body, or encloses it.
void TestWhereSurfacesLie::phantoms() {
  QFETCH(dmat3, step);
  QFETCH(Shape3, shape);
  QFETCH(bool, isCut);
  VoxelGeometry grid = gridAbout(step, 26);
  if (isCut) grid.size -= grid.size / 2;
  const BitMask mask = maskOfShape(grid, shape);
  QVERIFY(mask.count() > 30);
  const QString wrong = wrongSurface(mask, ofSmallBodies);
  QVERIFY2(wrong.isEmpty(), qPrintable(wrong));
}

// In noise the surface separates what the field joins across faces, so that the volume is not checked.
void TestWhereSurfacesLie::anyMask() {
  const Seeds seeds = seedsOf(100, 2000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    VoxelGeometry grid = anyGrid(chance, 9);
    if (chance.oneIn(4)) grid.patientFromVoxelStep = thickGrids[chance.below(2)].patientFromVoxelStep;
    grid.origin = 300.0 * chance.vector();
    const BitMask mask = tests::anyMask(chance, grid);
    if (mask.empty()) continue;
    const QString wrong = wrongSurface(mask, HUGE_VAL);
    QVERIFY2(wrong.isEmpty(), qPrintable(QStringLiteral("seed %1: %2").arg(seed).arg(wrong)));
  }
}

void TestWhereSurfacesLie::realSegments_data() {
  QTest::addColumn<QString>("series");
  QTest::addColumn<double>("low");
  QTest::addColumn<double>("high");
  const auto row = [](const char* name, const char* series, double low, double high) {
    QTest::newRow(name) << QString::fromLatin1(series) << low << high;
  };
  row("bone of a chest", "ct-chest-lidc0314-138", 226, 3000);
  row("air of a chest", "ct-chest-lidc0314-138", -2000, -500);
  row("bone of a head in thick, tilted slices", "dicom-geometry/ct-ge-tilt-varspacing-28", 226, 3000);
  row("a PET from SUV 2.5 on", "pet-ct/sts019-pet", 2.5, 1e9);
  row("a head by MR", "mr-head-siemens-gap-175", 200, 1e9);
}

// Only seven slices each, as testing every edge is slow.
void TestWhereSurfacesLie::realSegments() {
  QFETCH(QString, series);
  QFETCH(double, low);
  QFETCH(double, high);
  const VolumePtr volume = realVolume(series.toStdString());
  NEED_VOLUME(volume);
  BitMask mask = voxelsInRange(*volume, {low, high});
  const int middle = mask.size().z / 2;
  for (int k = 0; k < mask.size().z; ++k)
    for (int j = 0; j < mask.size().y && std::abs(k - middle) > 3; ++j) std::ranges::fill(mask.row(j, k), 0);
  QVERIFY(mask.count() > 300);
  const QString wrong = wrongSurface(mask, ofRealSegments);
  QVERIFY2(wrong.isEmpty(), qPrintable(wrong));
}

void TestWhereSurfacesLie::fewTrianglesAreThin_data() {
  QTest::addColumn<dmat3>("step");
  QTest::addColumn<Shape3>("shape");
  QTest::newRow("tilted cylinder") << dmat3(1) << cylinder(9, 30, {1, 2, 3});
  QTest::newRow("ellipsoid, oblique") << grids[2].patientFromVoxelStep << ellipsoid({20, 14, 12});
}

// Quality is 4 sqrt(3) area / sum of squared edges, which is 1 for equal edges. Before mending, 1 % of the
// triangles have 0.2 or less.
void TestWhereSurfacesLie::fewTrianglesAreThin() {
  QFETCH(dmat3, step);
  QFETCH(Shape3, shape);
  const OccupancyField field = occupancyOf(maskOfShape(gridAbout(step, 26), shape), surfaceSigma);
  const Surface before = *volumePreservingSurface(field), surface = mended(before, field);
  QVERIFY(surface.triangles == before.triangles);
  QVERIFY2(firstPercentile(surface) > 0.44, qPrintable(QString::number(firstPercentile(surface))));
  QVERIFY(firstPercentile(before) < 0.35);
  QVERIFY(std::abs(volumeOf(surface) / volumeOf(before) - 1) < 1e-5);
}

VOLUMEN_TEST(TestWhereSurfacesLie);
#include "tst_where_surfaces_lie.moc"
