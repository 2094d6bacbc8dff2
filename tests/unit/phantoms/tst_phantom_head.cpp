// Guards design.md 10 (phantom ct-head) and design.md 2 (the same bytes for any number of threads).
#include <tbb/global_control.h>

#include <cmath>
#include <map>

#include "tests/fixtures/head_facts.h"
#include "tests/unit/suite.h"
#include "viewer/phantoms/phantoms.h"

using namespace volumen;

class TestPhantomHead : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void geometryKeepsTheHeadsSize_data();
  void geometryKeepsTheHeadsSize();
  void tissuesHaveTheirValues_data();
  void tissuesHaveTheirValues();
  void noiseHasTheStatedSize();
  void sameValuesForAnyNumberOfThreads();
};

namespace {

std::string text(int size) { return std::string("ct-head:").append(std::to_string(size)); }

// Each size is made only once, as that is slow.
VolumePtr head(int size) {
  static std::map<int, VolumePtr> made;
  VolumePtr& volume = made[size];
  if (!volume) volume = *makePhantom(text(size));
  return volume;
}

}  // namespace

void TestPhantomHead::geometryKeepsTheHeadsSize_data() {
  QTest::addColumn<int>("size");
  for (int size : {2, 5, 64, 100, 256, 512, 1024}) QTest::addRow("%d", size) << size;
}

void TestPhantomHead::geometryKeepsTheHeadsSize() {
  QFETCH(int, size);
  const auto header = phantomHeader(text(size));
  const VoxelGeometry& g = header->geometry;
  QCOMPARE(g.size.x, size);
  QCOMPARE(g.size.y, size);
  QVERIFY(g.size.z >= std::ceil(size * 5 / 16.0));
  QVERIFY(glm::length(g.centre()) < 1e-9);
  QCOMPARE(g.spacing().x * size, 240.0);
  QCOMPARE(g.spacing().y * size, 240.0);
  // Slices cover the whole 260 mm, with at most one slice more.
  QVERIFY(g.spacing().z * g.size.z >= 260 && g.spacing().z * (g.size.z - 1) < 260);
  QVERIFY(g.spacing().z <= std::max(1.25, g.spacing().x) + 1e-9);
  QCOMPARE(header->valueType, std::string("int16"));
  QCOMPARE(header->modality, std::string("CT"));
}

void TestPhantomHead::tissuesHaveTheirValues_data() {
  QTest::addColumn<int>("size");
  for (int size : {64, 128}) QTest::addRow("%d", size) << size;
}

void TestPhantomHead::tissuesHaveTheirValues() {
  QFETCH(int, size);
  const VolumePtr volume = head(size);
  for (const tests::HeadFact& fact : tests::headFacts) {
    const double value = tests::valueNear(*volume, fact.pPatient);
    QVERIFY2(value >= fact.low && value <= fact.high,
             qPrintable(QString::fromLatin1("%1: %2 HU").arg(QLatin1String(fact.what)).arg(value)));
  }
}

void TestPhantomHead::noiseHasTheStatedSize() {
  const VolumePtr volume = head(128);
  // A corner of the volume holds only air.
  double sum = 0, squares = 0;
  const int edge = 20;
  for (int k = 0; k < edge; ++k)
    for (int j = 0; j < edge; ++j)
      for (int i = 0; i < edge; ++i) {
        const double v = volume->value(i, j, k);
        sum += v;
        squares += v * v;
      }
  const double n = edge * edge * edge, mean = sum / n, deviation = std::sqrt(squares / n - mean * mean);
  // From 8000 correlated samples, the deviation is known to about 2 %. Clipping at -1024 cuts off the lowest
  // 0.4 %.
  QVERIFY2(std::abs(mean + 1000) < 1, qPrintable(QString::number(mean)));
  QVERIFY2(deviation > 8 && deviation < 10, qPrintable(QString::number(deviation)));
}

void TestPhantomHead::sameValuesForAnyNumberOfThreads() {
  const auto values = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return std::get<std::vector<std::int16_t>>((*makePhantom(text(64)))->stored());
  };
  const auto one = values(1);
  QVERIFY(one == values(2));
  QVERIFY(one == values(5));
}

VOLUMEN_TEST(TestPhantomHead);
#include "tst_phantom_head.moc"
