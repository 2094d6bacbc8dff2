// Guards window.md "Segment" for several maps, by real events. Overlapping segments keep their voxels and are
// listed, drawn, measured, exported and saved together. Acts in one map leave the others unchanged.
#include <QJsonArray>
#include <QJsonDocument>
#include <QLabel>
#include <QTableWidget>
#include <QToolButton>
#include <cstdlib>

#include "tests/fixtures/program.h"
#include "tests/ui/overlap_window.h"
#include "tests/ui/session_folder.h"
#include "tests/ui/sphere_segments.h"
#include "tests/unit/suite.h"

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
};

namespace {

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

// A stroke, a recipe step, a lock, and a map that disappears with its last segment.
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
  QTRY_COMPARE_WITH_TIMEOUT(w.scenes().segments(sceneViewId).size(), std::size_t(2), longest);
  QCOMPARE(w.scenes().segments(sceneViewId)[1].segment->label, std::string("Low"));
  w.tick(1, 0);
  QTRY_VERIFY_WITH_TIMEOUT(w.coloured() < 0.3 * all && w.coloured() > 0.05 * all, longest);
  QTRY_COMPARE_WITH_TIMEOUT(w.scenes().segments(sceneViewId).size(), std::size_t(1), longest);
  w.tick(0, 0);
  QTRY_COMPARE_WITH_TIMEOUT(w.coloured(), 0, longest);
  QVERIFY(w.scenes().segments(sceneViewId).empty());
}

// "Only inside shown segments" means inside any of them, whichever map is active.
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
    const TissueLeft::Entry* tissue = w.scenes().tissue(sceneViewId);
    return tissue ? tissue->value->voxels->count() : -1;
  };
  QTRY_COMPARE_WITH_TIMEOUT(drawn(), inside(), longest);
  QVERIFY(w.choose(1));
  QCOMPARE(where->currentIndex(), 1);
  QCOMPARE(drawn(), inside());
  w.tick(1, 0);
  QTRY_COMPARE_WITH_TIMEOUT(drawn(), voxelsWhere(isBallAboutHollow), longest);
}

// The second map becomes active before the first one's change begins.
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
  QVERIFY(w.exportTo(w.at("out.seg.nrrd")));
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

// Sessions also keep which map is active.
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

VOLUMEN_TEST(TestOverlappingSegments);
#include "tst_overlapping_segments.moc"
