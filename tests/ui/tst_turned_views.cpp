// Guards where patient positions appear in views of slices, whatever was done before: pictures turned and
// mirrored, planes turned, linked views, fusion, time points, slabs. Also after measurements, undo, sessions
// and keys that move the focus.
// Random sequences of real events are compared with a reference model from the documents (turned_twin.h).
// VOLUMEN_RANDOM_CASES=N, VOLUMEN_RANDOM_SEED=S: N sequences, from S on.
#include "tests/fixtures/seeds.h"
#include "tests/ui/clean_settings.h"
#include "tests/ui/turned_sequence.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestTurnedViews : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void placesAppearWhereTheTwinHasThem_data();
  void placesAppearWhereTheTwinHasThem();
};

void TestTurnedViews::placesAppearWhereTheTwinHasThem_data() {
  QTest::addColumn<int>("seed");
  const Seeds seeds = seedsOf(14, 150);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) QTest::addRow("seed %d", seed) << seed;
}

void TestTurnedViews::placesAppearWhereTheTwinHasThem() {
  QFETCH(int, seed);
  const QString why = TurnedSequence(seed).wrongAfter(25);
  QVERIFY2(why.isEmpty(), qPrintable(why));
}

VOLUMEN_TEST(TestTurnedViews);
#include "tst_turned_views.moc"
