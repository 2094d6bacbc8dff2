// Guards window.md "Segments" of several maps, by real events: segments that overlap keep their voxels, are
// listed, drawn, measured, exported and saved together; what is done in one map leaves the others; they are
// moved from one to another.
#include <QApplication>
#include <QContextMenuEvent>
#include <QJsonArray>
#include <QJsonDocument>
#include <QLabel>
#include <QMenu>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QToolButton>
#include <algorithm>
#include <cstdlib>

#include "io/export/seg_nrrd.h"
#include "tests/fixtures/program.h"
#include "tests/ui/paint_window.h"
#include "tests/ui/session_folder.h"
#include "tests/ui/sphere_segments.h"
#include "tests/unit/suite.h"
#include "ui/workspace/segment_record.h"

using namespace volumen;
using namespace volumen::tests;

class TestOverlappingSegments : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void bothAreListedAndOneIsWorkedOn();
  void whatIsDoneInOneLeavesTheOther();
  void bothAreDrawn();
  void tissueIsThatOfAll();
  void changesWaitForTheMapTheyWereAskedIn();
  void bothAreMeasuredAndCompared();
  void bothAreExported();
  void imagesOfLabelsAreRefused();
  void sessionsKeepBoth();
  void oneIsMovedAndSubtracted();
  void stepsMoveWithTheirSegment();
  void whatCannotBeMovedSaysWhy();
};

namespace {

bool isBallAboutHollow(glm::dvec3 p) { return glm::length(p + 5.0) < 10; }
bool isLow(glm::dvec3 p) { return p.z < -5; }

// Imported: in map 1 "Ball", all within 10 mm of the middle of the hollow ball, in map 2 "Low", the lower
// part of the volume.
struct OverlapWindow : PaintWindow {
  QTemporaryDir folder;

  QString at(const char* name) const { return folder.filePath(QLatin1String(name)); }
  Segmented layer(const char* name, glm::u8vec3 colour, bool (*isIn)(glm::dvec3)) {
    LabelEdit edit{LabelMap(grid())};
    for (int k = 0; k < 40; ++k)
      for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 40; ++i)
          if (isIn(glm::dvec3(i, j, k) - 19.5)) edit.set({i, j, k}, 1);
    return {{{.number = 1, .label = name, .colour = colour}}, edit.done()};
  }
  bool import(const QString& path) {
    child<QAction>("importSegments")->trigger();
    answer(*this, "segmentImportDialog", path);
    return idle();
  }
  bool importBoth() {
    const std::vector<Segmented> layers{layer("Ball", {255, 0, 0}, isBallAboutHollow),
                                        layer("Low", {0, 255, 0}, isLow)};
    return writeSegNrrd(layers, at("both.seg.nrrd").toStdString()) && import(at("both.seg.nrrd"));
  }
  const SegmentMap& mapOf(int number) { return *segmentMapOf(workspace(), series(), number); }
  BitMask maskIn(int number) { return maskOf(*mapOf(number).labels, 1); }
  QString worked() {
    const auto* label = child<QLabel>("segmentMap");
    return label->isVisible() ? label->text() : QString();
  }
  bool pushed(const char* button) { return SegmentWindow::press(button); }
  QString cell(int row, int column) { return list()->topLevelItem(row)->text(column); }
  // The menu of a row, by the right mouse button.
  QMenu* menuOf(int row) {
    const QPoint at = list()->visualItemRect(list()->topLevelItem(row)).center();
    QContextMenuEvent event(QContextMenuEvent::Mouse, at, list()->viewport()->mapToGlobal(at));
    QCoreApplication::sendEvent(list()->viewport(), &event);
    return qobject_cast<QMenu*>(QApplication::activePopupWidget());
  }
  // A click on an entry.
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
  // Whether its recipe makes a map as it is.
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

QString mlOf(std::int64_t voxels) {
  const double ml = double(voxels) / 1000;
  return QLocale().toString(ml, 'f', ml < 100 ? 2 : 0);
}

}  // namespace

