// Guards picture.md 1, 6 (interval), 7 and design.md 2 (invariance, well-conditioned pixels, determinism,
// finite) for the reference renderer.
#include <limits>

#include "tests/unit/render/reference_fixture.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestReferenceRays : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void lengthOfTheRayInTheVolume_data();
  void lengthOfTheRayInTheVolume();
  void perspectivePictureHasTheLengthsOfItsRays();
  void parallelPictureLiesWhereTheCameraSays();
  void turningVolumeAndCameraChangesNothing();
  void finerGridGivesTheSamePicture();
  void sameBytesForAnyNumberOfThreads();
  void cancelledRenderingIsAnError();
  void extremeScenesStayFinite_data();
  void extremeScenesStayFinite();
  void raysThatTouchAStepAreIllConditioned();
};

namespace {

struct LengthCase {
  const char* name;
  VoxelGeometry geometry;
  Camera camera;
  Clip clip;
  double lengthMm;
};

Camera looking(glm::dvec3 direction, glm::dvec3 target = glm::dvec3(0)) {
  Camera camera = *plainScene(0, direction).camera;
  camera.target = target;
  return camera;
}

Camera eyeAt(glm::dvec3 eye, glm::dvec3 direction) {
  Camera camera = looking(direction, eye + glm::normalize(direction) * 3.0);
  camera.projection = Projection::perspective;
  camera.distance = 3;
  return camera;
}

Clip box(glm::dvec3 low, glm::dvec3 high) { return {low, high, {}}; }
Clip planes(std::vector<ClipPlane> all) { return {glm::dvec3(0), glm::dvec3(1), std::move(all)}; }

const VoxelGeometry cube = gridAround(glm::ivec3(10));
// k is oblique: 0.5 mm along x and 2 mm along z a voxel.
const VoxelGeometry sheared = gridAround({20, 8, 4}, {{1, 0, 0}, {0, 1, 0}, {0.5, 0, 2}});
const VoxelGeometry leftHanded = gridAround({10, 6, 4}, {{-0.7, 0, 0}, {0, 1.5, 0}, {0, 0, 2}});

const std::vector<LengthCase>& lengthCases() {
  const double root2 = std::sqrt(2.0);
  static const std::vector<LengthCase> cases = {
      {"along an axis", cube, looking({1, 0, 0}), {}, 10},
      {"diagonal", cube, looking({1, 1, 1}), {}, 10 * std::sqrt(3.0)},
      {"across a corner", cube, looking({1, 1, 0}, {4, -4, 0}), {}, 2 * root2},
      {"beside the box", cube, looking({1, 0, 0}, {0, 5.001, 0}), {}, 0},
      {"in the face", cube, looking({1, 0, 0}, {0, 5, 0}), {}, 10},
      {"in the opposite face", cube, looking({1, 0, 0}, {0, 0, -5}), {}, 10},
      {"in the edge", cube, looking({0, 0, 1}, {-5, 5, 0}), {}, 10},
      {"through a plane of voxel centres", cube, looking({1, 0, 0}, {0, 0.5, 0.5}), {}, 10},
      {"single slice, face on",
       gridAround({8, 8, 1}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 3}}),
       looking({0, 0, 1}),
       {},
       3},
      {"single slice, edge on",
       gridAround({8, 8, 1}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 3}}),
       looking({1, 0, 0}),
       {},
       8},
      {"one column of voxels",
       gridAround({1, 1, 7}, {{2, 0, 0}, {0, 2, 0}, {0, 0, 0.5}}),
       looking({0, 0, 1}),
       {},
       3.5},
      {"one voxel", gridAround({1, 1, 1}), looking({1, 0, 0}), {}, 1},
      {"sheared, along i", sheared, looking({1, 0, 0}), {}, 20},
      {"sheared, along z", sheared, looking({0, 0, 1}), {}, 8},
      // The box holds |x - z/4| <= 10 and |z| <= 4.
      {"sheared, into the slope", sheared, looking({0, 0, 1}, {10.5, 0, 0}), {}, 2},
      {"left-handed, along i", leftHanded, looking({1, 0, 0}), {}, 7},
      {"left-handed, along j", leftHanded, looking({0, 1, 0}), {}, 9},
      {"clip box", cube, looking({1, 0, 0}), box({0.25, 0, 0}, {0.75, 1, 1}), 5},
      {"clip box beside the ray", cube, looking({1, 0, 0}), box({0, 0.6, 0}, {1, 1, 1}), 0},
      {"face of the clip box", cube, looking({1, 0, 0}), box({0, 0.5, 0}, {1, 1, 1}), 10},
      {"flat clip box across the ray", cube, looking({1, 0, 0}), box({0.5, 0, 0}, {0.5, 1, 1}), 0},
      {"clip box of a left-handed grid", leftHanded, looking({1, 0, 0}, {1, 0, 0}),
       box({0, 0, 0}, {0.3, 1, 1}), 2.1},
      {"clip plane across", cube, looking({1, 0, 0}), planes({{{2, 0, 0}, 1.5}}), 6.5},
      {"clip plane aslant", cube, looking({1, 0, 0}), planes({{{-1, -1, 0}, 1}}), 5 + root2},
      {"two clip planes", cube, looking({0, 1, 0}), planes({{{0, 1, 0}, 1}, {{0, -1, 0}, 1}}), 2},
      {"in a clip plane", cube, looking({1, 0, 0}), planes({{{0, 1, 0}, 0}}), 10},
      {"behind a clip plane", cube, looking({1, 0, 0}), planes({{{0, 1, 0}, -0.001}}), 0},
      {"eye outside", cube, eyeAt({-50, 0, 0}, {1, 0, 0}), {}, 10},
      {"eye inside", cube, eyeAt({2, 0, 0}, {1, 0, 0}), {}, 3},
      {"eye inside, looking back", cube, eyeAt({2, 0, 0}, {-1, 0, 0}), {}, 7},
      {"volume behind the eye", cube, eyeAt({6, 0, 0}, {1, 0, 0}), {}, 0},
      {"parallel rays start behind the target", cube, looking({1, 0, 0}, {100, 0, 0}), {}, 10},
  };
  return cases;
}

}  // namespace

