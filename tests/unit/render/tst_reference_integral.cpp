// Guards picture.md 2, 4, 6 (integral, classification, projections, background) and design.md 2 (reference,
// finite, determinism) for the reference renderer, by closed forms.
#include "tests/unit/render/reference_fixture.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestReferenceIntegral : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void homogeneousCubeHasClosedForm_data();
  void homogeneousCubeHasClosedForm();
  void linearOpacityOverARamp_data();
  void linearOpacityOverARamp();
  void linearColourOverARamp_data();
  void linearColourOverARamp();
  void stepLiesExactlyAtItsValue_data();
  void stepLiesExactlyAtItsValue();
  void stepOnTheValueOfAConstantRegion_data();
  void stepOnTheValueOfAConstantRegion();
  void densePeakThinnerThanAThousandthOfAVoxel();
  void slabsAreComposedFrontToBack_data();
  void slabsAreComposedFrontToBack();
  void backgroundShowsThrough();
  void projections_data();
  void projections();
  void projectionOfAnEmptyIntervalIsBackground();
};

void TestReferenceIntegral::homogeneousCubeHasClosedForm_data() {
  QTest::addColumn<double>("opacity");
  QTest::addColumn<double>("unitMm");
  for (double opacity : {0.0, 1e-7, 1e-3, 0.01, 0.5, 0.999, 1.0})
    for (double unitMm : {0.3, 1.0, 200.0})
      QTest::addRow("opacity %g per %g mm", opacity, unitMm) << opacity << unitMm;
}

void TestReferenceIntegral::homogeneousCubeHasClosedForm() {
  QFETCH(double, opacity);
  QFETCH(double, unitMm);
  const auto cube = homogeneous(gridAround(glm::ivec3(10)));
  Scene scene = plainScene(opacity, {1, 2, 0.5});
  scene.transferFunction.unitDistance = unitMm;
  const double lengthMm = 10 * glm::length(glm::dvec3(1, 2, 0.5)) / 2;  // the ray leaves through the j faces
  const double alpha = -std::expm1(-extinction(std::min(opacity, 1 - std::exp2(-20))) / unitMm * lengthMm);
  const glm::dvec4 pixel = onePixel(scene, *cube);
  // The bound is relative, so that tiny opacities count. The reference stops at a transmittance of 1e-6.
  const double bound = 1.1e-6 * alpha;
  COMPARE_WITHIN(pixel.a, alpha, bound);
  COMPARE_WITHIN(pixel.r, alpha, bound);
  COMPARE_WITHIN(pixel.g, 0.5 * alpha, bound);
}

void TestReferenceIntegral::linearOpacityOverARamp_data() {
  QTest::addColumn<double>("top");
  QTest::addColumn<double>("unitMm");
  for (double top : {1e-6, 0.02, 0.8, 0.999})
    for (double unitMm : {0.01, 1.0, 50.0}) QTest::addRow("to %g per %g mm", top, unitMm) << top << unitMm;
}

void TestReferenceIntegral::linearOpacityOverARamp() {
  QFETCH(double, top);
  QFETCH(double, unitMm);
  const auto ramp = volumeOf(gridAround({9, 3, 3}), [](int i, int, int) { return i; });
  Scene scene = plainScene(0);
  scene.transferFunction.points = {{0, glm::dvec3(1), 0}, {8, glm::dvec3(1), top}};
  scene.transferFunction.unitDistance = unitMm;
  // -ln(1 - k x) has the integral (1 - k x) ln(1 - k x) / k + x. The last half voxel is constant.
  const double k = top / 8;
  const double depth = ((1 - top) * std::log1p(-top) / k + 8 - 0.5 * std::log1p(-top)) / unitMm;
  COMPARE_WITHIN(onePixel(scene, *ramp).a, -std::expm1(-depth), referenceBound / 10);
}

void TestReferenceIntegral::linearColourOverARamp_data() {
  QTest::addColumn<double>("unitMm");
  for (double unitMm : {100.0, 1.0, 0.01, 1e-5}) QTest::addRow("0.2 per %g mm", unitMm) << unitMm;
}

void TestReferenceIntegral::linearColourOverARamp() {
  QFETCH(double, unitMm);
  const auto ramp = volumeOf(gridAround({9, 3, 3}), [](int i, int, int) { return i; });
  Scene scene = plainScene(0);
  const double opacity = 0.2, mu = extinction(opacity) / unitMm;
  scene.transferFunction.unitDistance = unitMm;
  scene.clip.boxLow.x = 0.5 / 9;  // from the first voxel on
  scene.transferFunction.points = {{0, {0, 1, 1}, opacity}, {8, {1, 1, 0}, opacity}};
  const double red = attenuatedLine(0, 1.0 / 8, mu, 8) + std::exp(-8 * mu) * -std::expm1(-mu / 2);
  const glm::dvec4 pixel = onePixel(scene, *ramp);
  COMPARE_WITHIN(pixel.r, red, referenceBound);
  COMPARE_WITHIN(pixel.r + pixel.b, pixel.a, referenceBound);
}