void TestOverlappingSegments::bothAreListedAndOneIsWorkedOn() {
  OverlapWindow w;
  const Workspace none = w.workspace();
  QVERIFY(w.make(800, 1200));
  QVERIFY2(w.worked().isEmpty() && w.list()->isColumnHidden(3), "of one map nothing is told");
  w.undo();
  QVERIFY(w.idle() && w.importBoth());
  QCOMPARE(w.list()->topLevelItemCount(), 2);
  QVERIFY(!w.list()->isColumnHidden(3));
  QCOMPARE(w.cell(0, 0), QStringLiteral("Ball"));
  QCOMPARE(w.cell(0, 2), mlOf(voxelsWhere(isBallAboutHollow)));
  QCOMPARE(w.cell(0, 3), QStringLiteral("Map 1"));
  QCOMPARE(w.cell(1, 0), QStringLiteral("Low"));
  QCOMPARE(w.cell(1, 2), mlOf(voxelsWhere(isLow)));
  QCOMPARE(w.cell(1, 3), QStringLiteral("Map 2"));
  QVERIFY2(w.worked().startsWith(QStringLiteral("Map 1 is worked on")), qPrintable(w.worked()));
  const Workspace both = w.workspace();
  QVERIFY(w.choose(1));
  QVERIFY2(w.worked().startsWith(QStringLiteral("Map 2 is worked on")), qPrintable(w.worked()));
  QCOMPARE(w.current().label, std::string("Low"));
  QCOMPARE(w.list()->currentItem(), w.list()->topLevelItem(1));
  QVERIFY(w.choose(0));
  QVERIFY(w.workspace() == both);
  w.undo(), w.undo();
  QVERIFY(w.workspace() == both);
  w.undo();
  QVERIFY(w.workspace() == none);
}

// A stroke, a step, a lock, and a map that goes with its last segment.
void TestOverlappingSegments::whatIsDoneInOneLeavesTheOther() {
  OverlapWindow w;
  const Workspace none = w.workspace();
  const int first = w.steps();
  QVERIFY(w.importBoth() && w.choose(1));
  const SegmentMap ball = w.mapOf(0);
  const BitMask low = w.maskIn(1);
  w.take("paintTool");
  w.showPlace({-5, -5, -5});
  const std::vector<QPoint> way = w.pixelsOf({{-9, -5, -5}, {-1, -5, -5}}, axialViewId);
  const BitMask covered = w.covered(way);
  w.stroke(way);
  QVERIFY(w.idle());
  QVERIFY(!subtracted(covered, low).empty());
  QVERIFY(w.maskIn(1) == united(low, covered) && w.mapOf(0) == ball);
  QVERIFY(w.step("grow") && w.mapOf(0) == ball);
  w.tick(0, 1);
  QVERIFY2(w.mapOf(0).segments[0].locked && w.map()->number == 0, "a click on its row chooses its map");
  QVERIFY(w.choose(1) && w.pushed("segmentRemove"));
  QCOMPARE(w.workspace().segmentMaps.size(), std::size_t(1));
  QVERIFY(*w.mapOf(0).labels == *ball.labels);
  QVERIFY(w.worked().isEmpty());
  const Workspace last = w.workspace();
  const int steps = w.steps();
  while (w.steps() > first) w.undo();
  QVERIFY(w.isAs(none));
  while (w.steps() < steps) w.redo();
  QVERIFY(w.isAs(last));
}

