// Guards window.md "Segment" for several maps, by real events. Segments move from one map to another with
// their recipe steps, in one undo step. If a segment cannot be moved, the reason is shown.
#include <QApplication>
#include <QContextMenuEvent>
#include <QMenu>
#include <algorithm>

#include "results/segments/segment_record.h"
#include "tests/ui/overlap_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentMoving : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void oneIsMovedAndSubtracted();
  void stepsMoveWithTheirSegment();
  void whatCannotBeMovedSaysWhy();
};

namespace {

struct MoveWindow : OverlapWindow {
  // Opens a row's context menu.
  QMenu* menuOf(int row) {
    const QPoint at = list()->visualItemRect(list()->topLevelItem(row)).center();
    QContextMenuEvent event(QContextMenuEvent::Mouse, at, list()->viewport()->mapToGlobal(at));
    QCoreApplication::sendEvent(list()->viewport(), &event);
    return qobject_cast<QMenu*>(QApplication::activePopupWidget());
  }
  // Clicks an entry.
  bool chooseIn(QMenu* menu, const char* entry) {
    if (!menu) return false;
    for (QAction* action : menu->actions())
      if (action->text() == QLatin1String(entry) && action->isEnabled()) {
        QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(action).center());
        return idle();
      }
    menu->close();
    return false;
  }
  // Returns whether a map's recipe reproduces it.
  bool isMadeAgain(const SegmentMap& map) {
    const RecordedRecipe recorded = recordedRecipe(map, {});
    const auto made = follow(recorded.recipe, *session().series()->volume);
    if (!made || !recorded.missing.empty() || made->segments.size() != map.segments.size()) return false;
    return std::ranges::all_of(made->segments, [&](const Segment& segment) {
      const auto own = std::ranges::find(map.segments, segment.label, &Segment::label);
      return own != map.segments.end() && maskOf(made->labels, std::uint8_t(segment.number)) ==
                                              maskOf(*map.labels, std::uint8_t(own->number));
    });
  }
};

}  // namespace

// Moves the ball out of its overlap. Its previous map, which held nothing else, disappears.
void TestSegmentMoving::oneIsMovedAndSubtracted() {
  MoveWindow w;
  QVERIFY(w.importBoth());
  const Workspace both = w.workspace();
  const int steps = w.steps();
  const BitMask ball = w.maskIn(0), low = w.maskIn(1), shared = intersected(ball, low);
  QVERIFY(w.chooseIn(w.menuOf(0), "Move to Map 2"));
  QCOMPARE(w.workspace().segmentMaps.size(), std::size_t(1));
  QCOMPARE(w.map()->number, 1);
  QCOMPARE(w.current().label, std::string("Ball"));
  QVERIFY(w.current().colour == glm::u8vec3(255, 0, 0));
  QVERIFY(w.mask(w.current().number) == ball);
  QVERIFY(!shared.empty() && w.maskIn(1) == subtracted(low, shared));
  const QString said = QStringLiteral("Ball took %1 voxels from other segments of Map 2.")
                           .arg(QLocale().toString(qlonglong(shared.count())));
  QCOMPARE(w.said(), said);
  QCOMPARE(w.steps(), steps + 1);
  const Workspace moved = w.workspace();
  w.undo();
  QVERIFY(w.isAs(both));
  w.redo();
  QVERIFY(w.isAs(moved));
  // A map with one segment has nothing to move to a new map.
  QVERIFY(w.pushed("segmentRemove"));
  QMenu* menu = w.menuOf(0);
  QVERIFY(menu);
  for (const QAction* action : menu->actions()) QVERIFY(!action->text().startsWith(QStringLiteral("Move")));
  menu->close();
}

// Moves a segment to its own map and back. The recipes of both maps make the same voxels.
void TestSegmentMoving::stepsMoveWithTheirSegment() {
  MoveWindow w;
  QVERIFY(w.makeBoth());
  const Segment first = w.segment(0);
  const BitMask balls = w.mask(1), core = w.mask(2);
  QVERIFY(w.chooseIn(w.menuOf(0), "Move to a new map"));
  QCOMPARE(w.workspace().segmentMaps.size(), std::size_t(2));
  QCOMPARE(w.map()->number, 1);
  QVERIFY(w.current() == first && w.maskIn(1) == balls && w.said().isEmpty());
  QVERIFY(maskOf(*w.mapOf(0).labels, 2) == core);
  QVERIFY(w.isMadeAgain(w.mapOf(0)) && w.isMadeAgain(w.mapOf(1)));
  QCOMPARE(w.cell(1, 0), QString::fromStdString(first.label));
  QVERIFY(w.chooseIn(w.menuOf(1), "Move to Map 1"));
  QCOMPARE(w.workspace().segmentMaps.size(), std::size_t(1));
  QVERIFY(w.mask(1) == balls && w.mask(2) == core);
  QVERIFY(w.isMadeAgain(*w.map()));
}

void TestSegmentMoving::whatCannotBeMovedSaysWhy() {
  MoveWindow w;
  QVERIFY(w.importBoth());
  w.tick(1, 1);
  QVERIFY(w.mapOf(1).segments[0].locked && w.choose(0));
  const Workspace before = w.workspace();
  QVERIFY(w.chooseIn(w.menuOf(0), "Move to Map 2"));
  QVERIFY2(w.said().contains(QStringLiteral("Low is locked there")), qPrintable(w.said()));
  QVERIFY(w.isAs(before));
  QMenu* menu = w.menuOf(1);
  QVERIFY(menu);
  const QList<QAction*> actions = menu->actions();
  const auto move = std::ranges::find(actions, QStringLiteral("Move to Map 1"), &QAction::text);
  QVERIFY(move != actions.end() && !(*move)->isEnabled());
  QVERIFY((*move)->toolTip().contains(QStringLiteral("Low is locked")));
  menu->close();
}

VOLUMEN_TEST(TestSegmentMoving);
#include "tst_segment_moving.moc"
