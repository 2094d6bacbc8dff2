// Guards likeness() of numbers.h: Dice coefficient and surface distances against closed forms of balls.
#include <tbb/global_control.h>

#include <cmath>

#include "tests/fixtures/grids.h"
#include "tests/unit/segment/shape_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/numbers.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dmat3, glm::dvec3;

class TestLikeness : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void balls_data();
  void balls();
  void aSegmentIsLikeItself_data();
  void aSegmentIsLikeItself();
  void isTheSameBothWays();
  void ofNothing();
};

void TestLikeness::balls_data() {
  QTest::addColumn<dmat3>("step");
  QTest::addColumn<double>("radius");
  QTest::addColumn<dvec3>("moved");
  QTest::addColumn<double>("dice");
  QTest::addColumn<double>("largest");
  QTest::addColumn<double>("p95");
  QTest::addColumn<double>("mean");
  // If a ball is moved by t, its surface is off by |t cos|, uniformly distributed from 0 to t. The mean is
  // t/2, and 95 % are below .95 t. (FIELD-segment.md 3)
  for (const Grid& g : grids) {
    const dmat3& step = g.patientFromVoxelStep;
    QTest::addRow("moved by 2, %s", g.name) << step << 10.0 << dvec3(2, 0, 0) << 0.8505 << 2.0 << 1.9 << 1.0;
    QTest::addRow("moved by 5, %s", g.name)
        << step << 10.0 << 5.0 * glm::normalize(dvec3(1, -2, 2)) << 0.63281 << 5.0 << 4.75 << 2.5;
    QTest::addRow("in a larger one, %s", g.name) << step << 11.0 << dvec3(0) << 0.858 << 1.0 << 1.0 << 1.0;
  }
}

// The first ball has 10 mm. A voxel surface crosses an edge of the grid at most half an edge from the ball,
// and mostly much nearer. The errors of both surfaces add up.
void TestLikeness::balls() {
  QFETCH(dmat3, step);
  QFETCH(double, radius);
  QFETCH(dvec3, moved);
  QFETCH(double, dice);
  QFETCH(double, largest);
  QFETCH(double, p95);
  QFETCH(double, mean);
  const VoxelGeometry grid = gridAbout(step, 17);
  const double coarse = std::max({grid.spacing().x, grid.spacing().y, grid.spacing().z});
  const auto alike = likeness(maskOfShape(grid, ball(10)), maskOfShape(grid, ball(radius, moved)));
  QVERIFY(alike.ok());
  QVERIFY2(std::abs(*alike->dice - dice) < 0.012, qPrintable(QString::number(*alike->dice)));
  const auto told = QStringLiteral("%1, %2, %3")
                        .arg(alike->distances->largest)
                        .arg(alike->distances->p95)
                        .arg(alike->distances->mean);
  QVERIFY2(std::abs(alike->distances->largest - largest) < 0.65 * coarse, qPrintable(told));
  QVERIFY2(std::abs(alike->distances->p95 - p95) < 0.3 * coarse, qPrintable(told));
  QVERIFY2(std::abs(alike->distances->mean - mean) < 0.06 * coarse, qPrintable(told));
  const double balls = 4.18879 * (1000 - radius * radius * radius) / 1000;
  QVERIFY2(std::abs(*alike->differenceMl - balls) < 0.06, qPrintable(QString::number(*alike->differenceMl)));
}

void TestLikeness::aSegmentIsLikeItself_data() {
  QTest::addColumn<dmat3>("step");
  QTest::addColumn<dvec3>("moved");
  for (const Grid& g : grids)
    for (const double mm : {0.0, 1000.0})
      QTest::addRow("%s, %g mm from the origin", g.name, mm) << g.patientFromVoxelStep << dvec3(mm, -mm, mm);
}

// Requires exact zeros, as users would read 5.8e-14 as a difference, whereas QCOMPARE takes it for 0.
void TestLikeness::aSegmentIsLikeItself() {
  QFETCH(dmat3, step);
  QFETCH(dvec3, moved);
  VoxelGeometry grid = gridAbout(step, 12);
  grid.origin += moved;
  const BitMask mask = maskOfShape(grid, ellipsoid({11, 5, 8}, moved));
  QVERIFY(mask.count() > 100);
  const SegmentLikeness same = *likeness(mask, mask);
  QCOMPARE(*same.dice, 1.0);
  QCOMPARE(*same.differenceMl, 0.0);
  QVERIFY(same.distances->largest == 0 && same.distances->p95 == 0 && same.distances->mean == 0);
}

void TestLikeness::isTheSameBothWays() {
  const VoxelGeometry grid = gridAbout(grids[3].patientFromVoxelStep, 14);
  const BitMask a = maskOfShape(grid, ball(9)), b = maskOfShape(grid, ellipsoid({12, 8, 9}, {1, 0, 0}));
  const SegmentLikeness there = *likeness(a, b), back = *likeness(b, a);
  QCOMPARE(*there.dice, *back.dice);
  QCOMPARE(*there.differenceMl, -*back.differenceMl);
  QCOMPARE(there.distances->largest, back.distances->largest);
  QCOMPARE(there.distances->p95, back.distances->p95);
  QVERIFY(std::abs(there.distances->mean - back.distances->mean) < 1e-12);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const SegmentLikeness again = *likeness(a, b);
  QCOMPARE(again.distances->largest, there.distances->largest);
  QCOMPARE(again.distances->p95, there.distances->p95);
  QCOMPARE(again.distances->mean, there.distances->mean);
}

void TestLikeness::ofNothing() {
  VoxelGeometry grid{.size = {9, 8, 7}};
  const BitMask none(grid);
  BitMask some(grid);
  some.set({4, 4, 4});
  QVERIFY(!likeness(none, none)->dice);
  QCOMPARE(*likeness(none, some)->dice, 0.0);
  QVERIFY(!likeness(none, some)->distances && !likeness(some, none)->distances);
  QCOMPARE(*likeness(none, some)->differenceMl, -0.001);
  grid.calibrated = false;
  BitMask nominal(grid);
  nominal.set({4, 4, 4});
  QCOMPARE(*likeness(nominal, nominal)->dice, 1.0);
  QVERIFY(!likeness(nominal, nominal)->distances);
  CancelToken cancel;
  cancel.cancel();
  QVERIFY(!likeness(some, some, cancel).ok());
}

VOLUMEN_TEST(TestLikeness);
#include "tst_likeness.moc"
