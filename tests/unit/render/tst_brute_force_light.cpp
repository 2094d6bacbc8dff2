// Guards the brute-force renderer that the reference is tested against: picture.md 3 to 5 (gradients,
// gradient opacity, light) in cases with a closed form.
#include "tests/unit/render/brute_force_fixture.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;
using namespace volumen::tests::closed_forms;
using glm::dmat3;
using glm::dvec3;
using glm::ivec3;

class TestBruteForceLight : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void lightIsThatOfTheFormulas_data();
  void lightIsThatOfTheFormulas();
  void aLocalViewerSeesItsOwnHighlight();
  void gradientOpacityIsAFactor();
  void theGradientIsSobels_data();
  void theGradientIsSobels();
};

void TestBruteForceLight::lightIsThatOfTheFormulas_data() {
  QTest::addColumn<dmat3>("steps");
  QTest::addColumn<dvec3>("slope");  // value per voxel
  QTest::addColumn<int>("sides");
  QTest::addColumn<double>("gradientFloor");
  QTest::addColumn<dvec3>("light");
  QTest::addColumn<double>("diffuse");   // D''
  QTest::addColumn<double>("specular");  // S''
  const dvec3 headlight(0, 0, 1), j(0, 1, 0);
  // Views along +y with ambient 0.2, diffuse 0.7, specular 0.2, shininess 20.
  QTest::newRow("slope towards the viewer") << unitSteps << j << 2 << 0.1 << headlight << 0.9 << 0.2;
  QTest::newRow("its back, two sides") << unitSteps << -j << 2 << 0.1 << headlight << 0.9 << 0.2;
  QTest::newRow("its back, one side") << unitSteps << -j << 1 << 0.1 << headlight << 0.2 << 0.0;
  QTest::newRow("edge-on: both sides by halves")
      << unitSteps << dvec3(1, 0, 0) << 2 << 0.1 << dvec3(1, 0, 0) << 0.55 << 0.1 / 1024;
  QTest::newRow("in the change-over: w = 1/2 + 0.06/0.2")
      << unitSteps << dvec3(-std::sqrt(1 - 0.0036), 0.06, 0) << 2 << 0.1 << dvec3(3, 0, 0)
      << 0.2 + 0.8 * 0.7 * std::sqrt(1 - 0.0036)
      << 0.8 * 0.2 * std::pow((std::sqrt(1 - 0.0036) + 0.06) / std::sqrt(2.0), 20);
  QTest::newRow("half the gradient floor: q = 1/2")
      << unitSteps << j << 2 << 2.0 << headlight << 0.5 * 0.9 + 0.5 * 0.55 << 0.1;
  QTest::newRow("the floor counts per mm") << dmat3({1, 0, 0}, {0, 2, 0}, {0, 0, 1}) << j << 2 << 1.0
                                           << headlight << 0.5 * 0.9 + 0.5 * 0.55 << 0.1;
  QTest::newRow("no gradient: q = 0") << unitSteps << dvec3(0) << 2 << 1.0 << headlight << 0.55 << 0.0;
  QTest::newRow("light from behind adds nothing")
      << unitSteps << j << 2 << 0.1 << dvec3(0, 0, -1) << 0.2 << 0.0;
  QTest::newRow("highlight fades in over n.l = 0 .. 0.1")
      << unitSteps << j << 2 << 0.1 << dvec3(0, std::sqrt(1 - 0.0025), 0.05) << 0.2 + 0.7 * 0.05
      << 0.5 * 0.2 * std::pow(std::sqrt((1 + 0.05) / 2), 20);
  const double cosine = 1 / std::sqrt(1 + 0.0625);  // g_p = (0, 1, -1/4)
  QTest::newRow("normals of a sheared grid")
      << sheared << j << 2 << 0.1 << headlight << 0.2 + 0.7 * cosine << 0.2 * std::pow(cosine, 20);
}

void TestBruteForceLight::lightIsThatOfTheFormulas() {
  QFETCH(dmat3, steps);
  QFETCH(dvec3, slope);
  QFETCH(int, sides);
  QFETCH(double, gradientFloor);
  QFETCH(dvec3, light);
  QFETCH(double, diffuse);
  QFETCH(double, specular);
  const VolumePtr volume = volumeOf(ivec3(9), steps, [&](dvec3 x) { return glm::dot(slope, x); });
  const dvec3 colour(0.5, 0.25, 0.75), lightColour(1, 0.5, 0.25);
  Scene scene = plainScene(colour, 0.1);
  scene.clip = {dvec3(0.3), dvec3(0.7), {}};  // the Sobel gradient of a linear function is exact there
  scene.shading.lit = true;
  scene.shading.sides = sides;
  scene.shading.gradientFloor = gradientFloor;
  scene.lights = {{light, Space::camera, {1, 0, 0}, 1, true},
                  {light, Space::camera, lightColour, 1, true},
                  {light, Space::camera, {1, 1, 1}, 1, false}};
  scene.lights[0].colour = {0, 0, 0};
  const std::vector<double> p = onePixel(bruteForceLimit(scene, *volume, {1, 1}));
  for (int c = 0; c < 3; ++c) {
    const double expected = colour[c] * (0.2 + (diffuse - 0.2) * lightColour[c]) + specular * lightColour[c];
    QVERIFY2(near(p[c] / p[3], expected, 2e-6),
             qPrintable(QStringLiteral("%1: %2, not %3").arg(c).arg(p[c] / p[3]).arg(expected)));
  }
}

