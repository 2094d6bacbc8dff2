// Guards the option "gradient operator" of design.md 6: central differences, Sobel, Zucker-Hummel.
#include <algorithm>
#include <cmath>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/volume/gradients.h"
#include "viewer/volume/histogram.h"

using namespace volumen;
using namespace volumen::tests;

class TestGradientOperators : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void equalTheirDefinition_data();
  void equalTheirDefinition();
};

namespace {

// Returns the sum over the 26 neighbours of value * direction / distance^power, divided by that of a ramp of
// slope 1.
glm::dvec3 defined(const Volume& v, GradientOperator by, glm::ivec3 at) {
  glm::dvec3 sum(0);
  double ramp = 0;
  for (int n = 0; n < 27; ++n) {
    const glm::ivec3 d(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
    const int off = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);  // distance^2
    double weight = 0;
    if (off > 0 && by == GradientOperator::zuckerHummel) weight = 1 / std::sqrt(double(off));
    if (off > 0 && by == GradientOperator::sobel) weight = 4.0 / (1 << (off - 1));
    if (off == 1 && by == GradientOperator::central) weight = 1;
    const glm::ivec3 p = glm::clamp(at + d, glm::ivec3(0), v.size() - 1);
    sum += weight * double(v.value(p.x, p.y, p.z)) * glm::dvec3(d);
    ramp += weight * double(d.x * d.x);
  }
  return sum / ramp;
}

}  // namespace

void TestGradientOperators::equalTheirDefinition_data() {
  QTest::addColumn<int>("by");
  QTest::addColumn<bool>("floats");
  QTest::addColumn<int>("nx");
  const std::pair<const char*, GradientOperator> all[] = {{"Sobel", GradientOperator::sobel},
                                                          {"central", GradientOperator::central},
                                                          {"Zucker-Hummel", GradientOperator::zuckerHummel}};
  for (const auto& [name, by] : all)
    for (const bool floats : {false, true})
      for (const int nx : {1, 2, 19, 256})
        QTest::addRow("%s, %s, %d wide", name, floats ? "floats" : "integers", nx) << int(by) << floats << nx;
}

void TestGradientOperators::equalTheirDefinition() {
  QFETCH(int, by);
  QFETCH(bool, floats);
  QFETCH(int, nx);
  const auto op = GradientOperator(by);
  const glm::ivec3 size(nx, 5, 4);
  const VolumePtr v =
      floats ? randomVolume<float>(size, -1, 1) : randomVolume<std::uint16_t>(size, 0, 65535, 0.5);
  const Gradients32 g32 = gradients32By(*v, op);
  const Gradients16 g16 = floats ? Gradients16{} : gradients16By(*v, op);
  const ValueRange range = valueRange(*v);
  std::size_t n = 0;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i, n += 4) {
        const glm::dvec3 g = defined(*v, op, {i, j, k});
        for (int a = 0; a < 3; ++a) {
          // The bound allows for float sums of 27 values of the range's size.
          QVERIFY(std::abs(g32.scale * g32.xyz0[n + a] - g[a]) <= 1e-5 * (range.high - range.low));
          if (!floats)
            QVERIFY(std::abs(g16.scale * g16.row(k * size.y + j)[4 * i + a] - g[a]) <= 0.51 * g16.scale);
        }
      }
}

VOLUMEN_TEST(TestGradientOperators);
#include "tst_gradient_operators.moc"
