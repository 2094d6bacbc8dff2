// Guards the brute-force renderer that the reference is tested against: picture.md 2, 4 and 6 to 9 in cases
// with a closed form.
#include "tests/unit/render/brute_force_fixture.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;
using namespace volumen::tests::closed_forms;
using glm::dmat3;
using glm::dvec3;
using glm::ivec3;

class TestBruteForceClosedForms : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void opacityIsPerMillimetre_data();
  void opacityIsPerMillimetre();
  void everyRayOfAPerspectiveHasItsLength();
  void pixelsLieWhereTheCameraSays();
  void aRampHasItsIntegral();
  void aStepLiesExactlyAtItsValue();
  void projectionsOfARamp_data();
  void projectionsOfARamp();
  void theMidpointRuleSamplesTheMiddles();
  void backgroundIsBehind();
  void defaultsComeFromTheVolume();
};

void TestBruteForceClosedForms::opacityIsPerMillimetre_data() {
  QTest::addColumn<dmat3>("steps");
  QTest::addColumn<dvec3>("direction");
  QTest::addColumn<dvec3>("low");
  QTest::addColumn<dvec3>("high");
  QTest::addColumn<double>("mm");
  const dvec3 none(0), all(1);
  const dmat3 anisotropic({2, 0, 0}, {0, 1, 0}, {0, 0, 0.5});
  QTest::newRow("along j, 6 voxels of 1 mm") << anisotropic << dvec3(0, 1, 0) << none << all << 6.0;
  QTest::newRow("along i, 6 voxels of 2 mm") << anisotropic << dvec3(1, 0, 0) << none << all << 12.0;
  QTest::newRow("against k, 6 voxels of 0.5 mm") << anisotropic << dvec3(0, 0, -1) << none << all << 3.0;
  QTest::newRow("a direction that is not unit") << anisotropic << dvec3(0, 7, 0) << none << all << 6.0;
  QTest::newRow("across a square") << unitSteps << dvec3(1, 1, 0) << none << all << 6 * std::sqrt(2.0);
  QTest::newRow("clip box in fractions of cells")
      << unitSteps << dvec3(0, 1, 0) << dvec3(0, 0.25, 0) << dvec3(1, 0.5, 1) << 1.5;
  QTest::newRow("oblique grid") << dmat3({0.6, 0.8, 0}, {-0.8, 0.6, 0}, {0, 0, 1}) << dvec3(-0.8, 0.6, 0)
                                << none << all << 6.0;
  QTest::newRow("sheared grid") << sheared << dvec3(0, 0, 1) << none << all << 12.0;
  QTest::newRow("left-handed grid") << dmat3({-1, 0, 0}, {0, 3, 0}, {0, 0, 1}) << dvec3(0, 1, 0) << none
                                    << all << 18.0;
}

void TestBruteForceClosedForms::opacityIsPerMillimetre() {
  QFETCH(dmat3, steps);
  QFETCH(dvec3, direction);
  QFETCH(dvec3, low);
  QFETCH(dvec3, high);
  QFETCH(double, mm);
  const VolumePtr volume = volumeOf(ivec3(6), steps, [](dvec3) { return 40; });
  Scene scene = plainScene({0.5, 1, 0.25}, 0.3);
  scene.transferFunction.unitDistance = 2;
  scene.camera->direction = direction;
  if (std::abs(direction.z) > 0.5) scene.camera->up = {0, 1, 0};
  scene.clip.boxLow = low;
  scene.clip.boxHigh = high;
  const double alpha = 1 - std::pow(0.7, mm / 2);
  for (const Picture& picture :
       {bruteForceLimit(scene, *volume, {1, 1}), bruteForce(scene, *volume, {1, 1}, 0.7)}) {
    const std::vector<double> p = onePixel(picture);
    QVERIFY2(near(p[3], alpha, 1e-6), qPrintable(QString::number(p[3] - alpha)));
    QVERIFY(near(p[0], 0.5 * alpha, 1e-6) && near(p[1], alpha, 1e-6) && near(p[2], 0.25 * alpha, 1e-6));
  }
}