void TestReferenceIntegral::stepLiesExactlyAtItsValue_data() {
  QTest::addColumn<double>("step");
  QTest::addColumn<glm::dvec3>("direction");
  for (double step : {0.001, 4.0, 4.3, 7.999})
    for (double back : {1.0, -1.0}) {
      QTest::addRow("at %g, dir %g along the ramp", step, back) << step << glm::dvec3(back, 0, 0);
      QTest::addRow("at %g, dir %g aslant", step, back) << step << back * glm::dvec3(1, 0.11, 0.07);
    }
}

void TestReferenceIntegral::stepLiesExactlyAtItsValue() {
  QFETCH(double, step);
  QFETCH(glm::dvec3, direction);
  const auto ramp = volumeOf(gridAround({9, 3, 3}), [](int i, int, int) { return i; });
  Scene scene = plainScene(0, direction);
  const float at = float(step);
  scene.transferFunction.points = {{at, glm::dvec3(1), 0}, {at, glm::dvec3(1), 0.5}};
  const double lengthMm = (8.5 - double(at)) * glm::length(direction) / std::abs(direction.x);
  // The picture's float32 rounds by 6e-8.
  COMPARE_WITHIN(onePixel(scene, *ramp).a, 1 - std::pow(0.5, lengthMm), 2e-7);
}

void TestReferenceIntegral::stepOnTheValueOfAConstantRegion_data() {
  QTest::addColumn<float>("value");
  QTest::addColumn<glm::dvec3>("direction");
  for (float value : {7.0f, 0.1f, -1000.7f, 1e30f})
    for (const glm::dvec3& d : {glm::dvec3(1, 0, 0), glm::dvec3(1, 0.37, -0.21)})
      QTest::addRow("value %g, direction %g", double(value), d.y) << value << d;
}

void TestReferenceIntegral::stepOnTheValueOfAConstantRegion() {
  QFETCH(float, value);
  QFETCH(glm::dvec3, direction);
  const auto cube = homogeneous(gridAround(glm::ivec3(9)), value);
  Scene scene = plainScene(0, direction);
  const glm::dvec3 below(1, 0, 0), between(0, 1, 0), above(0, 0, 1);
  scene.transferFunction.points = {{value, below, 0.9}, {value, between, 0.8}, {value, above, 0.5}};
  scene.camera->height = 3;
  const double alpha = 1 - std::pow(0.5, 9 * glm::length(direction));
  const Picture picture = drawn(scene, *cube, {9, 9});
  for (std::size_t n = 0; n < picture.rgba.size(); n += 4) {
    QCOMPARE(picture.rgba[n], 0.0f);
    QCOMPARE(picture.rgba[n + 1], 0.0f);
    COMPARE_WITHIN(picture.rgba[n + 3], alpha, 2e-6);
  }
}

void TestReferenceIntegral::densePeakThinnerThanAThousandthOfAVoxel() {
  const auto ramp = volumeOf(gridAround({9, 3, 3}), [](int i, int, int) { return i; });
  Scene scene = plainScene(0);
  const float low = 3.3f, high = 3.3005f;
  scene.transferFunction.unitDistance = 1e-4;
  scene.transferFunction.points = {{low, glm::dvec3(1), 0},
                                   {low, glm::dvec3(1), 0.3},
                                   {high, glm::dvec3(1), 0.3},
                                   {high, glm::dvec3(1), 0}};
  const double lengthMm = double(high) - double(low);
  COMPARE_WITHIN(onePixel(scene, *ramp).a, 1 - std::pow(0.7, lengthMm / 1e-4), 2e-7);
}

void TestReferenceIntegral::slabsAreComposedFrontToBack_data() {
  QTest::addColumn<double>("along");
  QTest::newRow("red in front") << 1.0;
  QTest::newRow("blue in front") << -1.0;
}

void TestReferenceIntegral::slabsAreComposedFrontToBack() {
  QFETCH(double, along);
  const auto halves = volumeOf(gridAround({8, 2, 2}), [](int i, int, int) { return i < 4 ? 0 : 100; });
  Scene scene = plainScene(0, {along, 0, 0});
  scene.transferFunction.points = {{50, {1, 0, 0}, 0.1}, {50, {0, 0, 1}, 0.2}};
  const double red = 1 - std::pow(0.9, 4), blue = 1 - std::pow(0.8, 4);
  const glm::dvec4 pixel = onePixel(scene, *halves);
  COMPARE_WITHIN(pixel.r, along > 0 ? red : (1 - blue) * red, 2e-7);
  COMPARE_WITHIN(pixel.b, along > 0 ? (1 - red) * blue : blue, 2e-7);
  COMPARE_WITHIN(pixel.a, 1 - (1 - red) * (1 - blue), 2e-7);
}

