// Guards picture.md 4, 9: the opacity of an interval by a short series equals the closed form.
#include <cmath>

#include "tests/unit/suite.h"
#include "viewer/tables/opacity_correction.h"

using namespace volumen;

class TestOpacityCorrection : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void isThePower_data();
  void isThePower();
  void noneWhereThereIsNothing();
};

void TestOpacityCorrection::isThePower_data() {
  QTest::addColumn<float>("unitDistances");
  QTest::addColumn<double>("most");
  QTest::addColumn<double>("leastReach");
  const auto row = [](const char* name, float unitDistances, double most, double leastReach) {
    QTest::newRow(name) << unitDistances << most << leastReach;
  };
  row("a faint curve", 0.5f, 0.01, 0.01);
  row("a translucent curve", 0.4f, 0.2, 0.2);
  row("an opaque curve", 0.4f, 1, 0.5);
  row("a hundredth of a unit", 0.01f, 1, 0.5);
  row("a unit", 1, 1, 0.5);
  row("three halves of a unit", 1.5f, 1, 0.25);
  row("ten unitDistances", 10, 1, 0.03);
}

void TestOpacityCorrection::isThePower() {
  QFETCH(float, unitDistances);
  QFETCH(double, most);
  QFETCH(double, leastReach);
  const CorrectionSeries s = makeCorrectionSeries(unitDistances, most);
  QCOMPARE(s.unitDistances, unitDistances);
  QVERIFY(s.most >= float(leastReach) && s.most <= float(most));
  QVERIFY(s.terms > 0 && s.terms <= CorrectionSeries::mostTerms);
  for (int n = 1; n <= 1000; ++n) {
    const float x = s.most * float(n) / 1000;
    float sum = 0;
    for (int k = s.terms - 1; k >= 0; --k) sum = sum * x + s.c[k];
    const double power = -std::expm1(double(unitDistances) * std::log1p(-double(x)));
    // The series is exact to 3e-8. Float rounding (6e-8 each) affects terms up to three times the sum.
    QVERIFY2(std::abs(double(sum * x) / power - 1) < 6e-7, qPrintable(QString::number(double(x))));
  }
}

void TestOpacityCorrection::noneWhereThereIsNothing() {
  QCOMPARE(makeCorrectionSeries(0, 1).terms, 0);
  QCOMPARE(makeCorrectionSeries(1, 0).terms, 0);
}

VOLUMEN_TEST(TestOpacityCorrection);
#include "tst_opacity_correction.moc"
