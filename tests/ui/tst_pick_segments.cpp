// Guards picking of segments in 3D: their surfaces are those that picture.md 10 draws.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "ui/views/pick.h"
#include "viewer/reference/reference.h"
#include "viewer/segment/occupancy.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr int gridOfPlates = 40;  // voxels of 1 mm, centred on the origin
constexpr double offItsFace = 0.02;
// Slightly tilted, so that lengths along y are nearly its own and no step begins at a voxel face.
const SightLine sightAslant{{0.3, -500, 0.2}, glm::normalize(glm::dvec3(0.002, 1, 0.001))};

// Returns a volume of one value.
VolumePtr evenVolume() {
  static const VolumePtr volume =
      volumeOf<float>(glm::ivec3(gridOfPlates), glm::dmat3(1), [](glm::dvec3) { return 100.0; });
  return volume;
}

Scene fogOf(double opacity) {
  Scene scene;
  scene.transferFunction.points = {{0, {1, 1, 1}, opacity}};
  return scene;
}

// Returns a plate of the voxels from `low` to `high` along y. Thick plates have their surface half a voxel
// outside.
SegmentSurface plate(int low, int high, double opacity) {
  BitMask mask(evenVolume()->geometry());
  for (int k = 0; k < gridOfPlates; ++k)
    for (int j = low; j <= high; ++j)
      for (int i = 0; i < gridOfPlates; ++i) mask.set({i, j, k});
  return {std::make_shared<const OccupancyField>(occupancyOf(mask, surfaceSigma)), {1, 0, 0}, opacity};
}

double yOf(double voxel) { return voxel - (gridOfPlates - 1) / 2.0; }

std::optional<Pick> seenOf(const Scene& scene, bool parallel = true, const SightLine& line = sightAslant) {
  return pick(scene, *evenVolume(), line, parallel);
}

}  // namespace

class TestPickSegments : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theSurfaceInFrontIsSeen_data();
  void theSurfaceInFrontIsSeen();
  void whatIsCutOpenShowsItsInside_data();
  void whatIsCutOpenShowsItsInside();
  void anEyeInsideSeesTheOtherSide();
  void aProjectionSeesNone();
  void anEmptyClipBoxShowsNone();
  void fogAndPlatesAreTheirClosedForm_data();
  void fogAndPlatesAreTheirClosedForm();
  void whatTheReferenceDrawsIsPicked_data();
  void whatTheReferenceDrawsIsPicked();
};

using Plates = std::vector<SegmentSurface>;

void TestPickSegments::theSurfaceInFrontIsSeen_data() {
  QTest::addColumn<double>("fog");
  QTest::addColumn<Plates>("plates");
  QTest::addColumn<int>("segment");
  QTest::addColumn<double>("y");
  const auto row = [](const char* name, double fog, const Plates& plates, int segment, double y) {
    QTest::newRow(name) << fog << plates << segment << y;
  };
  row("opaque, alone", 0, {plate(10, 20, 1)}, 0, yOf(9.5));
  row("translucent, alone", 0, {plate(10, 20, 0.3)}, 0, yOf(9.5));
  row("at the border of the volume", 0, {plate(0, 9, 1)}, 0, yOf(-0.5));
  row("behind another", 0, {plate(20, 30, 1), plate(5, 12, 1)}, 1, yOf(4.5));
  row("behind a faint one", 0, {plate(5, 12, 0.1), plate(20, 30, 1)}, 1, yOf(19.5));
  row("touching: the one that is entered", 0, {plate(5, 12, 0.01), plate(13, 20, 0.9)}, 1, yOf(12.5));
  row("behind thin fog", 0.01, {plate(10, 20, 1)}, 0, yOf(9.5));
  row("in a solid", 1, {plate(10, 20, 1)}, -1, yOf(-0.5));
  row("wholly transparent", 0, {plate(10, 20, 0), plate(25, 35, 1)}, 1, yOf(24.5));
}

void TestPickSegments::theSurfaceInFrontIsSeen() {
  QFETCH(Plates, plates);
  QFETCH(double, fog);
  QFETCH(int, segment);
  QFETCH(double, y);
  Scene scene = fogOf(fog);
  scene.segments = plates;
  const auto hit = seenOf(scene);
  QVERIFY(hit && hit->pPatient);
  QCOMPARE(hit->segment ? int(*hit->segment) : -1, segment);
  QVERIFY2(std::abs(hit->pPatient->y - y) < 0.1, qPrintable(QString::number(hit->pPatient->y)));
  QCOMPARE(hit->value, 100.0);
  scene.segments.clear();
  QCOMPARE(seenOf(scene).has_value(), fog > 0);
}

