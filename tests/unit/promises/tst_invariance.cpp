// Guards design.md 2 (invariance): irrelevant changes do not change the picture, for every method at every
// level.
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/promises/promises.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dmat3;
using glm::dvec3;
using glm::ivec3;

class TestInvariance : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void opacityIsPerMm_data() { addRows(true); }
  void opacityIsPerMm();
  void lightsAddUp_data() { addRows(false); }
  void lightsAddUp();
  void earlyTerminationCostsLittle_data();
  void earlyTerminationCostsLittle();
  void turningVolumeAndCameraChangesNothing_data() { addRows(true); }
  void turningVolumeAndCameraChangesNothing();
  void theOrderOfVoxelsChangesNothing_data() { addRows(true); }
  void theOrderOfVoxelsChangesNothing();
  void aTiltedAcquisitionOfASphereIsASphere_data();
  void aTiltedAcquisitionOfASphereIsASphere();

 private:
  static void addRows(bool everyLevel);
};

namespace {

const glm::ivec2 pictureSize(24, 24);

/// Returns soft blobs over patient space (mm). Their second derivative along any axis is at most 30 a mm^2.
/// Linear interpolation between voxels of 1 mm is thus off by at most 4, one hundredth of what the curve
/// distinguishes.
double blobs(dvec3 p) {
  const dvec3 aside = p - dvec3(4, 2, -3);
  return 700 * std::exp(-glm::dot(p, p) / 60) + 250 * std::exp(-glm::dot(aside, aside) / 36);
}

VolumePtr blobsOn(ivec3 size, dmat3 L) {
  const dvec3 middle = (dvec3(size) - 1.0) / 2.0;
  return volumeOf(size, L, [=](dvec3 x) { return blobs(L * (x - middle)); });
}

Scene blobScene() {
  Scene scene;
  scene.transferFunction.points = {
      {100, {1, 0.4, 0.3}, 0}, {400, {0.9, 0.8, 0.4}, 0.1}, {900, {0.6, 0.8, 1}, 0.6}};
  scene.shading.gradientFloor = 20;
  scene.lights = {{{-0.4, 0.5, 1}, Space::camera, {1, 0.9, 0.8}, 0.6, true},
                  {{1, -2, 0.5}, Space::patient, {0.5, 0.6, 0.7}, 0.4, true}};
  scene.background.transparent = true;
  Camera camera;
  camera.target = dvec3(0);
  camera.direction = {0.3, 1, -0.2};
  camera.height = 14;
  scene.camera = camera;
  return scene;
}

Picture drawn(const VolumePtr& volume, const Scene& scene, const RenderOptions& options) {
  RenderCaches caches(volume);
  return Truth(caches, scene, pictureSize).drawn(options);
}

RenderOptions asked(int way, int level) {
  RenderOptions options = promisedWays()[std::size_t(way)].options;
  options.quality = promises[level].quality;
  return options;
}

void keepWithin(const PictureError& e, double most) {
  if (figuresWanted())
    std::fprintf(stderr, "%s %s | %s\n", QTest::currentTestFunction(), QTest::currentDataTag(),
                 qPrintable(inWords(e)));
  QVERIFY2(e.maximum <= most, qPrintable(inWords(e)));
}

}  // namespace

void TestInvariance::addRows(bool everyLevel) {
  QTest::addColumn<int>("way");
  QTest::addColumn<int>("level");
  for (std::size_t way = 0; way < promisedWays().size(); ++way)
    for (int level = 0; level < (everyLevel ? int(std::size(promises)) : 1); ++level)
      QTest::addRow("%s, %s", promisedWays()[way].name, promises[level].name) << int(way) << level;
}

#define FETCH_ASKED() \
  QFETCH(int, way);   \
  QFETCH(int, level); \
  const RenderOptions options = asked(way, level)

// Draws one smooth object on grids of 1 mm and 0.5 mm.
void TestInvariance::opacityIsPerMm() {
  FETCH_ASKED();
  const VolumePtr coarse = blobsOn(ivec3(24), dmat3(1)), fine = blobsOn(ivec3(48), dmat3(0.5));
  Scene scene = blobScene();
  keepWithin(compare(drawn(coarse, scene, options), drawn(fine, scene, options)), 2);
  scene.shading.lit = false;
  keepWithin(compare(drawn(coarse, scene, options), drawn(fine, scene, options)), 2);
}

