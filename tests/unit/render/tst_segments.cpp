// Guards picture.md 10 by closed forms: the surface lies where the field is 1/2, is lit like the volume, and
// covers what is behind it. Covers the reference and planes.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "tests/unit/render/reference_fixture.h"
#include "tests/unit/suite.h"
#include "viewer/render/render.h"
#include "viewer/segment/occupancy.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegments : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aTranslucentPlateCutsTheRay_data() { addWays(); }
  void aTranslucentPlateCutsTheRay();
  void whatIsOpaqueHidesTheRest_data() { addWays(); }
  void whatIsOpaqueHidesTheRest();
  void aBallIsAsLargeAndLitAsTold_data();
  void aBallIsAsLargeAndLitAsTold();
  void aTiltedPlaneIsLitByItsNormal_data();
  void aTiltedPlaneIsLitByItsNormal();
  void whatIsCutOpenShowsItsInside_data() { addWays(); }
  void whatIsCutOpenShowsItsInside();
  void theBorderOfTheVolumeClosesIt_data() { addWays(); }
  void theBorderOfTheVolumeClosesIt();
  void whereTwoTouchTheEnteredComesFirst_data() { addWays(); }
  void whereTwoTouchTheEnteredComesFirst();
  void anEmptyClipBoxShowsNone_data() { addWays(); }
  void anEmptyClipBoxShowsNone();
  void otherMethodsAndProjectionsShowNone_data();
  void otherMethodsAndProjectionsShowNone();
  void onlyNewFieldsAreLookedInto();

 private:
  static void addWays() {
    QTest::addColumn<bool>("byReference");
    QTest::newRow("reference") << true;
    QTest::newRow("planes") << false;
  }
};

namespace {

// Bound of the fast path against closed forms: half of what `exact` promises.
constexpr double exactBound = 0.5 / 255;
double boundOf(bool byReference) { return byReference ? referenceBound : exactBound; }

Picture pictureBy(bool byReference, const Scene& scene, const VolumePtr& volume, glm::ivec2 size) {
  RenderOptions options;
  options.size = size;
  options.method = byReference ? Method::reference : Method::planes;
  options.quality = Quality::exact;
  RenderCaches caches(volume);
  return render(*makePlan(scene, caches.facts(), options), caches)->picture;
}
glm::dvec4 pixelBy(bool byReference, const Scene& scene, const VolumePtr& volume) {
  const Picture picture = pictureBy(byReference, scene, volume, {1, 1});
  return {picture.rgba[0], picture.rgba[1], picture.rgba[2], picture.rgba[3]};
}

/// Returns a field that is a profile along i, with `values` from voxel `first` on.
std::shared_ptr<const OccupancyField> profileAlongI(const VoxelGeometry& geometry, int first,
                                                    const std::vector<float>& values) {
  const int last = first + int(values.size()) - 1;
  OccupancyField field{geometry, {{first, -2, -2}, {last, geometry.size.y + 1, geometry.size.z + 1}}, {}};
  for (int n = 0; n < field.size().y * field.size().z; ++n)
    field.values.insert(field.values.end(), values.begin(), values.end());
  return std::make_shared<const OccupancyField>(std::move(field));
}

std::shared_ptr<const OccupancyField> fieldWhere(const VoxelGeometry& geometry, auto holds) {
  BitMask mask(geometry);
  for (int k = 0; k < geometry.size.z; ++k)
    for (int j = 0; j < geometry.size.y; ++j)
      for (int i = 0; i < geometry.size.x; ++i)
        if (holds(geometry.patientFromVoxel({i, j, k}))) mask.set({i, j, k});
  return std::make_shared<const OccupancyField>(occupancyOf(mask, surfaceSigma));
}

const glm::dvec3 redPaint(0.9, 0.2, 0.1), greenPaint(0.1, 0.8, 0.3);

#define COMPARE_PIXEL(actual, expected, bound)                                        \
  do {                                                                                \
    const glm::dvec4 drawnPixel = (actual), wantedPixel = (expected);                 \
    for (int c = 0; c < 4; ++c) COMPARE_WITHIN(drawnPixel[c], wantedPixel[c], bound); \
  } while (false)

}  // namespace