void TestPickSegments::whatIsCutOpenShowsItsInside_data() {
  QTest::addColumn<Clip>("clip");
  Clip plane;
  plane.planes = {{{0, -1, 0}, -yOf(15)}};  // keeps the part behind voxel 15
  QTest::newRow("a plane") << plane;
  Clip box;
  box.boxLow.y = 15.5 / gridOfPlates;
  QTest::newRow("a side of the box") << box;
}

void TestPickSegments::whatIsCutOpenShowsItsInside() {
  QFETCH(Clip, clip);
  Scene scene = fogOf(0);
  scene.segments = {plate(10, 20, 1)};
  scene.clip = clip;
  auto hit = seenOf(scene);
  QVERIFY(hit && hit->segment);
  QVERIFY(std::abs(hit->pPatient->y - yOf(20.5)) < offItsFace);
  scene.segments = {plate(2, 12, 1)};
  QVERIFY2(!seenOf(scene), "all of it is cut away");
  scene.segments = {plate(30, 39, 1)};
  hit = seenOf(scene);
  QVERIFY(hit && std::abs(hit->pPatient->y - yOf(29.5)) < offItsFace);
}

void TestPickSegments::anEyeInsideSeesTheOtherSide() {
  Scene scene = fogOf(0);
  scene.segments = {plate(10, 20, 1)};
  const auto hit = seenOf(scene, false, {{0, yOf(15), 0}, {0, 1, 0}});
  QVERIFY(hit && hit->segment && std::abs(hit->pPatient->y - yOf(20.5)) < offItsFace);
  QVERIFY(!seenOf(scene, false, {{0, yOf(25), 0}, {0, 1, 0}}));
}

void TestPickSegments::aProjectionSeesNone() {
  Scene scene = fogOf(0);
  scene.segments = {plate(10, 20, 1)};
  for (const Mode mode : {Mode::mip, Mode::minip, Mode::average}) {
    scene.mode = mode;
    const auto hit = seenOf(scene);
    QVERIFY(hit && !hit->segment);
  }
}

// This also holds at the volume's border, beyond which surfaces continue.
void TestPickSegments::anEmptyClipBoxShowsNone() {
  Scene scene = fogOf(0.5);
  scene.segments = {plate(0, gridOfPlates - 1, 1)};
  for (const double at : {0.0, 0.5, 1.0})
    for (int axis = 0; axis < 3; ++axis) {
      scene.clip = {};
      scene.clip.boxLow[axis] = scene.clip.boxHigh[axis] = at;
      QVERIFY(!seenOf(scene));
      QVERIFY(!seenOf(scene, false, {{0, yOf(15), 0}, {0, 1, 0}}));
    }
}

void TestPickSegments::fogAndPlatesAreTheirClosedForm_data() {
  QTest::addColumn<int>("seed");
  const Seeds seeds = seedsOf(200, 5000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) QTest::addRow("seed %d", seed) << seed;
}

// Uniform fog with separate plates. Each plate absorbs a share of the light whenever its surface is met.
void TestPickSegments::fogAndPlatesAreTheirClosedForm() {
  QFETCH(int, seed);
  Chance chance{std::uint64_t(seed)};
  const double fog = chance.oneIn(3) ? 0 : chance.below(300) / 1000.0, mu = -std::log1p(-fog);
  Scene scene = fogOf(fog);
  struct Surface {
    double y, depth;
    int segment;
  };
  std::vector<Surface> surfaces;
  for (int at = chance.below(8); at + 6 < gridOfPlates; at += 3 + chance.below(8)) {
    const int high = std::min(gridOfPlates - 1, at + 5 + chance.below(6));
    const double opacity = 0.02 + chance.below(95) / 100.0;
    scene.segments.push_back(plate(at, high, opacity));
    for (const double face : {at - 0.5, high + 0.5})
      surfaces.push_back({yOf(face), -std::log1p(-opacity), int(scene.segments.size()) - 1});
    at = high;
  }
  double whole = mu * gridOfPlates;
  for (const Surface& s : surfaces) whole += s.depth;
  const double final = -std::expm1(-whole);
  if (final < 0.051) return;
  double left = -std::log1p(-final / 2), y = yOf(-0.5);
  int segment = -1;
  bool isClose = false;  // to the depth at which another one would be seen
  for (const Surface& s : surfaces) {
    const double before = mu * (s.y - y);
    isClose = isClose || std::abs(left - before) < 1e-2 || std::abs(left - before - s.depth) < 1e-2;
    if (left <= before) break;
    left -= before;
    y = s.y;
    if (left <= s.depth) {
      segment = s.segment;
      left = 0;
      break;
    }
    left -= s.depth;
  }
  if (isClose) return;
  if (segment < 0) y += left / mu;
  const auto hit = seenOf(scene);
  QVERIFY(hit && hit->pPatient);
  QCOMPARE(hit->segment ? int(*hit->segment) : -1, segment);
  QVERIFY2(std::abs(hit->pPatient->y - y) < offItsFace,
           qPrintable(QStringLiteral("%1, not %2").arg(hit->pPatient->y).arg(y)));
}

