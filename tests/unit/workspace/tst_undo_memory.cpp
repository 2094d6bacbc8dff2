// Guards design.md 11 (labels of undo steps): what they take has a limit. Old ones are packed, and give back
// the same labels. Only steps that have no room even so are dropped, and that is told.
#include <QSignalSpy>

#include "results/segments/segments.h"
#include "tests/fixtures/chance.h"
#include "tests/unit/suite.h"
#include "ui/workspace/series_segments.h"
#include "ui/workspace/session.h"

using namespace volumen;
using volumen::tests::Chance;

class TestUndoMemory : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void labelsOfOldStepsHaveALimit_data();
  void labelsOfOldStepsHaveALimit();
  void aGestureGoesOnAfterItsStepWasPacked();
};

namespace {

constexpr int edge = 64, steps = 24;
constexpr std::size_t whole = std::size_t(edge) * edge * edge;  // bytes of a map

// A session of one series with one segment, whose voxels each step changes.
struct Painted {
  Session session;
  SeriesKey key{"/data/ct", "1"};
  VoxelGeometry grid;
  std::vector<std::string> seen;  // checksums after each step

  explicit Painted(std::size_t budget) {
    session.pool().setBudget(budget);
    grid.size = glm::ivec3(edge);
    Series series;
    series.path = key.path;
    series.id = key.id;
    Workspace w;
    w.series.editOrAdd(key).series = std::make_shared<const Series>(series);
    w = withNewSegment(std::move(w), key, grid, {});
    session.open(QStringLiteral("test"), w);
    seen.push_back(checksum());
  }

  const SegmentMap& map() const { return session.workspace().segmentMaps.front(); }
  std::string checksum() const { return checksumOf(*map().labels); }

  void paint(const BitMask& mask, const QString& mergeKey = {}) {
    session.change(QStringLiteral("test"),
                   withSegmentMap(session.workspace(), withMask(map(), map().current, mask)), mergeKey);
  }
  BitMask slab(int n) const {
    BitMask mask(grid);
    for (int k = n; k < edge; k += 2)
      for (int j = 0; j < edge; ++j)
        for (int i = n; i < edge; ++i) mask.set({i, j, k});
    return mask;
  }
  BitMask noise(int n) const {
    BitMask mask(grid);
    Chance chance(unsigned(n) + 1);
    for (int k = 0; k < edge; ++k)
      for (int j = 0; j < edge; ++j)
        for (int i = 0; i < edge; ++i)
          if (chance.below(2)) mask.set({i, j, k});
    return mask;
  }
};

}  // namespace

void TestUndoMemory::labelsOfOldStepsHaveALimit_data() {
  QTest::addColumn<bool>("noise");
  QTest::addColumn<int>("maps");
  QTest::addColumn<bool>("allKept");
  QTest::newRow("slabs, room for all") << false << 4 * (steps + 2) << true;
  QTest::newRow("slabs are packed") << false << 8 << true;
  QTest::newRow("noise that is packed") << true << 4 * 6 << true;
  QTest::newRow("noise that has no room even packed") << true << 2 << false;
}

void TestUndoMemory::labelsOfOldStepsHaveALimit() {
  QFETCH(bool, noise);
  QFETCH(int, maps);
  QFETCH(bool, allKept);
  const std::size_t budget = std::size_t(maps) * whole;
  Painted p(budget);
  QSignalSpy dropped(&p.session, &Session::stepsDropped), met(&p.session, &Session::droppedStepMet);
  for (int n = 0; n < steps; ++n) {
    p.paint(noise ? p.noise(n) : p.slab(n));
    p.seen.push_back(p.checksum());
    // Beside what is shown, and the step before it.
    QVERIFY2(p.session.pool().counted() <= budget / 4 + 2 * whole,
             qPrintable(QString::number(p.session.pool().counted())));
  }
  QCOMPARE(dropped.isEmpty(), allKept);
  int gone = 0;
  for (const auto& each : dropped) gone += each[0].toInt();
  QVERIFY(gone < steps);
  QUndoStack& stack = p.session.undoStack();
  QCOMPARE(stack.count(), steps);
  for (int n = steps - 1; n >= gone; --n) {
    stack.undo();
    QCOMPARE(p.checksum(), p.seen[std::size_t(n)]);
  }
  const Workspace last = p.session.workspace();
  QVERIFY(met.isEmpty());
  while (stack.canUndo()) stack.undo();
  QCOMPARE(met.count(), qsizetype(gone));
  QVERIFY(p.session.workspace() == last);
  for (int n = 0; n < gone; ++n) stack.redo();
  for (int n = gone; n < steps; ++n) {
    stack.redo();
    QCOMPARE(p.checksum(), p.seen[std::size_t(n) + 1]);
  }
}

void TestUndoMemory::aGestureGoesOnAfterItsStepWasPacked() {
  Painted p(2 * whole);
  const QString key = QStringLiteral("stroke");
  for (int n = 0; n < 4; ++n) p.paint(p.slab(n));
  const std::string before = p.checksum();
  p.session.endGesture();
  p.paint(p.slab(10), key);
  p.session.endGesture();
  p.paint(p.slab(11));  // packs the step before
  p.session.undoStack().undo();
  QVERIFY(p.session.undoStack().canRedo());
  p.session.playOn(0, [&] { p.paint(p.slab(12)); });
  p.session.undoStack().undo();
  QCOMPARE(p.checksum(), before);
}

VOLUMEN_TEST(TestUndoMemory);
#include "tst_undo_memory.moc"