// Homogeneous matter lies from -5 to 5 mm. The plate's surfaces are at -1 and 1 mm.
void TestSegments::aTranslucentPlateCutsTheRay() {
  QFETCH(bool, byReference);
  const auto matter = homogeneous(gridAround({10, 5, 5}));
  Scene scene = plainScene(0.2);
  const double opacity = 0.4, mu = extinction(0.2);
  scene.segments = {
      {profileAlongI(matter->geometry(), 2, {0, 0.25f, 0.75f, 0.75f, 0.25f, 0}), redPaint, opacity}};
  // Voxel i lies at i - 4.5 mm.
  const double before = std::exp(-4 * mu), within = std::exp(-2 * mu), through = 1 - opacity;
  const glm::dvec3 white(1, 0.5, 0.25);
  const glm::dvec3 colour =
      white * (1 - before) +
      before *
          (opacity * redPaint +
           through * (white * (1 - within) + within * (opacity * redPaint + through * white * (1 - before))));
  const double alpha = 1 - before * before * within * through * through;
  COMPARE_PIXEL(pixelBy(byReference, scene, matter), glm::dvec4(colour, alpha), boundOf(byReference));
}

void TestSegments::whatIsOpaqueHidesTheRest() {
  QFETCH(bool, byReference);
  const auto matter = homogeneous(gridAround({10, 5, 5}));
  Scene scene = plainScene(0.2);
  const auto wall = profileAlongI(matter->geometry(), 6, {0, 1, 1, 0});  // at 2 mm
  scene.segments = {{profileAlongI(matter->geometry(), 0, {0, 1, 0}), greenPaint, 0}, {wall, redPaint, 1}};
  const double before = std::exp(-7 * extinction(0.2));
  const glm::dvec3 colour = glm::dvec3(1, 0.5, 0.25) * (1 - before) + before * redPaint;
  COMPARE_PIXEL(pixelBy(byReference, scene, matter), glm::dvec4(colour, 1), boundOf(byReference));
}

void TestSegments::aBallIsAsLargeAndLitAsTold_data() {
  QTest::addColumn<bool>("byReference");
  QTest::addColumn<glm::dmat3>("steps");
  QTest::addColumn<bool>("perspective");
  for (bool byReference : {true, false})
    for (bool perspective : {false, true}) {
      const char* how = perspective ? "perspective" : "parallel";
      const char* by = byReference ? "reference" : "planes";
      QTest::addRow("even, %s, %s", how, by) << byReference << glm::dmat3(1) << perspective;
      QTest::addRow("sheared, left-handed, %s, %s", how, by)
          << byReference << glm::dmat3({0, 0.9, 0}, {0.8, 0, 0}, {0.3, 0.2, 1.2}) << perspective;
    }
}

void TestSegments::aBallIsAsLargeAndLitAsTold() {
  QFETCH(bool, byReference);
  QFETCH(glm::dmat3, steps);
  QFETCH(bool, perspective);
  const double radius = 12;
  const auto air = homogeneous(gridAround({41, 43, 37}, steps));
  Scene scene = plainScene(0);
  scene.shading = {};
  scene.shading.ambient = 0.1;
  scene.shading.specular = 0;
  scene.segments = {{fieldWhere(air->geometry(), [=](glm::dvec3 p) { return glm::length(p) <= radius; }),
                     glm::dvec3(1), 1}};
  scene.camera->height = 30;
  scene.camera->projection = perspective ? Projection::perspective : Projection::parallel;
  scene.camera->distance = 50;
  scene.camera->fov = 2 * glm::degrees(std::atan(15.0 / 50));
  const int n = 64;
  const Picture picture = pictureBy(byReference, scene, air, {n, n});
  // In perspective a ball covers the sine of its cone, not the tangent.
  const double seenRadius = perspective ? 50 * std::tan(std::asin(radius / 50)) : radius;
  double area = 0, light = 0;
  for (int pixel = 0; pixel < n * n; ++pixel) {
    area += double(picture.rgba[std::size_t(4 * pixel + 3)]);
    light += double(picture.rgba[std::size_t(4 * pixel)]);
  }
  const double mm2 = 30.0 / n * 30.0 / n;
  COMPARE_WITHIN(area * mm2, glm::pi<double>() * seenRadius * seenRadius, 0.03 * area * mm2);
  if (perspective) return;
  // A Lambertian ball under a headlight reflects 2/3 of the diffuse light of its disc, plus the ambient
  // light.
  COMPARE_WITHIN(light / area, 0.1 + 0.7 * 2 / 3, 0.01);
}