void TestPickSegments::whatTheReferenceDrawsIsPicked_data() {
  QTest::addColumn<int>("seed");
  const Seeds seeds = seedsOf(25, 1000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) QTest::addRow("seed %d", seed) << seed;
}

// Opaque balls and boxes without common voxels, each in an unlit colour. Grid, clipping and view are random.
// Pixels near colour borders are left out.
void TestPickSegments::whatTheReferenceDrawsIsPicked() {
  QFETCH(int, seed);
  Chance chance{std::uint64_t(seed)};
  const glm::dmat3 axes(chance.between(0.5, 2), 0, chance.between(0, 0.3), chance.between(0, 0.3),
                        chance.between(0.5, 2), 0, 0, 0, chance.between(0.5, 2));
  const VolumePtr volume = volumeOf<float>({24, 24, 24}, axes, [](glm::dvec3) { return 0.0; });
  constexpr glm::dvec3 colours[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<BitMask> masks(std::size(colours), BitMask(volume->geometry()));
  std::vector<glm::dvec3> middles;
  for (std::size_t n = 0; n < masks.size(); ++n)
    middles.emplace_back(chance.below(24), chance.below(24), chance.below(24));
  const double radius = chance.between(4, 9);
  const bool areBoxes = chance.oneIn(2);
  for (int k = 0; k < 24; ++k)
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 24; ++i)
        for (std::size_t n = 0; n < masks.size(); ++n) {
          const glm::dvec3 by = glm::abs(glm::dvec3(i, j, k) - middles[n]);
          const double far = areBoxes ? std::max({by.x, by.y, by.z}) : glm::length(by);
          if (far > radius) continue;
          masks[n].set({i, j, k});
          break;
        }
  Scene scene = fogOf(0);
  scene.shading.lit = false;
  scene.shading.gradientFloor = 1;
  scene.window = Window{0, 1};
  for (std::size_t n = 0; n < masks.size(); ++n)
    scene.segments.push_back(
        {std::make_shared<const OccupancyField>(occupancyOf(masks[n], surfaceSigma)), colours[n], 1});
  for (int a = 0; a < 3; ++a)
    if (chance.oneIn(3)) scene.clip.boxLow[a] = chance.between(0.1, 0.4);
  if (chance.oneIn(2))
    scene.clip.planes = {
        {{chance.between(-1, 1), chance.between(-1, 1), chance.between(0.1, 1)}, chance.between(-5, 5)}};
  Camera camera;
  camera.direction = {chance.between(-1, 1), chance.between(0.2, 1), chance.between(-1, 1)};
  camera.projection = chance.oneIn(2) ? Projection::parallel : Projection::perspective;
  scene.camera = fitCamera(camera, volume->geometry(), 1);
  if (chance.oneIn(4)) scene.camera->distance *= 0.3;  // an eye between the objects
  constexpr int size = 24;
  const auto drawn = renderReference(scene, *volume, {size, size});
  QVERIFY(drawn);
  const auto colourAt = [&](int x, int y) {
    const float* p = drawn->row(y) + 4 * x;
    return glm::dvec3(p[0], p[1], p[2]);
  };
  int looked = 0;
  for (int y = 1; y + 1 < size; ++y)
    for (int x = 1; x + 1 < size; ++x) {
      const glm::dvec3 colour = colourAt(x, y);
      bool isEven = true;
      for (int n = 0; n < 9; ++n)
        isEven = isEven && glm::distance(colour, colourAt(x + n % 3 - 1, y + n / 3 - 1)) < 0.01;
      if (!isEven) continue;
      ++looked;
      const SightLine line = sightLine(*scene.camera, glm::dvec2(size), {x + 0.5, y + 0.5});
      const auto hit = pick(scene, *volume, line, scene.camera->projection == Projection::parallel);
      const glm::dvec3 picked = hit && hit->segment ? colours[*hit->segment] : glm::dvec3(0);
      QVERIFY2(glm::distance(picked, colour) < 0.01, qPrintable(QStringLiteral("at %1, %2").arg(x).arg(y)));
    }
  QVERIFY(looked > 0);
}

VOLUMEN_TEST(TestPickSegments);
#include "tst_pick_segments.moc"
