// Guards design.md 6 (plots that a person likes to read): round ticks, labels that do not collide.
#include <cmath>

#include "results/plots/axis.h"
#include "results/plots/chart.h"
#include "results/plots/labels.h"
#include "tests/unit/suite.h"

using namespace volumen;

class TestPlots : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void ticksAreRoundAndInside_data();
  void ticksAreRoundAndInside();
  void axesMapTheirEnds();
  void labelsTouchNothing();
  void aLabelWithoutRoomIsLeftOut();
  void aSpanHoldsEveryPoint_data();
  void aSpanHoldsEveryPoint();
};

void TestPlots::ticksAreRoundAndInside_data() {
  QTest::addColumn<double>("low");
  QTest::addColumn<double>("high");
  QTest::addColumn<bool>("logarithmic");
  QTest::addColumn<bool>("whole");
  QTest::addColumn<QString>("labels");
  QTest::newRow("two decades: 1, 2, 5") << 0.9 << 60. << true << false << "1 2 5 10 20 50";
  QTest::newRow("six decades: the decades") << 0.002 << 3000. << true << false << "0.01 0.1 1 10 100 1000";
  QTest::newRow("linear") << 0. << 11.2 << false << false << "0 2 4 6 8 10";
  QTest::newRow("linear, small") << 0. << 1.2 << false << false << "0 0.2 0.4 0.6 0.8 1 1.2";
  QTest::newRow("whole numbers") << 0. << 2.16 << false << true << "0 1 2";
}

void TestPlots::ticksAreRoundAndInside() {
  QFETCH(double, low);
  QFETCH(double, high);
  QFETCH(bool, logarithmic);
  QFETCH(bool, whole);
  QFETCH(QString, labels);
  QStringList found;
  for (const Tick& t : ticksOf({low, high, 0, 100, logarithmic, whole})) {
    QVERIFY(t.value >= low * 0.999 && t.value <= high * 1.001);
    if (t.labelled) found << tickText(t.value);
  }
  QCOMPARE(found.join(QLatin1Char(' ')), labels);
}

void TestPlots::axesMapTheirEnds() {
  const Axis rising{0.01, 100, 50, 450, true}, falling{0, 8, 400, 100, false};
  QCOMPARE(rising.pixelOf(0.01), 50.);
  QVERIFY(std::abs(rising.pixelOf(1) - 250) < 1e-9);  // half of the decades
  QCOMPARE(rising.pixelOf(100), 450.);
  QCOMPARE(falling.pixelOf(2), 325.);
}

void TestPlots::labelsTouchNothing() {
  const QRectF area(0, 0, 400, 300);
  LabelPlaces places(area);
  std::vector<QRectF> taken;
  for (int n = 0; n < 40; ++n) {
    const QPointF point(40 + n * 37 % 320, 30 + n * 53 % 240);
    taken.push_back(QRectF(point - QPointF(4, 4), QSizeF(8, 8)));
    places.take(taken.back());
  }
  int placed = 0;
  for (std::size_t n = 0; n < 40; ++n) {
    const auto place = places.place(taken[n].center(), {60, 14});
    if (!place) continue;
    ++placed;
    QVERIFY(area.contains(*place));
    for (const QRectF& other : taken) QVERIFY(!place->intersects(other));
    taken.push_back(*place);
  }
  QVERIFY2(placed > 20, qPrintable(QString::number(placed)));
}

void TestPlots::aLabelWithoutRoomIsLeftOut() {
  LabelPlaces places(QRectF(0, 0, 50, 50));
  QVERIFY(!places.place({25, 25}, {60, 10}));
  QVERIFY(places.place({25, 25}, {12, 10}));
}

void TestPlots::aSpanHoldsEveryPoint_data() {
  QTest::addColumn<bool>("logarithmic");
  QTest::newRow("logarithmic") << true;
  QTest::newRow("linear, from 0") << false;
}

void TestPlots::aSpanHoldsEveryPoint() {
  QFETCH(bool, logarithmic);
  Chart chart;
  chart.logarithmic = logarithmic;
  chart.series = {{{}, {}, false, false, {{3, 0.02, {}, false}, {800, 5, {}, false}, {20, 0.3, {}, false}}}};
  const QRectF span = spanOf(chart);
  for (const ChartPoint& p : chart.series[0].points) QVERIFY(span.contains(p.x, p.y));
  QVERIFY(logarithmic ? span.left() > 0 && span.top() > 0 : span.topLeft() == QPointF(0, 0));
  chart.series[0].points.resize(1);  // a single point still has some space around it
  QVERIFY(spanOf(chart).width() > 0 && spanOf(chart).height() > 0);
}

VOLUMEN_TEST(TestPlots);
#include "tst_plots.moc"
