// Guards design.md 8 and 11: a segment is part of the workspace, undone with it and kept with its series.
#include <QCheckBox>
#include <QMessageBox>

#include "results/segments/segments.h"
#include "tests/ui/session_folder.h"
#include "tests/ui/sphere_segments.h"
#include "tests/unit/suite.h"
#include "ui/controller/autosave.h"
#include "viewer/segment/numbers.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegments : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { QDir(Autosave::folder()).removeRecursively(); }
  void aSegmentIsOneStep();
  void theSameOnceMoreIsNone();
  void aSegmentStaysWithItsSeries();
  void closedWorkIsNotSaved();
  void whatIsCutAwayIsNoSegment();
};

void TestSegments::aSegmentIsOneStep() {
  SegmentsWindow w;
  QVERIFY(w.segment(0.5, 1));
  const Workspace with = w.workspace();
  QCOMPARE(with.segmentMaps.size(), std::size_t(1));
  QCOMPARE(w.undoStack().count(), 1);
  QCOMPARE(w.map().segments.front().label, std::string("0.5 to 1"));
  const QString ball = w.result();
  QVERIFY(w.segment(0, 0.4, "segmentReplace"));
  QCOMPARE(w.undoStack().count(), 2);
  QCOMPARE(w.workspace().segmentMaps.size(), std::size_t(1));
  QCOMPARE(w.map().segments.size(), std::size_t(1));  // replaces the first
  QCOMPARE(w.map().segments.front().label, std::string("0 to 0.4"));
  w.undo();
  QVERIFY(w.workspace() == with);
  QTRY_COMPARE_WITH_TIMEOUT(w.result(), ball, longest);
  w.undo();
  QVERIFY(w.workspace().segmentMaps.empty());
  QTRY_COMPARE_WITH_TIMEOUT(w.result(), QString(), longest);
  QVERIFY(!w.child<QCheckBox>("segmentOnly")->isEnabled());
  w.child<QAction>("redo")->trigger();
  QTRY_COMPARE_WITH_TIMEOUT(w.result(), ball, longest);
}

void TestSegments::theSameOnceMoreIsNone() {
  SegmentsWindow w;
  QVERIFY(w.segment(0.5, 1));
  const QString ball = w.result();
  const Workspace once = w.workspace();
  QTest::mouseClick(w.child<QPushButton>("segmentReplace"), Qt::LeftButton);
  QTRY_COMPARE_WITH_TIMEOUT(w.result(), ball, longest);
  QTRY_VERIFY_WITH_TIMEOUT(w.window.jobs().rows().empty(), longest);
  QCOMPARE(w.undoStack().count(), 1);
  QVERIFY(w.workspace() == once);
}

void TestSegments::aSegmentStaysWithItsSeries() {
  SegmentsWindow w;
  QVERIFY(w.segment(0.5, 1));
  const QString ball = w.result();
  const SegmentMap made = w.map();
  w.window.open({QStringLiteral("phantom:cube:32")});
  QTRY_VERIFY_WITH_TIMEOUT(w.result().isEmpty(), longest);
  QVERIFY(w.settle());
  QVERIFY(w.map() == made);
  w.undo();
  QTRY_COMPARE_WITH_TIMEOUT(w.result(), ball, longest);
  // The series is closed and opened again.
  w.window.session().close({made.series});
  QVERIFY(w.workspace().segmentMaps.empty());
  w.window.open({spherePhantom});
  QTRY_COMPARE_WITH_TIMEOUT(w.result(), ball, longest);
  QVERIFY(w.map() == made);
}

void TestSegments::closedWorkIsNotSaved() {
  const SessionFolder folder;
  SegmentsWindow w;
  QVERIFY(w.segment(0.5, 1));
  const SeriesKey series = w.map().series;
  w.window.open({QStringLiteral("phantom:cube:32")});
  QTRY_VERIFY_WITH_TIMEOUT(w.result().isEmpty(), longest);
  w.window.session().close({series});
  QVERIFY(folder.save(w));
  QVERIFY(!w.window.close());
  QVERIFY(w.child<QMessageBox>("closeBox")->text().contains(QStringLiteral("1 segment")));
}

// Removed tissue is shown as air, which is in the range. The numbers count only what remains.
void TestSegments::whatIsCutAwayIsNoSegment() {
  const SessionFolder folder;
  SegmentsWindow w({folder.ct()});
  w.after([&] { w.child<QAction>("removeTable")->trigger(); });
  QVERIFY(w.segment(-1100, -900));
  const Volume& whole = *w.window.session().seriesWith(w.map().series, {})->volume;
  const SegmentValues air = valuesIn(maskOf(*w.map().labels, 1), whole);
  QVERIFY(air.voxels > 0 && air.max <= -900);
}

VOLUMEN_TEST(TestSegments);
#include "tst_segments.moc"
