// Guards design.md 2 and picture.md 3, 6, 9: on closed-form fields, every approximation converges to the
// picture at its theoretical order. Gradients have the direction of the field's.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <random>

#include "tests/unit/promises/convergence.h"
#include "tests/unit/promises/promises.h"
#include "tests/unit/suite.h"
#include "viewer/phantoms/phantoms.h"
#include "viewer/volume/gradients.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

class TestConvergence : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void stepsAreOfSecondOrder_data() { addFields(true); }
  void stepsAreOfSecondOrder();
  void gridsAreOfSecondOrder_data() { addFields(false); }
  void gridsAreOfSecondOrder();
  void pixelsAreOfSecondOrder_data() { addFields(false); }
  void pixelsAreOfSecondOrder();
  void gradientsPointOutwards_data();
  void gradientsPointOutwards();

 private:
  static void addFields(bool everyWay);
};

namespace {

QString listed(const std::vector<ErrorAt>& errors) {
  QString words;
  for (const ErrorAt& e : errors) words += QStringLiteral("%1: %2; ").arg(e.h).arg(e.error.rmse);
  return words + QStringLiteral("slope %1").arg(slopeOf(errors));
}

void print(const QString& words) {
  if (figuresWanted())
    std::fprintf(stderr, "%s %s | %s\n", QTest::currentTestFunction(), QTest::currentDataTag(),
                 qPrintable(words));
}

/// Interpolates stored gradients trilinearly at a position inside the grid.
dvec3 interpolated(const Gradients32& g, glm::ivec3 size, dvec3 pVoxel) {
  const dvec3 low = glm::floor(pVoxel), f = pVoxel - low;
  dvec3 sum(0);
  for (int c = 0; c < 8; ++c) {
    const glm::ivec3 corner = glm::ivec3(low) + glm::ivec3(c & 1, c >> 1 & 1, c >> 2);
    const double weight = (c & 1 ? f.x : 1 - f.x) * (c & 2 ? f.y : 1 - f.y) * (c & 4 ? f.z : 1 - f.z);
    const float* at = g.xyz0.data() + 4 * ((std::size_t(corner.z) * size.y + corner.y) * size.x + corner.x);
    sum += weight * dvec3(at[0], at[1], at[2]);
  }
  return sum;
}

}  // namespace

void TestConvergence::addFields(bool everyWay) {
  QTest::addColumn<int>("field");
  QTest::addColumn<bool>("lit");
  QTest::addColumn<int>("way");
  for (std::size_t f = 0; f < closedFormFields().size(); ++f)
    for (bool lit : {false, true})
      for (std::size_t way = 0; way < (everyWay ? promisedWays().size() : 1); ++way)
        QTest::addRow("%s, %s%s%s", closedFormFields()[f].name, lit ? "lit" : "unlit", everyWay ? ", " : "",
                      everyWay ? promisedWays()[way].name : "")
            << int(f) << lit << int(way);
}

#define FETCH_FIELD() \
  QFETCH(int, field); \
  QFETCH(bool, lit);  \
  QFETCH(int, way);   \
  const Field& f = closedFormFields()[std::size_t(field)]

// Steps use the midpoint rule.
void TestConvergence::stepsAreOfSecondOrder() {
  FETCH_FIELD();
  const auto errors = errorOverStep(f, lit, promisedWays()[std::size_t(way)].options);
  print(listed(errors));
  QVERIFY2(slopeOf(errors) >= 1.9, qPrintable(listed(errors)));
}

// Covers trilinear interpolation and Sobel gradients over voxels of 1/2 .. 1/8 mm. A ramp has no such error.
void TestConvergence::gridsAreOfSecondOrder() {
  FETCH_FIELD();
  Q_UNUSED(way);
  const auto errors = errorOverGrid(f, lit);
  print(listed(errors));
  if (f.name == std::string("ramp")) {
    for (const ErrorAt& e : errors) QVERIFY2(e.error.maximum <= 0.05, qPrintable(listed(errors)));
    return;
  }
  QVERIFY2(slopeOf(errors) >= 1.9, qPrintable(listed(errors)));
}

// Covers bilinear interpolation between 6 x 6 to 48 x 48 pixels, which is the same for every method. Clamping
// of lights or sides creases lit pictures. Such a line of pixels has errors of first order, which reduces the
// order of the whole to 1.5.
void TestConvergence::pixelsAreOfSecondOrder() {
  FETCH_FIELD();
  Q_UNUSED(way);
  const auto errors = errorOverPixel(f, lit, atStep(1.0 / 64));
  print(listed(errors));
  QVERIFY2(slopeOf(errors) >= (lit ? 1.5 : 1.9), qPrintable(listed(errors)));
}

void TestConvergence::gradientsPointOutwards_data() {
  QTest::addColumn<dvec3>("spacing");
  QTest::addColumn<double>("mostMean");
  QTest::addColumn<double>("mostMaximum");
  QTest::newRow("1 mm") << dvec3(1) << 1.0 << 2.5;
  QTest::newRow("0.7 x 0.7 x 2.5 mm") << dvec3(0.7, 0.7, 2.5) << 1.1 << 90.0;
}

// Compares interpolated Sobel gradients of the phantom soft-sphere with the true normal in patient space.
// Positions on its edge are random. Voxels are cubes of 1 mm or stretched, and angles are in degrees.
void TestConvergence::gradientsPointOutwards() {
  QFETCH(dvec3, spacing);
  QFETCH(double, mostMean);
  QFETCH(double, mostMaximum);
  const VolumePtr sphere = *makePhantom("soft-sphere");
  const VoxelGeometry grid{
      .size = sphere->size(),
      .patientFromVoxelStep = glm::dmat3({spacing.x, 0, 0}, {0, spacing.y, 0}, {0, 0, spacing.z})};
  const Gradients32 g = sobel32(*sphere);  // per voxel and so independent of the spacing
  std::mt19937 bits(11);
  const auto chance = [&] { return std::ldexp(double(bits()), -32); };
  double mean = 0, largest = 0;
  constexpr int count = 20000;
  for (int n = 0; n < count; ++n) {
    const double z = 2 * chance() - 1, turn = 2 * glm::pi<double>() * chance(), across = std::sqrt(1 - z * z);
    const dvec3 outwards(across * std::cos(turn), across * std::sin(turn), z);
    const dvec3 gradient = interpolated(g, grid.size, dvec3(31.8, 31.3, 31.6) + 20.0 * outwards);
    const dvec3 normal = -glm::normalize(grid.patientFromVoxelGradient() * gradient);
    const double cosine = glm::dot(normal, glm::normalize(outwards / spacing));
    const double degrees = std::acos(std::min(1.0, cosine)) * 180 / glm::pi<double>();
    mean += degrees / count;
    largest = std::max(largest, degrees);
  }
  const QString words = QStringLiteral("mean %1, maximum %2 degrees").arg(mean).arg(largest);
  print(words);
  QVERIFY2(mean <= mostMean && largest <= mostMaximum, qPrintable(words));
}

VOLUMEN_TEST(TestConvergence);
#include "tst_convergence.moc"
