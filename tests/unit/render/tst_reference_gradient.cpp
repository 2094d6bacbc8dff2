// Guards picture.md 3 and 4 (Sobel, gradient opacity) for the reference renderer, by closed forms.
#include "tests/unit/render/reference_fixture.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestReferenceGradient : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void gradientOpacityScalesTheOpacity_data();
  void gradientOpacityScalesTheOpacity();
  void sobelSmoothsAcrossItsAxis_data();
  void sobelSmoothsAcrossItsAxis();
  void sobelClampsAtTheBorder();
  void singleVoxelHasNoGradient();
};

void TestReferenceGradient::gradientOpacityScalesTheOpacity_data() {
  QTest::addColumn<QList<double>>("points");  // gradient, factor, ...
  QTest::addColumn<double>("depthPerMu");     // over 8 mm with |g| = |x|, -4 .. 4, at small opacity
  QTest::newRow("constant") << QList<double>{0, 0.25} << 2.0;
  QTest::newRow("linear") << QList<double>{0, 0, 4, 1} << 4.0;
  QTest::newRow("kink") << QList<double>{1.3, 0, 2.3, 1} << 2 * (0.5 + 1.7);
  QTest::newRow("step, holds at its place and above")
      << QList<double>{1.3, 0.1, 1.3, 0.9} << 2 * (0.13 + 0.9 * 2.7);
}

void TestReferenceGradient::gradientOpacityScalesTheOpacity() {
  QFETCH(QList<double>, points);
  QFETCH(double, depthPerMu);
  // The opacity is so small that -ln(1 - opacity x factor) is opacity x factor to a relative 1e-4.
  Parabola p = parabola(1e-4, 1, 0);
  for (int n = 0; n < points.size(); n += 2)
    p.scene.transferFunction.gradientOpacity.push_back({points[n], points[n + 1]});
  for (bool lit : {false, true}) {
    p.scene.shading.lit = lit;
    COMPARE_WITHIN(onePixel(p.scene, *p.volume).a, -std::expm1(-1e-4 * depthPerMu), 1e-7);
  }
  // If the factor is constant, the closed form holds for any opacity.
  if (points.size() == 2) {
    p.scene.transferFunction.points[0].opacity = 0.9;
    COMPARE_WITHIN(onePixel(p.scene, *p.volume).a, 1 - std::pow(1 - 0.9 * 0.25, 8), 2e-7);
  }
}

void TestReferenceGradient::sobelSmoothsAcrossItsAxis_data() {
  QTest::addColumn<int>("axis");
  for (int axis = 0; axis < 3; ++axis) QTest::addRow("along %c", 'i' + axis) << axis;
}

void TestReferenceGradient::sobelSmoothsAcrossItsAxis() {
  QFETCH(int, axis);
  // A ramp along one axis is present only in every second voxel of a chequerboard across it. Smoothing halves
  // the ramp.
  const VoxelGeometry geometry = gridAround({7, 7, 7});
  const auto chequered = volumeOf(geometry, [&](int i, int j, int k) {
    const int place[3] = {i, j, k};
    return ((i + j + k - place[axis]) & 1) * place[axis];
  });
  Scene scene = plainScene(0.8, {1, 0.3, -0.2});
  scene.clip = insideOf(geometry.size);
  scene.transferFunction.gradientOpacity = {{0, 0}, {1, 1}};
  const double lengthMm = 4 * glm::length(scene.camera->direction);
  COMPARE_WITHIN(onePixel(scene, *chequered).a, 1 - std::pow(1 - 0.8 * 0.5, lengthMm), 2e-7);
}

void TestReferenceGradient::sobelClampsAtTheBorder() {
  // The end voxels of a ramp have half of its slope, and so does the half-voxel border.
  const auto ramp = volumeOf(gridAround({9, 3, 3}), [](int i, int, int) { return i; });
  Scene scene = plainScene(1e-4);
  scene.transferFunction.gradientOpacity = {{0, 0}, {0.8, 0.8}, {0.8, 1}};
  // Borders have 0.5. Over the next voxel the gradient rises from 0.5 to 1: 0.6 of the voxel is below 0.8
  // with mean 0.65, and the rest counts 1. The inner 6 voxels have 1.
  const double depthPerMu = 2 * (0.5 * 0.5 + 0.6 * 0.65 + 0.4) + 6;
  COMPARE_WITHIN(onePixel(scene, *ramp).a, -std::expm1(-1e-4 * depthPerMu), 1e-7);
}

void TestReferenceGradient::singleVoxelHasNoGradient() {
  Scene scene = plainScene(0.5);
  scene.shading = {true, 2, false, 1e-6, 0.2, 0.7, 0.2, 20};
  const glm::dvec4 pixel = onePixel(scene, *homogeneous(gridAround({1, 1, 1}), 1000));
  COMPARE_WITHIN(pixel.r, 0.5 * 0.55, 1e-6);
}

VOLUMEN_TEST(TestReferenceGradient);
#include "tst_reference_gradient.moc"