// The picture under k lights is the sum of those under one light, minus (k - 1) times the one without light.
void TestInvariance::lightsAddUp() {
  FETCH_ASKED();
  const VolumePtr volume = blobsOn(ivec3(24), dmat3(1));
  Scene scene = blobScene();
  scene.lights.push_back({{0.2, 0.1, -1}, Space::camera, {0.2, 1, 0.3}, 0.3, true});
  scene.lights.push_back({{0, -1, 1}, Space::patient, {1, 0.2, 0.2}, 0.3, true});
  for (Light& light : scene.lights) light.intensity /= 2;  // prevents clamping
  const Picture all = drawn(volume, scene, options);
  Scene single = scene;
  single.lights.clear();
  const Picture none = drawn(volume, single, options);
  Picture sum = none;
  for (const Light& light : scene.lights) {
    single.lights = {light};
    const Picture one = drawn(volume, single, options);
    for (std::size_t n = 0; n < sum.rgba.size(); ++n) sum.rgba[n] += one.rgba[n] - none.rgba[n];
  }
  for (float component : all.rgba) QVERIFY(component < 1);
  keepWithin(compare(all, sum), 1);
}

void TestInvariance::earlyTerminationCostsLittle_data() {
  QTest::addColumn<int>("way");
  QTest::addColumn<int>("level");
  QTest::addColumn<double>("intensity");
  for (std::size_t way = 0; way < promisedWays().size(); ++way)
    for (int level = 0; level < int(std::size(promises)); ++level)
      for (double intensity : {1.0, 4.0, 30.0})
        if (promisedWays()[way].options.resampler != Resampler::gl ||
            promisedWays()[way].options.method != Method::blend)  // it has no rays to end
          QTest::addRow("%s, %s, light of %g", promisedWays()[way].name, promises[level].name, intensity)
              << int(way) << level << intensity;
}

// Dark, increasingly dense matter lies in front of bright matter, so that early termination hides as much as
// possible.
void TestInvariance::earlyTerminationCostsLittle() {
  FETCH_ASKED();
  QFETCH(double, intensity);
  const VolumePtr ramp = volumeOf(ivec3(24), dmat3(1), [](dvec3 x) { return 100 * x.y + 7 * x.x; });
  Scene scene = blobScene();
  scene.transferFunction.points = {{0, {0, 0, 0}, 0.3}, {1600, {0, 0, 0}, 0.6}, {1600, {1, 1, 1}, 0.6}};
  scene.camera->direction = {0, 1, 0};
  scene.shading.specular = 0;
  scene.lights = {{{0, 0, 1}, Space::camera, {1, 1, 1}, intensity, true}};
  RenderOptions never = options;
  never.stopAt = 0;
  keepWithin(compare(drawn(ramp, scene, options), drawn(ramp, scene, never)), 0.25);
}