void TestReferenceIntegral::backgroundShowsThrough() {
  const auto cube = homogeneous(gridAround(glm::ivec3(3)));
  Scene scene = plainScene(0.5);
  scene.background = {false, {0.2, 0.4, 1}};
  const double alpha = 1 - 0.125;
  const Picture picture = drawn(scene, *cube);
  QVERIFY(!picture.transparent);
  COMPARE_WITHIN(picture.rgba[0], alpha * 1 + 0.125 * 0.2, 2e-7);
  COMPARE_WITHIN(picture.rgba[1], alpha * 0.5 + 0.125 * 0.4, 2e-7);
  COMPARE_WITHIN(picture.rgba[2], alpha * 0.25 + 0.125 * 1, 2e-7);
  QCOMPARE(picture.rgba[3], 1.0f);
  scene.camera->target = glm::dvec3(0, 5, 0);
  QCOMPARE(drawn(scene, *cube).rgba, (std::vector<float>{0.2f, 0.4f, 1.0f, 1.0f}));
  scene.background.transparent = true;
  QCOMPARE(drawn(scene, *cube).rgba, std::vector<float>(4, 0.0f));
  QVERIFY(drawn(scene, *cube).transparent);
}

void TestReferenceIntegral::projections_data() {
  QTest::addColumn<Mode>("mode");
  QTest::addColumn<glm::dvec3>("direction");
  QTest::addColumn<QString>("volume");
  QTest::addColumn<double>("expected");
  const glm::dvec3 x(1, 0, 0), diagonal(1, 1, 0);
  const QString ramp = QStringLiteral("ramp"), saddle = QStringLiteral("saddle");
  QTest::newRow("mip of a ramp") << Mode::mip << x << ramp << 8.0;
  QTest::newRow("minip of a ramp") << Mode::minip << -x << ramp << 0.0;
  QTest::newRow("average of a ramp") << Mode::average << x << ramp << 4.0;
  // 2 s (1 - s) from corner to corner, between two constant halves of 0.
  QTest::newRow("mip inside a cell") << Mode::mip << diagonal << saddle << 0.5;
  QTest::newRow("minip at the corners") << Mode::minip << diagonal << saddle << 0.0;
  QTest::newRow("average of a parabola") << Mode::average << diagonal << saddle << 1.0 / 6;
  // 1 - 2 s (1 - s) along the other diagonal.
  QTest::newRow("minip inside a cell") << Mode::minip << glm::dvec3(1, -1, 0) << saddle << 0.5;
}

void TestReferenceIntegral::projections() {
  QFETCH(Mode, mode);
  QFETCH(glm::dvec3, direction);
  QFETCH(QString, volume);
  QFETCH(double, expected);
  const auto shown = volume == QLatin1String("ramp")
                         ? volumeOf(gridAround({9, 3, 3}), [](int i, int, int) { return i; })
                         : volumeOf(gridAround({2, 2, 2}), [](int i, int j, int) { return i != j; });
  Scene scene = plainScene(0, direction);
  scene.mode = mode;
  scene.window = Window{5, 20};  // -5 .. 15
  const glm::dvec4 pixel = onePixel(scene, *shown);
  COMPARE_WITHIN(pixel.r, (expected + 5) / 20, 2e-7);
  QCOMPARE(pixel.g, pixel.r);
  QCOMPARE(pixel.a, 1.0);
  scene.window = Window{expected, 1e-6};
  COMPARE_WITHIN(onePixel(scene, *shown).r, 0.5, 1e-6);
}

void TestReferenceIntegral::projectionOfAnEmptyIntervalIsBackground() {
  const auto cube = homogeneous(gridAround(glm::ivec3(3)), 100);
  Scene scene = plainScene(0);
  scene.mode = Mode::mip;
  scene.camera->target = glm::dvec3(0, 2, 0);
  QCOMPARE(drawn(scene, *cube).rgba, std::vector<float>(4, 0.0f));
  scene.background = {false, {0.25, 0.5, 0.75}};
  QCOMPARE(drawn(scene, *cube).rgba, (std::vector<float>{0.25f, 0.5f, 0.75f, 1.0f}));
}

VOLUMEN_TEST(TestReferenceIntegral);
#include "tst_reference_integral.moc"