void TestOverlappingSegments::bothAreDrawn() {
  OverlapWindow w;
  QVERIFY(w.importBoth());
  w.showPlace({-5, -5, -10});
  const QPoint a = w.pixelOf({-20, -20, -10}, axialViewId), b = w.pixelOf({20, 20, -10}, axialViewId);
  const int all = std::abs((b.x() - a.x()) * (b.y() - a.y()));
  QTRY_VERIFY_WITH_TIMEOUT(w.coloured() > 0.9 * all, longest);
  QTRY_COMPARE_WITH_TIMEOUT(w.session().segmentsDrawn(sceneViewId).size(), std::size_t(2), longest);
  QCOMPARE(w.session().segmentsDrawn(sceneViewId)[1].segment->label, std::string("Low"));
  w.tick(1, 0);
  QTRY_VERIFY_WITH_TIMEOUT(w.coloured() < 0.3 * all && w.coloured() > 0.05 * all, longest);
  QTRY_COMPARE_WITH_TIMEOUT(w.session().segmentsDrawn(sceneViewId).size(), std::size_t(1), longest);
  w.tick(0, 0);
  QTRY_COMPARE_WITH_TIMEOUT(w.coloured(), 0, longest);
  QVERIFY(w.session().segmentsDrawn(sceneViewId).empty());
}

// "Only inside shown segments" is inside any of them, whichever is worked on.
void TestOverlappingSegments::tissueIsThatOfAll() {
  OverlapWindow w;
  QVERIFY(w.importBoth());
  auto* where = w.child<QComboBox>("segmentTissue");
  where->setFocus();
  QTest::keyClick(where, Qt::Key_Down);
  QVERIFY(w.idle());
  const auto inside = [&] {
    return voxelsWhere([](glm::dvec3 p) { return isBallAboutHollow(p) || isLow(p); });
  };
  const auto drawn = [&] {
    const MadeTissue* tissue = w.session().tissueDrawn(sceneViewId);
    return tissue ? tissue->voxels->count() : -1;
  };
  QTRY_COMPARE_WITH_TIMEOUT(drawn(), inside(), longest);
  QVERIFY(w.choose(1));
  QCOMPARE(where->currentIndex(), 1);
  QCOMPARE(drawn(), inside());
  w.tick(1, 0);
  QTRY_COMPARE_WITH_TIMEOUT(drawn(), voxelsWhere(isBallAboutHollow), longest);
}

// The second map is chosen before the first one's change begins.
void TestOverlappingSegments::changesWaitForTheMapTheyWereAskedIn() {
  OverlapWindow w;
  QVERIFY(w.importBoth());
  const BitMask ball = w.maskIn(0), low = w.maskIn(1);
  w.click("segmentChange");
  w.click("segmentStep-grow");
  w.click("segmentStep-grow");
  QVERIFY(w.choose(1));
  QVERIFY(subtracted(ball, w.maskIn(0)).empty() && w.maskIn(0).count() > ball.count());
  QVERIFY(w.maskIn(1) == low);
  QCOMPARE(w.map()->number, 1);
}

void TestOverlappingSegments::bothAreMeasuredAndCompared() {
  OverlapWindow w;
  QVERIFY(w.importBoth());
  QVERIFY(w.pushed("segmentNumbersButton"));
  auto* table = w.child<QTableWidget>("segmentNumbers");
  QCOMPARE(table->rowCount(), 2);
  const auto head = [&](const char* text) {
    for (int column = 0; column < table->columnCount(); ++column)
      if (table->horizontalHeaderItem(column)->text().startsWith(QLatin1String(text))) return column;
    return -1;
  };
  QCOMPARE(table->item(0, head("Voxels"))->text(), QString::number(voxelsWhere(isBallAboutHollow)));
  QCOMPARE(table->item(1, head("Voxels"))->text(), QString::number(voxelsWhere(isLow)));
  for (const int row : {0, 1})
    QTest::mouseClick(table->viewport(), Qt::LeftButton, row == 0 ? Qt::NoModifier : Qt::ControlModifier,
                      table->visualItemRect(table->item(row, 0)).center());
  const QString saved = w.at("numbers.json");
  w.click("segmentNumbersJson");
  answer(w, "segmentNumbersFileDialog", saved);
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(saved), longest);
  const QJsonArray told = QJsonDocument::fromJson(contentsOf(saved))[QStringLiteral("segments")].toArray();
  for (const int row : {0, 1}) QCOMPARE(told[row][QStringLiteral("map")].toInt(), row + 1);
  QVERIFY(w.pushed("segmentNumbersCompare"));
  const double inBoth = double(voxelsWhere([](glm::dvec3 p) { return isBallAboutHollow(p) && isLow(p); }));
  const double dice = 2 * inBoth / double(voxelsWhere(isBallAboutHollow) + voxelsWhere(isLow));
  const QString said = w.child<QLabel>("segmentNumbersSaid")->text();
  QVERIFY2(said.contains(QStringLiteral("Ball and Low: Dice ") + QString::number(dice, 'g', 4)),
           qPrintable(said));
}