void TestBruteForceClosedForms::everyRayOfAPerspectiveHasItsLength() {
  const VolumePtr volume = volumeOf(ivec3(10), unitSteps, [](dvec3) { return 0; });
  Scene scene = plainScene({1, 1, 1}, 0.1);
  // The eye is the centre of the volume. All rays leave by the face 5 mm in front of it, or by the plane.
  scene.camera->projection = Projection::perspective;
  scene.camera->fov = 60;
  scene.camera->distance = 8;
  scene.camera->target = dvec3(0, 8, 0);
  for (double end : {5.0, 2.0}) {
    if (end < 5) scene.clip.planes = {{{0, 2, 0}, end}};
    const Picture picture = bruteForceLimit(scene, *volume, {5, 3});
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 5; ++x) {
        const double height = 2 * std::tan(std::acos(-1.0) / 6);  // at distance 1
        const double a = ((x + 0.5) / 5 - 0.5) * height * 5 / 3, b = (0.5 - (y + 0.5) / 3) * height;
        const double mm = end * std::sqrt(1 + a * a + b * b);
        QVERIFY(near(pixel(picture, x, y, 3), 1 - std::pow(0.9, mm), 1e-6));
      }
  }
}

void TestBruteForceClosedForms::pixelsLieWhereTheCameraSays() {
  // v = 100 i + 10 k. Seen from the front (along +y, up +z), picture x runs towards the patient's left, +x.
  const VolumePtr volume = volumeOf(ivec3(4), unitSteps, [](dvec3 x) { return 100 * x.x + 10 * x.z; });
  Scene scene;
  scene.mode = Mode::mip;
  scene.window = Window{500, 1000};
  scene.camera.emplace().height = 4;
  const Picture picture = bruteForceLimit(scene, *volume, {4, 4});
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      QVERIFY(near(pixel(picture, x, y, 0), (100 * x + 10 * (3 - y)) / 1000.0, 1e-6));
}

void TestBruteForceClosedForms::aRampHasItsIntegral() {
  // v = i on 0..9 with opacity v/10, so that mu = -ln(1 - v/10). It is constant on the outer half voxels.
  const VolumePtr volume = volumeOf({10, 3, 3}, unitSteps, [](dvec3 x) { return x.x; });
  Scene scene = plainScene({1, 1, 1}, 0);
  scene.transferFunction.points = {{0, {1, 1, 1}, 0}, {10, {1, 1, 1}, 1}};
  scene.camera->direction = {1, 0, 0};
  scene.clip.boxHigh.x = 0.55;  // to i = 5
  auto antiderivative = [](double v) { return 10 * ((1 - v / 10) * std::log(1 - v / 10) - (1 - v / 10)); };
  const double depth = antiderivative(5) - antiderivative(0);
  const std::vector<double> p = onePixel(bruteForceLimit(scene, *volume, {1, 1}));
  QVERIFY2(near(p[3], 1 - std::exp(-depth), 1e-5), qPrintable(QString::number(p[3] - 1 + std::exp(-depth))));
}

void TestBruteForceClosedForms::aStepLiesExactlyAtItsValue() {
  // Values are red below 3.3 and blue above. The ray passes 3.3 after 3.3 + 1/2 voxels.
  const VolumePtr volume = volumeOf({10, 3, 3}, unitSteps, [](dvec3 x) { return x.x; });
  Scene scene = plainScene({1, 1, 1}, 0);
  scene.transferFunction.points = {
      {-5, {1, 0, 0}, 0.2}, {3.3f, {1, 0, 0}, 0.2}, {3.3f, {0, 0, 1}, 0.5}, {50, {0, 0, 1}, 0.5}};
  scene.camera->direction = {1, 0, 0};
  const std::vector<double> p = onePixel(bruteForceLimit(scene, *volume, {1, 1}));
  const double behind = std::pow(0.8, double(3.3f) + 0.5);
  QVERIFY(near(p[0], 1 - behind, 1e-6));
  QVERIFY(near(p[2], behind * (1 - std::pow(0.5, 9.5 - double(3.3f))), 1e-6));
  // If all values equal that of the step, the last point applies.
  const VolumePtr constant = volumeOf(ivec3(3), unitSteps, [](dvec3) { return 3.3f; });
  QVERIFY(near(onePixel(bruteForceLimit(scene, *constant, {1, 1}))[2], 1 - 0.125, 1e-6));
}

void TestBruteForceClosedForms::projectionsOfARamp_data() {
  QTest::addColumn<Mode>("mode");
  QTest::addColumn<double>("value");
  QTest::newRow("largest") << Mode::mip << 7.0;
  QTest::newRow("smallest") << Mode::minip << 0.0;
  QTest::newRow("average") << Mode::average << 3.5;
}

void TestBruteForceClosedForms::projectionsOfARamp() {
  QFETCH(Mode, mode);
  QFETCH(double, value);
  const VolumePtr volume = volumeOf({8, 3, 3}, unitSteps, [](dvec3 x) { return x.x; });
  Scene scene = plainScene({1, 1, 1}, 0);
  scene.mode = mode;
  scene.window = Window{5, 20};
  scene.camera->direction = {1, 0, 0};
  const std::vector<double> p = onePixel(bruteForceLimit(scene, *volume, {1, 1}));
  QVERIFY(near(p[0], (value + 5) / 20, 1e-6) && near(p[3], 1, 0));
}