void TestBruteForceLight::aLocalViewerSeesItsOwnHighlight() {
  const VolumePtr volume = volumeOf(ivec3(20), unitSteps, [](dvec3 x) { return x.y; });
  Scene scene = plainScene({0, 0, 0}, 0.1);
  scene.clip = {dvec3(0.1), dvec3(0.9), {}};
  scene.shading.lit = true;
  scene.camera->projection = Projection::perspective;
  scene.camera->fov = 90;
  scene.camera->distance = 9;
  scene.camera->target = dvec3(0, 0, 0);
  // The left pixel's ray is (-2, 0, 1)/sqrt 5 in camera space. n is the backward axis.
  QVERIFY(near(pixel(bruteForceLimit(scene, *volume, {3, 1}), 0, 0, 0) /
                   pixel(bruteForceLimit(scene, *volume, {3, 1}), 0, 0, 3),
               0.2, 1e-6));
  scene.shading.localViewer = true;
  const Picture local = bruteForceLimit(scene, *volume, {3, 1});
  QVERIFY(near(pixel(local, 0, 0, 0) / pixel(local, 0, 0, 3),
               0.2 * std::pow((1 + 1 / std::sqrt(5.0)) / 2, 10), 1e-6));
}

void TestBruteForceLight::gradientOpacityIsAFactor() {
  // |g_p| = 3 per 2 mm = 1.5, between the points (1, 0.2) and (2, 1).
  const VolumePtr volume =
      volumeOf(ivec3(9), dmat3({2, 0, 0}, {0, 1, 0}, {0, 0, 1}), [](dvec3 x) { return 3 * x.x; });
  Scene scene = plainScene({1, 1, 1}, 0.5);
  scene.clip = {dvec3(3 / 9.0), dvec3(6 / 9.0), {}};
  scene.transferFunction.gradientOpacity = {{1, 0.2}, {2, 1}};
  QVERIFY(near(onePixel(bruteForceLimit(scene, *volume, {1, 1}))[3], 1 - std::pow(1 - 0.5 * 0.6, 3), 1e-6));
}

void TestBruteForceLight::theGradientIsSobels_data() {
  QTest::addColumn<ivec3>("bright");  // the only voxel that is not 0; its value is 8
  QTest::addColumn<ivec3>("voxel");
  QTest::addColumn<double>("gradient");  // |g_p| at voxel
  QTest::newRow("beside it") << ivec3(2) << ivec3(1, 2, 2) << 1.0;
  QTest::newRow("across an edge") << ivec3(2) << ivec3(3, 2, 1) << std::sqrt(2 * 0.25);
  QTest::newRow("across a corner") << ivec3(2) << ivec3(1, 3, 1) << std::sqrt(3 * 0.0625);
  QTest::newRow("in the volume's corner: neighbours clamped")
      << ivec3(0) << ivec3(0) << std::sqrt(3.0) * 8 * 0.5 * 0.75 * 0.75;
}

void TestBruteForceLight::theGradientIsSobels() {
  QFETCH(ivec3, bright);
  QFETCH(ivec3, voxel);
  QFETCH(double, gradient);
  const VolumePtr volume = volumeOf(ivec3(5), unitSteps, [&](dvec3 x) { return 8 * (ivec3(x) == bright); });
  Scene scene = plainScene({1, 1, 1}, 0.5);
  scene.transferFunction.gradientOpacity = {{0, 0}, {8, 1}};
  scene.transferFunction.unitDistance = 0.002;  // a box of this size around the voxel's centre
  scene.camera->target = volume->geometry().patientFromVoxel(voxel);
  scene.clip = {(dvec3(voxel) + 0.499) / 5.0, (dvec3(voxel) + 0.501) / 5.0, {}};
  QVERIFY(near(onePixel(bruteForceLimit(scene, *volume, {1, 1}))[3], 0.5 * gradient / 8, 1e-4));
}

VOLUMEN_TEST(TestBruteForceLight);
#include "tst_brute_force_light.moc"