void TestInvariance::turningVolumeAndCameraChangesNothing() {
  FETCH_ASKED();
  const VolumePtr volume = blobsOn({24, 20, 22}, dmat3({0.9, 0, 0}, {0, 1, 0}, {0, 0, 1.1}));
  Scene scene = blobScene();
  scene.clip.planes = {{{1, 2, 3}, 4}};
  const Picture before = drawn(volume, scene, options);
  const dmat3 turns[] = {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
                         {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                         {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}};
  for (const dmat3& turn : turns) {
    VolumeParts parts;
    parts.geometry = volume->geometry();
    parts.geometry.patientFromVoxelStep = turn * parts.geometry.patientFromVoxelStep;
    parts.geometry.origin = turn * parts.geometry.origin;
    parts.values = volume->stored();
    std::vector<std::string> warnings;
    Scene turnedScene = scene;
    turnedScene.camera->direction = turn * scene.camera->direction;
    turnedScene.camera->up = turn * scene.camera->up;
    turnedScene.lights[1].direction = turn * scene.lights[1].direction;
    turnedScene.clip.planes[0].normal = turn * scene.clip.planes[0].normal;
    keepWithin(compare(before, drawn(*Volume::make(std::move(parts), warnings), turnedScene, options)), 1);
  }
}

// The same voxels are stored with another axis first, or backwards.
void TestInvariance::theOrderOfVoxelsChangesNothing() {
  FETCH_ASKED();
  const Scene scene = blobScene();
  const Picture before = drawn(blobsOn({24, 20, 22}, dmat3(1)), scene, options);
  const Picture permuted =
      drawn(blobsOn({20, 22, 24}, dmat3({0, 1, 0}, {0, 0, 1}, {1, 0, 0})), scene, options);
  keepWithin(compare(before, permuted), 1);
  const Picture mirrored =
      drawn(blobsOn({24, 20, 22}, dmat3({-1, 0, 0}, {0, 1, 0}, {0, 0, -1})), scene, options);
  keepWithin(compare(before, mirrored), 1);
}

void TestInvariance::aTiltedAcquisitionOfASphereIsASphere_data() {
  QTest::addColumn<int>("way");
  QTest::addColumn<dvec3>("direction");
  for (std::size_t way = 0; way < promisedWays().size(); ++way)
    for (const auto& [name, direction] : {std::pair{"from the front", dvec3(0, 1, 0)},
                                          {"from the side", dvec3(1, 0, 0)},
                                          {"from above", dvec3(0, 0, -1)},
                                          {"askew", dvec3(0.5, 0.7, -0.4)}})
      QTest::addRow("%s, %s", promisedWays()[way].name, name) << int(way) << direction;
}

// Slices are tilted by 25 degrees and 1.5 mm apart along the patient's axis. The sphere's silhouette must be
// a disc. Its axes are those of its second moments.
void TestInvariance::aTiltedAcquisitionOfASphereIsASphere() {
  QFETCH(int, way);
  QFETCH(dvec3, direction);
  const double tilt = glm::radians(25.0);
  const ivec3 size(44, 48, 28);
  const dmat3 L({1, 0, 0}, {0, std::cos(tilt), std::sin(tilt)}, {0, 0, 1.5});
  const VolumePtr volume = volumeOf(size, L, [&](dvec3 x) {
    return 500 * std::erfc((glm::length(L * (x - (dvec3(size) - 1.0) / 2.0)) - 14) / 1.5);
  });
  Scene scene;
  scene.transferFunction.points = {{500, {1, 1, 1}, 0}, {500, {1, 1, 1}, 1}};
  scene.shading.lit = false;
  scene.background.transparent = true;
  scene.camera = Camera{};
  scene.camera->target = dvec3(0);
  scene.camera->direction = direction;
  scene.camera->up = std::abs(direction.z) > 0.9 ? dvec3(0, 1, 0) : dvec3(0, 0, 1);
  scene.camera->height = 32;
  constexpr int edge = 160;
  RenderCaches caches(volume);
  const Picture picture = Truth(caches, scene, glm::ivec2(edge)).drawn(asked(way, 0));
  double area = 0, x1 = 0, y1 = 0, xx = 0, xy = 0, yy = 0;
  for (int y = 0; y < edge; ++y)
    for (int x = 0; x < edge; ++x) {
      const double alpha = double(picture.row(y)[4 * x + 3]);
      area += alpha, x1 += alpha * x, y1 += alpha * y;
      xx += alpha * x * x, xy += alpha * x * y, yy += alpha * y * y;
    }
  xx = xx / area - x1 * x1 / area / area, yy = yy / area - y1 * y1 / area / area;
  xy = xy / area - x1 * y1 / area / area;
  const double spread = std::sqrt((xx - yy) * (xx - yy) + 4 * xy * xy);
  const double ratio = std::sqrt((xx + yy + spread) / (xx + yy - spread));
  const double radiusMm = std::sqrt(area / glm::pi<double>()) * scene.camera->height / edge;
  const QString words = QStringLiteral("axis ratio %1, radius %2 mm").arg(ratio).arg(radiusMm);
  if (figuresWanted()) std::fprintf(stderr, "%s | %s\n", QTest::currentDataTag(), qPrintable(words));
  QVERIFY2(ratio <= 1.01 && std::abs(radiusMm / 14 - 1) <= 0.01, qPrintable(words));
}

VOLUMEN_TEST(TestInvariance);
#include "tst_invariance.moc"