void TestReferenceRays::lengthOfTheRayInTheVolume_data() {
  QTest::addColumn<int>("row");
  for (std::size_t n = 0; n < lengthCases().size(); ++n) QTest::newRow(lengthCases()[n].name) << int(n);
}

void TestReferenceRays::lengthOfTheRayInTheVolume() {
  QFETCH(int, row);
  const LengthCase& c = lengthCases()[row];
  Scene scene = plainScene(0.05);
  scene.camera = c.camera;
  scene.clip = c.clip;
  const double alpha = onePixel(scene, *homogeneous(c.geometry)).a;
  COMPARE_WITHIN(-std::log1p(-alpha) / extinction(0.05), c.lengthMm, 1e-5);
}

void TestReferenceRays::perspectivePictureHasTheLengthsOfItsRays() {
  // In a slab across the view, a ray at angle theta has length thickness / cos(theta).
  const auto slab = homogeneous(gridAround({100, 4, 100}));
  Scene scene = plainScene(0.1, {0, 1, 0});
  scene.camera->projection = Projection::perspective;
  scene.camera->fov = 50;
  scene.camera->distance = 30;
  const glm::ivec2 size(5, 3);
  const Picture picture = drawn(scene, *slab, size);
  const double half = std::tan(glm::radians(25.0));
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) {
      const double a = (x - 2) / 1.5 * half, b = (1 - y) / 1.5 * half;
      const double lengthMm = 4 * std::sqrt(1 + a * a + b * b);
      COMPARE_WITHIN(picture.row(y)[4 * x + 3], 1 - std::pow(0.9, lengthMm), 2e-7);
    }
}

