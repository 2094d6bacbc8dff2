// Guards that every act on segments, in slices of any plane, in 3D and in the panel, is one undo step. Random
// sequences of real events are undone and redone exactly.
#include "tests/fixtures/seeds.h"
#include "tests/ui/segment_sequence.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentSequences : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void allIsUndoneAndDoneAgain_data();
  void allIsUndoneAndDoneAgain();
};

void TestSegmentSequences::allIsUndoneAndDoneAgain_data() {
  QTest::addColumn<int>("seed");
  const Seeds seeds = seedsOf(4, 12);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) QTest::addRow("seed %d", seed) << seed;
}

// Does 200 acts with VOLUMEN_THOROUGH.
void TestSegmentSequences::allIsUndoneAndDoneAgain() {
  QFETCH(int, seed);
  const int acts = isThorough() ? 200 : 40;
  SegmentSequence w(seed);
  QCOMPARE(w.count(), std::size_t(2));
  for (int n = 0; n < acts; ++n) {
    const QString wrong = w.act();
    QVERIFY2(wrong.isEmpty(), qPrintable(QStringLiteral("%1, %2").arg(n).arg(wrong)));
  }
  QVERIFY2(w.states() > std::size_t(acts) / 4, qPrintable(QString::number(w.states())));
  const QString wrong = w.wrongUndone();
  QVERIFY2(wrong.isEmpty(), qPrintable(wrong));
}

VOLUMEN_TEST(TestSegmentSequences);
#include "tst_segment_sequences.moc"