void TestBruteForceClosedForms::theMidpointRuleSamplesTheMiddles() {
  // Ten voxels of 2 mm in steps of 3 voxels have middles at 1, 4, 7, 9. The last interval is 1 voxel long.
  const VolumePtr volume = volumeOf({10, 3, 3}, dmat3(2), [](dvec3 x) { return x.x * x.x; });
  Scene scene = plainScene({1, 1, 1}, 0);
  scene.mode = Mode::average;
  scene.window = Window{50, 100};
  scene.camera->direction = {1, 0, 0};
  const double average = (3 * (1 + 16 + 49) + 81) / 10.0;
  QVERIFY(near(onePixel(bruteForce(scene, *volume, {1, 1}, 3))[0], average / 100, 1e-6));
  scene.mode = Mode::minip;
  QVERIFY(near(onePixel(bruteForce(scene, *volume, {1, 1}, 3))[0], 0.01, 1e-6));
  scene.mode = Mode::composite;
  scene.transferFunction.points = {{0, {1, 1, 1}, 0}, {100, {1, 1, 1}, 0.5}};
  double transmittance = std::pow(1 - 81 / 200.0, 2);
  for (double v : {1, 16, 49}) transmittance *= std::pow(1 - v / 200, 6);
  QVERIFY(near(onePixel(bruteForce(scene, *volume, {1, 1}, 3))[3], 1 - transmittance, 1e-6));
}

void TestBruteForceClosedForms::backgroundIsBehind() {
  const VolumePtr volume = volumeOf(ivec3(4), unitSteps, [](dvec3) { return 0; });
  Scene scene = plainScene({1, 0, 0}, 0.5);
  scene.background = {false, {0.25, 0.5, 1}};
  scene.camera->height = 12;  // three pixels, of which the volume fills the middle one
  const Picture picture = bruteForceLimit(scene, *volume, {3, 3});
  for (int c = 0; c < 3; ++c) {
    QVERIFY(near(pixel(picture, 0, 1, c), scene.background.colour[c], 1e-7));
    QVERIFY(near(pixel(picture, 1, 1, c), (c == 0) * 0.9375 + 0.0625 * scene.background.colour[c], 1e-6));
  }
  QCOMPARE(pixel(picture, 0, 0, 3), 1.0);
  QCOMPARE(pixel(picture, 1, 1, 3), 1.0);
  scene.background.transparent = true;
  const Picture transparent = bruteForceLimit(scene, *volume, {3, 3});
  QCOMPARE(pixel(transparent, 0, 1, 3), 0.0);
  QCOMPARE(pixel(transparent, 0, 1, 2), 0.0);
  QVERIFY(near(pixel(transparent, 1, 1, 3), 0.9375, 1e-6));
}

void TestBruteForceClosedForms::defaultsComeFromTheVolume() {
  // 2000 voxels have values 0 .. 1999, so that the ranks are 2 and 1998. The box has 20 x 20 x 5 voxels of 2
  // x 1 x 8 mm.
  const VolumePtr volume = volumeOf({20, 20, 5}, dmat3({2, 0, 0}, {0, 1, 0}, {0, 0, 8}),
                                    [](dvec3 x) { return x.x + 20 * x.y + 400 * x.z; });
  const Scene scene = completed(Scene{}, *volume, {200, 100});
  QCOMPARE(*scene.shading.gradientFloor, (1997.0 - 1.0) / 32 / std::cbrt(16.0));
  QCOMPARE(scene.window->centre, 999.0);
  QCOMPARE(scene.window->width, 1996.0);
  QCOMPARE(scene.camera->height, 40.0);
  QVERIFY(glm::length(*scene.camera->target) < 1e-12);
  QCOMPARE(completed(Scene{}, *volume, {50, 100}).camera->height, 80.0);
  // 27 voxels have values 0 .. 26, so that the ranks are ceil(0.027) and ceil(26.973).
  const VolumePtr small = volumeOf(ivec3(3), unitSteps, [](dvec3 x) { return x.x + 3 * x.y + 9 * x.z; });
  QCOMPARE(*completed(Scene{}, *small, {9, 9}).shading.gradientFloor, 26.0 / 32);
}

VOLUMEN_TEST(TestBruteForceClosedForms);
#include "tst_brute_force_closed_forms.moc"
