// Guards where pixels of projection images and frames appear, whatever was done before: hung by protocols,
// scrolled, played, turned and mirrored. Also after presentation states, measuring, undo, and sessions saved
// and reopened.
// Random sequences of real events are compared with a reference model from the documents (turned_frames.h).
// VOLUMEN_RANDOM_CASES=N, VOLUMEN_RANDOM_SEED=S: N sequences, from S on.
#include "tests/fixtures/seeds.h"
#include "tests/ui/clean_settings.h"
#include "tests/ui/turned_frames.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestTurnedFrames : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void pixelsAppearWhereTheTwinHasThem_data();
  void pixelsAppearWhereTheTwinHasThem();
};

void TestTurnedFrames::pixelsAppearWhereTheTwinHasThem_data() {
  QTest::addColumn<int>("seed");
  const Seeds seeds = seedsOf(10, 100);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) QTest::addRow("seed %d", seed) << seed;
}

void TestTurnedFrames::pixelsAppearWhereTheTwinHasThem() {
  QFETCH(int, seed);
  const QString why = TurnedFrames(seed).wrongAfter(25);
  QVERIFY2(why.isEmpty(), qPrintable(why));
}

VOLUMEN_TEST(TestTurnedFrames);
#include "tst_turned_frames.moc"