void TestReferenceRays::parallelPictureLiesWhereTheCameraSays() {
  // One voxel of the grid is dense. Seen from the front, the patient's left (+x) is on the right and +z on
  // top.
  const auto dot = volumeOf(gridAround({5, 1, 3}), [](int i, int, int k) { return i == 3 && k == 2; });
  Scene scene = plainScene(0, {0, 1, 0});
  scene.mode = Mode::mip;
  scene.camera->height = 3;
  const Picture picture = drawn(scene, *dot, {5, 3});
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) QCOMPARE(picture.row(y)[4 * x], x == 3 && y == 0 ? 1.0f : 0.0f);
}

namespace {
double blob(glm::dvec3 p) {
  return 100 * std::exp(-glm::dot(p, p) / 18) + 60 * std::exp(-glm::dot(p - glm::dvec3(3, 1, -2), p) / 10);
}

Scene blobScene() {
  Scene scene = plainScene(0, {0.3, 1, -0.2});
  scene.transferFunction.points = {
      {20, {1, 0.4, 0.3}, 0}, {60, {0.9, 0.8, 0.6}, 0.3}, {60, {0.2, 0.5, 1}, 0.5}, {110, {1, 1, 1}, 0.9}};
  scene.camera->height = 16;
  return scene;
}
}  // namespace

void TestReferenceRays::turningVolumeAndCameraChangesNothing() {
  const glm::dmat3 turn(0, 1, 0, -1, 0, 0, 0, 0, 1);  // 90 degrees about z
  const auto plain = volumeOf(gridAround({13, 11, 12}), [](int i, int j, int k) {
    return blob(glm::dvec3(i, j, k) - glm::dvec3(6, 5, 5.5));
  });
  VoxelGeometry geometry = plain->geometry();
  geometry.patientFromVoxelStep = turn * geometry.patientFromVoxelStep;
  geometry.origin = turn * geometry.origin;
  VolumeParts parts;
  parts.geometry = geometry;
  parts.values = plain->stored();
  std::vector<std::string> warnings;
  const auto turnedVolume = *Volume::make(parts, warnings);
  Scene scene = blobScene();
  scene.shading.lit = true;
  scene.shading.gradientFloor = 5;
  scene.lights.push_back({{1, -2, 0.5}, Space::patient, {0.5, 0.6, 0.7}, 0.5, true});
  scene.clip.planes = {{{1, 2, 3}, 4}};
  Scene turnedScene = scene;
  turnedScene.camera->direction = turn * scene.camera->direction;
  turnedScene.camera->up = turn * scene.camera->up;
  turnedScene.lights[1].direction = turn * scene.lights[1].direction;
  turnedScene.clip.planes[0].normal = turn * scene.clip.planes[0].normal;
  const PictureError error =
      compare(drawn(scene, *plain, {16, 16}), drawn(turnedScene, *turnedVolume, {16, 16}));
  // 1e-6 of full scale
  QVERIFY2(error.maximum <= 255e-6, qPrintable(QString::number(error.maximum)));
}

void TestReferenceRays::finerGridGivesTheSamePicture() {
  const auto grid = [](int size, double stepMm) {
    return volumeOf(gridAround(glm::ivec3(size), glm::dmat3(stepMm)), [=](int i, int j, int k) {
      return 300 * std::erfc((stepMm * glm::length(glm::dvec3(i, j, k) - (size - 1) / 2.0) - 8) / 4);
    });
  };
  Scene scene = plainScene(0, {0.3, 1, -0.2});
  scene.transferFunction.points = {{50, {1, 0.4, 0.3}, 0}, {500, {0.9, 0.8, 0.6}, 0.2}};
  scene.camera->height = 26;
  const PictureError error =
      compare(drawn(scene, *grid(32, 1), {24, 24}), drawn(scene, *grid(64, 0.5), {24, 24}));
  QVERIFY2(error.maximum <= 2, qPrintable(QString::number(error.maximum)));
}