void TestOverlappingSegments::bothAreExported() {
  OverlapWindow w;
  QVERIFY(w.importBoth());
  const SegmentMap ball = w.mapOf(0), low = w.mapOf(1);
  w.child<QAction>("exportSegments")->trigger();
  answer(w, "segmentDialog", w.at("out.seg.nrrd"));
  QVERIFY(w.idle() && QFile::exists(w.at("out.seg.nrrd")));
  while (w.list()->topLevelItemCount() > 0) QVERIFY(w.pushed("segmentRemove"));
  QVERIFY(w.workspace().segmentMaps.empty());
  QVERIFY(w.import(w.at("out.seg.nrrd")));
  QVERIFY(*w.mapOf(0).labels == *ball.labels && *w.mapOf(1).labels == *low.labels);
  QVERIFY(w.mapOf(1).segments[0].label == "Low" && w.mapOf(1).segments[0].colour == low.segments[0].colour);
}

void TestOverlappingSegments::imagesOfLabelsAreRefused() {
  OverlapWindow w;
  QVERIFY(w.importBoth());
  w.child<QAction>("exportSegments")->trigger();
  answer(w, "segmentDialog", w.at("out.nii.gz"));
  QVERIFY(w.idle() && !QFile::exists(w.at("out.nii.gz")));
  QVERIFY2(w.said().contains(QStringLiteral(".seg.nrrd and .dcm hold")), qPrintable(w.said()));
}

// And which of them is worked on.
void TestOverlappingSegments::sessionsKeepBoth() {
  const SessionFolder folder;
  SharedList<SegmentMap> saved;
  {
    SegmentsWindow w;
    QVERIFY(w.segment(0.5, 1));
    QTest::mouseClick(w.child<QToolButton>("segmentDuplicate"), Qt::LeftButton);
    QTRY_COMPARE_WITH_TIMEOUT(w.workspace().segmentMaps.size(), std::size_t(2), longest);
    QCOMPARE(w.map().number, 1);
    QVERIFY(folder.save(w));
    saved = w.workspace().segmentMaps;
    w.window.end();
  }
  Journey w;
  QVERIFY(folder.open(w));
  QVERIFY(w.window.session().workspace().segmentMaps == saved);
  QCOMPARE(w.child<QTreeWidget>("segmentList")->topLevelItemCount(), 2);
  w.window.end();
}

// The ball out of what it overlaps; the map in which it was alone is gone.
void TestOverlappingSegments::oneIsMovedAndSubtracted() {
  OverlapWindow w;
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
  // A map with one segment has nothing for a new one.
  QVERIFY(w.pushed("segmentRemove"));
  QMenu* menu = w.menuOf(0);
  QVERIFY(menu);
  for (const QAction* action : menu->actions()) QVERIFY(!action->text().startsWith(QStringLiteral("Move")));
  menu->close();
}

// Out to a map of its own and back again: the recipes of both maps make the same voxels.
void TestOverlappingSegments::stepsMoveWithTheirSegment() {
  OverlapWindow w;
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

void TestOverlappingSegments::whatCannotBeMovedSaysWhy() {
  OverlapWindow w;
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

VOLUMEN_TEST(TestOverlappingSegments);
#include "tst_overlapping_segments.moc"