void TestSegments::aTiltedPlaneIsLitByItsNormal_data() {
  QTest::addColumn<bool>("byReference");
  QTest::addColumn<bool>("localViewer");
  QTest::addColumn<bool>("fromBehind");
  for (bool byReference : {true, false})
    for (bool localViewer : {false, true})
      for (bool fromBehind : {false, true})
        QTest::addRow("%s%s, by %s", fromBehind ? "from behind" : "from the front",
                      localViewer ? ", local viewer" : "", byReference ? "reference" : "planes")
            << byReference << localViewer << fromBehind;
}

// A ramp of 0.1 a voxel along i on an oblique grid has one normal everywhere.
void TestSegments::aTiltedPlaneIsLitByItsNormal() {
  QFETCH(bool, byReference);
  QFETCH(bool, localViewer);
  QFETCH(bool, fromBehind);
  const auto air = homogeneous(gridAround({11, 9, 9}, {{0.8, 0.6, 0}, {-0.6, 0.8, 0}, {0.2, 0.1, 1.5}}));
  const glm::dvec3 outwards =
      -glm::normalize(air->geometry().patientFromVoxelGradient() * glm::dvec3(1, 0, 0));
  const glm::dvec3 along = fromBehind ? glm::dvec3(-0.9, -0.3, 0.2) : glm::dvec3(0.9, 0.3, -0.2);
  Scene scene = plainScene(0, along);
  scene.shading = {true, 2, localViewer, {}, 0.2, 0.6, 0.5, 9};
  scene.lights = {
      {glm::dvec3(-0.5, fromBehind ? 2 : -1, 0.3), Space::patient, glm::dvec3(1, 0.8, 0.5), 0.7, true}};
  std::vector<float> ramp;
  for (int n = 0; n <= 10; ++n) ramp.push_back(0.1f * float(n));
  scene.segments = {{profileAlongI(air->geometry(), 0, ramp), redPaint, 1}};
  const glm::dvec3 viewer = -glm::normalize(along), light = glm::normalize(scene.lights[0].direction);
  const glm::dvec3 halfway = glm::normalize(viewer + light), normal = fromBehind ? -outwards : outwards;
  const double nl = std::max(0.0, glm::dot(normal, light)), nh = std::max(0.0, glm::dot(normal, halfway));
  QVERIFY(glm::dot(normal, viewer) > 0.1);  // far enough from edge-on that only one side counts
  const glm::dvec3 radiance = 0.7 * scene.lights[0].colour;
  const glm::dvec3 colour =
      redPaint * (0.2 + 0.6 * radiance * nl) + 0.5 * radiance * std::min(1.0, 10 * nl) * std::pow(nh, 9.0);
  COMPARE_PIXEL(pixelBy(byReference, scene, air), glm::dvec4(colour, 1), boundOf(byReference));
}

// The clip plane lies within the plate. Only its far surface is visible, from inside.
void TestSegments::whatIsCutOpenShowsItsInside() {
  QFETCH(bool, byReference);
  const auto air = homogeneous(gridAround({10, 5, 5}));
  Scene scene = plainScene(0);
  scene.segments = {{profileAlongI(air->geometry(), 2, {0, 1, 1, 1, 1, 0}), redPaint, 0.3}};
  for (const bool byBox : {false, true}) {
    scene.clip = {};
    if (byBox)
      scene.clip.boxLow.x = 0.5;
    else
      scene.clip.planes = {{{-1, 0, 0}, 0}};
    COMPARE_PIXEL(pixelBy(byReference, scene, air), glm::dvec4(0.3 * redPaint, 0.3), boundOf(byReference));
  }
}

