// Guards the action "Remove table": one undo step for the picture and segments. Real events.
#include <QCheckBox>
#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTextBrowser>
#include <QToolButton>

#include "io/export/dicom_series.h"
#include "io/files/write_volume.h"
#include "tests/fixtures/ct_with_table.h"
#include "tests/ui/journey.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// A window that shows a CT with a table from behind.
struct OnTable {
  QTemporaryDir dir;
  Journey w;

  bool open() {
    const QString path = dir.filePath(QStringLiteral("ct.nrrd"));
    if (!writeVolume(*CtWithTable::volume(true), path.toStdString())) return false;
    w.window.open({path});
    return w.settle() && !w.after("viewPosterior").isNull();
  }
  QCheckBox* button() { return w.child<QCheckBox>("segmentTable"); }
  void click() {
    w.child<QDockWidget>("segmentDock")->raise();
    QTest::mouseClick(button(), Qt::LeftButton);
  }
};

}  // namespace

class TestRemoveTable : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theTableGoesAndComesBack();
  void segmentsAreOfThePatientAlone();
  void thePanelsKeepWhatTheyShow();
  void itIsNotOfferedForOtherValues();
  void theFirstPictureOfACtIsSoonWithoutIt();
};

void TestRemoveTable::theTableGoesAndComesBack() {
  OnTable t;
  QVERIFY(t.open());
  const QImage with = t.w.window.view()->picture();
  t.w.shot("table");
  const QImage without = t.w.after([&] { t.click(); });
  t.w.shot("table-removed");
  QVERIFY2(!without.isNull() && without != with, "the table hides the back no longer");
  QVERIFY(t.button()->isChecked());
  QVERIFY(t.w.child<QTextBrowser>("effectsPanel")->toPlainText().contains(QStringLiteral("table removed")));
  // It is one undo step. A key undoes it, redo repeats it, and the button takes it back.
  QCOMPARE(t.w.window.session().undoStack().count(), 2);  // the view and the table
  QVERIFY(t.w.after([&] { QTest::keyClick(&t.w.window, Qt::Key_Z, Qt::ControlModifier); }) == with);
  QVERIFY(!t.button()->isChecked());
  QVERIFY(t.w.after("redo") == without);
  QVERIFY(t.button()->isChecked());
  QVERIFY(t.w.after([&] { t.click(); }) == with);
  QVERIFY(!t.button()->isChecked());
}

void TestRemoveTable::segmentsAreOfThePatientAlone() {
  OnTable t;
  QVERIFY(t.open());
  t.w.after([&] { t.click(); });
  auto* low = t.w.child<QWidget>("segmentLow");
  auto* high = t.w.child<QWidget>("segmentHigh");
  for (const auto& [field, text] : {std::pair(low, "390"), std::pair(high, "410")}) {
    field->setFocus();
    QTest::keyClick(field, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(field, QLatin1String(text));
  }
  auto* result = t.w.child<QLabel>("segmentResult");
  QTest::mouseClick(t.w.child<QPushButton>("segment"), Qt::LeftButton);
  // Only the table has 400 HU.
  const QRegularExpression none(QStringLiteral("\\b0 voxels"));
  QTRY_VERIFY_WITH_TIMEOUT(result->text().contains(none), longest);
  t.w.child<QAction>("undo")->trigger();  // undoes the segment
  t.w.after("undo");
  QTest::mouseClick(t.w.child<QPushButton>("segment"), Qt::LeftButton);
  const int table = CtWithTable::size.x * 3 * CtWithTable::size.z;
  QTRY_VERIFY_WITH_TIMEOUT(result->text().contains(QLocale().toString(table) + QStringLiteral(" voxels")),
                           longest);
}

void TestRemoveTable::thePanelsKeepWhatTheyShow() {
  OnTable t;
  QVERIFY(t.open());
  const Scene scene = t.w.window.session().scene();
  const QString title = t.w.window.windowTitle();
  t.w.after([&] { t.click(); });
  QVERIFY(t.w.window.session().scene() == scene);
  QCOMPARE(t.w.window.windowTitle(), title);
  QVERIFY(t.w.child<QLabel>("warningText")->toolTip().contains(QStringLiteral("table was removed")));
}

void TestRemoveTable::itIsNotOfferedForOtherValues() {
  Journey w;
  auto* action = w.child<QAction>("removeTable");
  QVERIFY(!action->isEnabled());
  QVERIFY(action->toolTip().contains(QStringLiteral("Open a CT")));
  w.window.open({QStringLiteral("phantom:sphere:32")});
  QVERIFY(w.settle());
  QVERIFY(!action->isEnabled());
  QVERIFY(action->toolTip().contains(QStringLiteral("not Hounsfield units")));
  w.settled.clear();
  w.window.open({QStringLiteral("phantom:ct-head:48")});
  QVERIFY(w.settle());
  QVERIFY(action->isEnabled());
}

void TestRemoveTable::theFirstPictureOfACtIsSoonWithoutIt() {
  const QTemporaryDir dir;
  DicomSeriesTags tags;
  tags.patientName = "Doe^Jane", tags.patientId = "77";
  QVERIFY(writeDicomSeries(*CtWithTable::ofCt(true), tags, dir.path().toStdString()));
  Journey w({dir.path()});
  QVERIFY(w.settle());
  auto* show = w.child<QToolButton>("showTable");
  QTRY_VERIFY_WITH_TIMEOUT(show->isVisible(), longest);
  const Session& session = w.window.session();
  const DrawnScenes& drawn = w.window.document().drawn;
  QTRY_VERIFY_WITH_TIMEOUT(drawn.series(sceneViewId) != session.series(), longest);
  QVERIFY2(session.maskOf(keyOf(session.series()->series)).empty(), "slices and numbers have all of it");
  QCOMPARE(w.window.session().undoStack().count(), 0);
  w.shot("ct-without-table");
  const QImage without = w.after("viewPosterior");
  // One click shows it again, for the next series, too.
  const QImage with = w.after([&] { QTest::mouseClick(show, Qt::LeftButton); });
  QVERIFY(!with.isNull() && with != without);
  QVERIFY(!show->isVisible() && w.child<QAction>("tableIn3d")->isChecked());
  QCOMPARE(w.window.session().undoStack().count(), 1);  // the view
  w.shot("ct-with-table");
  QVERIFY(w.after([&] { w.child<QAction>("tableIn3d")->trigger(); }) == without);
  // A table removed by hand is gone from slices, too.
  w.after("removeTable");
  QVERIFY(!show->isVisible());
  QVERIFY(drawn.series(sceneViewId) == session.series());
  QVERIFY(session.series()->volume->attributes().cut.table);
}

VOLUMEN_TEST(TestRemoveTable);
#include "tst_remove_table.moc"