void TestReferenceRays::sameBytesForAnyNumberOfThreads() {
  const auto volume = volumeOf(gridAround(glm::ivec3(12)), [](int i, int j, int k) {
    return blob({i - 6, j - 5, k - 7});
  });
  Scene scene = blobScene();
  scene.shading.lit = true;
  scene.shading.gradientFloor = 2;
  const Picture one = drawn(scene, *volume, {19, 13}, 1);
  QVERIFY(one == drawn(scene, *volume, {19, 13}, 2));
  QVERIFY(one == drawn(scene, *volume, {19, 13}, 0));
  QVERIFY(one.rgba != std::vector<float>(one.rgba.size(), 0.0f));
}

void TestReferenceRays::cancelledRenderingIsAnError() {
  const CancelToken cancel;
  cancel.cancel();
  const auto volume = homogeneous(cube);
  QCOMPARE(renderReference(plainScene(0.1), *volume, {4, 4}, 1, cancel).message(), std::string("cancelled"));
  QVERIFY(!wellConditioned(plainScene(0.1), *volume, {4, 4}, 1, cancel).ok());
}

void TestReferenceRays::extremeScenesStayFinite_data() {
  QTest::addColumn<QString>("what");
  for (const char* what : {"everything huge", "everything tiny", "opaque per 1e-300 mm", "values of 1e30",
                           "narrowest highlight and floor", "far eye", "voxels of 1e-6 mm"})
    QTest::newRow(what) << QString::fromLatin1(what);
}

void TestReferenceRays::extremeScenesStayFinite() {
  QFETCH(QString, what);
  const double largest = std::numeric_limits<double>::max(),
               smallest = std::numeric_limits<double>::denorm_min();
  const bool is1e30 = what == QLatin1String("values of 1e30"),
             tinyVoxels = what == QLatin1String("voxels of 1e-6 mm");
  const auto volume =
      volumeOf(gridAround(glm::ivec3(6), glm::dmat3(tinyVoxels ? 1e-6 : 1)), [&](int i, int j, int k) {
        const double v = (i * 7 + j * 5 + k * 3) % 11 - 5;
        return is1e30 ? v * 2e29 : v * 30;
      });
  Scene scene = blobScene();
  scene.transferFunction.points[0].value = -100;
  scene.transferFunction.gradientOpacity = {{0, 0.2}, {10, 1}, {10, 0.5}, {50, 0.9}};
  scene.shading.lit = true;
  scene.shading.gradientFloor = 3;
  scene.camera->height = tinyVoxels ? 1e-5 : 10;
  if (what == QLatin1String("everything huge")) {
    scene.shading.ambient = scene.shading.diffuse = scene.shading.specular = scene.lights[0].intensity =
        largest;
    scene.shading.gradientFloor = largest;
  } else if (what == QLatin1String("everything tiny")) {
    scene.shading.ambient = scene.shading.diffuse = scene.shading.specular = scene.lights[0].intensity =
        smallest;
    scene.shading.gradientFloor = smallest;
  } else if (what == QLatin1String("opaque per 1e-300 mm")) {
    scene.transferFunction.unitDistance = 1e-300;
  } else if (what == QLatin1String("narrowest highlight and floor")) {
    scene.shading.shininess = 10000;
    scene.shading.gradientFloor = smallest;
  } else if (what == QLatin1String("far eye")) {
    scene.camera->projection = Projection::perspective;
    scene.camera->distance = 1e12;
    scene.camera->fov = 0.1;
  }
  for (float x : drawn(scene, *volume, {6, 6}).rgba) QVERIFY(x >= 0 && x <= 1);
}

void TestReferenceRays::raysThatTouchAStepAreIllConditioned() {
  // The opaque half begins at x = 3.5 voxels (0 mm), where the middle one of three columns hits it.
  const auto halves = volumeOf(gridAround({8, 2, 2}), [](int i, int, int) { return i < 4 ? 0 : 100; });
  Scene scene = plainScene(0, {0, 1, 0});
  scene.transferFunction.points = {{50, glm::dvec3(1), 0}, {50, glm::dvec3(1), 1}};
  const auto well = *wellConditioned(scene, *halves, {3, 1}, 1);
  QCOMPARE(well, (std::vector<std::uint8_t>{1, 0, 1}));
}

VOLUMEN_TEST(TestReferenceRays);
#include "tst_reference_rays.moc"
