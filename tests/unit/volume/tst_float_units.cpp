// Guards design.md 2 (finite) beyond single precision: values and gradients in units.
#include <cmath>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/volume/float_units.h"
#include "viewer/volume/gradients.h"

using namespace volumen;
using namespace volumen::tests;

class TestFloatUnits : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void keepValuesAndTheirOrder_data() { addRanges(); }
  void keepValuesAndTheirOrder();
  void keepGradients_data() { addRanges(); }
  void keepGradients();
  void leaveOrdinaryValuesAlone();
  void oneValueIsCountedFromItself();

 private:
  static void addRanges();
};

void TestFloatUnits::addRanges() {
  QTest::addColumn<double>("low");
  QTest::addColumn<double>("high");
  QTest::newRow("denormal") << 0.0 << 1e-42;
  QTest::newRow("next to nothing") << -1e-36 << 1e-36;
  QTest::newRow("ordinary") << -1000.0 << 3000.0;
  QTest::newRow("far from 0") << 99999.5 << 100000.5;
  QTest::newRow("far below 0") << -5000.25 << -5000.0;
  QTest::newRow("enormous") << -1e30 << 1e30;
}

// Values must be exact, so that a curve's step at a value is a step at its number.
void TestFloatUnits::keepValuesAndTheirOrder() {
  QFETCH(double, low);
  QFETCH(double, high);
  const VolumePtr v = randomVolume<float>({9, 8, 7}, low, high);
  const FloatUnits units = floatUnits(valueRange(*v));
  for (float value : std::get<std::vector<float>>(v->stored())) {
    const float number = inUnits(value, units);
    QCOMPARE(float(units.slope * number + units.intercept), value);
    QVERIFY(std::abs(number) < 0x1p61f);
    QVERIFY(number == 0 || std::abs(number) > 1e-30f);
  }
}

void TestFloatUnits::keepGradients() {
  QFETCH(double, low);
  QFETCH(double, high);
  const VolumePtr v = randomVolume<float>({9, 8, 7}, low, high);
  const Gradients32 g = sobel32(*v);
  std::size_t n = 0;
  for (int k = 0; k < 7; ++k)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 9; ++i, n += 4)
        for (int a = 0; a < 3; ++a) {
          const double expected = sobelAt(*v, i, j, k)[a], found = g.scale * g.xyz0[n + a];
          QVERIFY2(std::abs(found - expected) <= 1e-6 * (high - low), qPrintable(QString::number(found)));
        }
}

void TestFloatUnits::leaveOrdinaryValuesAlone() {
  for (const ValueRange range : {ValueRange{-1024, 3071}, {0, 1}, {0, 0}, {15, 16}, {-1e-10, 1e10}})
    QVERIFY(floatUnits(range) == FloatUnits());
}

// A range of a single value is represented without rounding.
void TestFloatUnits::oneValueIsCountedFromItself() {
  QCOMPARE(inUnits(0.3f, floatUnits({0.3f, 0.3f})), 0.0f);
}

VOLUMEN_TEST(TestFloatUnits);
#include "tst_float_units.moc"