// All voxels are inside. The surface lies about half a voxel beyond them, even outside the box.
void TestSegments::theBorderOfTheVolumeClosesIt() {
  QFETCH(bool, byReference);
  const auto air = homogeneous(gridAround({6, 5, 7}));
  const auto all = fieldWhere(air->geometry(), [](glm::dvec3) { return true; });
  for (const glm::dvec3 along : {glm::dvec3(1, 0, 0), glm::dvec3(0.3, -1, 0.2), glm::dvec3(0, 0, -1)}) {
    Scene scene = plainScene(0, along);
    scene.segments = {{all, redPaint, 0.5}};
    COMPARE_PIXEL(pixelBy(byReference, scene, air), glm::dvec4(0.75 * redPaint, 0.75), boundOf(byReference));
    scene.camera->target = along * 1e-9;  // places the eye inside
    scene.camera->projection = Projection::perspective;
    scene.camera->distance = 1;
    COMPARE_PIXEL(pixelBy(byReference, scene, air), glm::dvec4(0.5 * redPaint, 0.5), boundOf(byReference));
  }
}

// Both surfaces lie at 0 mm. The opaque one hides the back of the other.
void TestSegments::whereTwoTouchTheEnteredComesFirst() {
  QFETCH(bool, byReference);
  const auto air = homogeneous(gridAround({10, 5, 5}));
  const auto front = profileAlongI(air->geometry(), 1, {0, 1, 1, 1, 0}),
             back = profileAlongI(air->geometry(), 4, {0, 1, 1, 1, 0});
  Scene scene = plainScene(0);
  for (const bool frontFirst : {true, false}) {
    scene.segments = {{front, redPaint, 0.5}, {back, greenPaint, 1}};
    if (!frontFirst) std::swap(scene.segments[0], scene.segments[1]);
    COMPARE_PIXEL(pixelBy(byReference, scene, air), glm::dvec4(0.5 * redPaint + 0.5 * greenPaint, 1),
                  boundOf(byReference));
  }
}

void TestSegments::anEmptyClipBoxShowsNone() {
  QFETCH(bool, byReference);
  const auto matter = homogeneous(gridAround({6, 5, 7}));
  Scene scene = plainScene(0.5);
  scene.segments = {{fieldWhere(matter->geometry(), [](glm::dvec3) { return true; }), redPaint, 1}};
  for (const double at : {0.0, 0.5, 1.0}) {
    scene.clip.boxLow.x = scene.clip.boxHigh.x = at;
    COMPARE_PIXEL(pixelBy(byReference, scene, matter), glm::dvec4(0), 0);
  }
}

void TestSegments::otherMethodsAndProjectionsShowNone_data() {
  QTest::addColumn<Mode>("mode");
  QTest::addColumn<Method>("method");
  QTest::newRow("mip") << Mode::mip << Method::planes;
  QTest::newRow("average") << Mode::average << Method::planes;
  QTest::newRow("mip, reference") << Mode::mip << Method::reference;
  QTest::newRow("blend") << Mode::composite << Method::blend;
  QTest::newRow("preshaded") << Mode::composite << Method::preshaded;
}

void TestSegments::otherMethodsAndProjectionsShowNone() {
  QFETCH(Mode, mode);
  QFETCH(Method, method);
  const auto matter = homogeneous(gridAround({6, 5, 7}));
  Scene scene = plainScene(0.5);
  scene.mode = mode;
  RenderOptions options;
  options.size = {8, 8};
  options.method = method;
  RenderCaches caches(matter);
  const auto drawn = [&] { return render(*makePlan(scene, caches.facts(), options), caches)->picture; };
  const Picture without = drawn();
  scene.segments = {{fieldWhere(matter->geometry(), [](glm::dvec3) { return true; }), redPaint, 1}};
  QVERIFY(drawn() == without);
}

// A field never changes, so that pictures of the same field search it only once.
void TestSegments::onlyNewFieldsAreLookedInto() {
  const auto air = homogeneous(gridAround({6, 5, 7}));
  const auto all = fieldWhere(air->geometry(), [](glm::dvec3) { return true; });
  RenderOptions options;
  options.size = {4, 4};
  RenderCaches caches(air);
  Scene scene = plainScene(0);
  const auto draw = [&] { return bool(render(*makePlan(scene, caches.facts(), options), caches)); };
  scene.segments = {{all, redPaint, 1}};
  QVERIFY(draw());
  const long users = all.use_count();
  scene.segments[0].colour = greenPaint;
  QVERIFY(draw());
  QCOMPARE(all.use_count(), users);
  // The cache of a field is released when it is no longer drawn.
  scene.segments[0].opacity = 0;
  QVERIFY(draw());
  QCOMPARE(all.use_count(), 2);
}

VOLUMEN_TEST(TestSegments);
#include "tst_segments.moc"
