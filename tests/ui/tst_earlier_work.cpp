// Guards kept work. It is moved aside whole or not at all, and closing reports work that cannot be kept.
// Restored work counts as it was saved, and playback is not saved over and over.
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <QRegularExpression>
#include <QTemporaryDir>

#include "io/export/dicom_series.h"
#include "tests/ui/killed_window.h"
#include "tests/ui/segment_window.h"
#include "tests/ui/session_folder.h"
#include "tests/unit/suite.h"
#include "ui/controller/segment_files.h"
#include "ui/views/cine_bar.h"
#include "ui/widgets/offer_bar.h"
#include "ui/workspace/series_segments.h"
#include "viewer/phantoms/phantoms.h"

using namespace volumen;
using namespace volumen::tests;

class TestEarlierWork : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init();
  void itIsListedByPatient();
  void whatIsSavedCountsAsSaved();
  void exportedSegmentsCountAsSaved();
  void closingSaysWhatCannotBeKept();
  void segmentsMoveAsideWholeOrNotAtAll();
  void whatPlaysIsNotWritten();
  void labelsThatAreNotKeptAreReleased();

 private:
  QString series() const { return dir_->filePath(QStringLiteral("head")); }
  std::unique_ptr<QTemporaryDir> dir_;
};

namespace {

void measureIn(Journey& w, double mm) {
  Shape length;
  length.kind = ShapeKind::length;
  length.points = {{0, 0, 0}, {mm, 0, 0}};
  addMeasurement(w.window.session(), w.window.session().workspace().view(sceneViewId).series, length);
  w.window.session().endGesture();
}

void pressInBox(Journey& w, const char* text) {
  for (QMessageBox* box : w.window.findChildren<QMessageBox*>(QStringLiteral("closeBox")))
    for (QAbstractButton* button : box->buttons())
      if (box->isVisible() && button->text() == QLatin1String(text))
        return QTest::mouseClick(button, Qt::LeftButton);
  QFAIL(text);
}

}  // namespace

void TestEarlierWork::init() {
  QDir(Autosave::folder()).removeRecursively();
  QFile::remove(Autosave::folder());
  dir_ = std::make_unique<QTemporaryDir>();
  DicomSeriesTags tags;
  tags.patientName = "Doe^Jane", tags.patientId = "7";
  QVERIFY(writeDicomSeries(**makePhantom("ct-head:24"), tags, series().toStdString()));
}

void TestEarlierWork::itIsListedByPatient() {
  {
    Journey w({series()});
    QVERIFY(w.settle());
    measureIn(w, 10);
    QVERIFY(!w.window.close());
    pressInBox(w, "Close without saving");
  }
  Journey w;
  auto* menu = w.child<QMenu>("earlierMenu");
  QTRY_VERIFY_WITH_TIMEOUT(menu->isEnabled(), longest);
  const QRegularExpression wanted(QStringLiteral("^\\d{4}-\\d\\d-\\d\\d \\d\\d:\\d\\d, Doe, Jane \\(7\\)$"));
  QVERIFY2(wanted.match(menu->actions().at(0)->text()).hasMatch(), qPrintable(menu->actions().at(0)->text()));
  w.window.session().prefer([](Preferences& p) { p.hideNames = true; });
  QVERIFY(!menu->actions().at(0)->text().contains(QStringLiteral("Jane")));
  w.window.session().prefer([](Preferences& p) { p.hideNames = false; });
}

void TestEarlierWork::whatIsSavedCountsAsSaved() {
  const QString path = dir_->filePath(QStringLiteral("s.volumen"));
  {
    Journey w({series()});
    QVERIFY(w.settle());
    measureIn(w, 10);
    w.child<QAction>("saveSession")->trigger();
    answer(w, "saveSessionDialog", path);
    QTRY_VERIFY_WITH_TIMEOUT(w.window.windowTitle().contains(QStringLiteral("s.volumen")), longest);
    measureIn(w, 20);
    QCOMPARE(w.window.document().files.unsavedWork().measurements.size(), std::size_t(1));
    w.window.end();
  }
  Journey w;
  auto* offer = w.child<OfferBar>("offerBar");
  QTRY_VERIFY_WITH_TIMEOUT(offer->isVisible(), longest);
  QVERIFY2(offer->sentence().contains(QStringLiteral("Doe, Jane (7)")), qPrintable(offer->sentence()));
  QTest::mouseClick(w.child<QWidget>("offerAccept"), Qt::LeftButton);
  const auto& files = w.window.document().files;
  QTRY_COMPARE_WITH_TIMEOUT(w.window.session().workspace().measurements.size(), std::size_t(2), longest);
  QCOMPARE(files.unsavedWork().measurements.size(), std::size_t(1));
  QVERIFY(files.modified());
  deleteMeasurement(w.window.session(), w.window.session().workspace().measurements[1].id);
  QVERIFY(files.unsavedWork().empty());
  w.window.end();
}

// The kept session is copied while its window is open, as a killed program leaves it.
void TestEarlierWork::exportedSegmentsCountAsSaved() {
  const QDir kept(Autosave::folder());
  {
    SegmentWindow w(QStringList{series()});
    QVERIFY(w.settle());
    w.child<QDockWidget>("segmentDock")->raise();
    QVERIFY(w.make(-100, 100) && w.count() == 1);
    w.click("segmentSave");
    answer(w, "segmentDialog", dir_->filePath(QStringLiteral("a.seg.nrrd")));
    const auto& files = w.window.document().files;
    QTRY_VERIFY_WITH_TIMEOUT(files.unsavedWork().empty(), longest);
    QVERIFY(isKeptAgain(1));
    const QString name = keptSessions().at(0);
    for (const QString& file : kept.entryList({name + QLatin1Char('*')}, QDir::Files))
      if (!file.endsWith(QStringLiteral(".lock")))
        QVERIFY(QFile::copy(kept.filePath(file), kept.filePath(QStringLiteral("killed") + file)));
    for (const QString& file : kept.entryList({QStringLiteral("killed*")}, QDir::Files))
      QVERIFY(QFile::rename(kept.filePath(file),
                            kept.filePath(QString(file).replace(name, QStringLiteral(".volumen")))));
  }
  Journey w;
  QTRY_VERIFY_WITH_TIMEOUT(w.child<OfferBar>("offerBar")->isVisible(), longest);
  QTest::mouseClick(w.child<QWidget>("offerAccept"), Qt::LeftButton);
  const Session& session = w.window.session();
  QTRY_COMPARE_WITH_TIMEOUT(session.workspace().segmentMaps.size(), std::size_t(1), longest);
  const auto& files = w.window.document().files;
  QVERIFY(session.workspace().segmentMaps[0].labels);
  QCOMPARE(workText(files.unsavedWork()), QString());
  measureIn(w, 10);
  QCOMPARE(workText(files.unsavedWork()), QStringLiteral("1 measurement"));
  w.window.session().change(QStringLiteral("test"), [](Workspace& after) {
    after.segmentMaps.editIf([](const SegmentMap&) { return true; },
                             [](SegmentMap& map) { map.segments[0].label = "other"; });
  });
  QCOMPARE(workText(files.unsavedWork()), QStringLiteral("1 measurement, 1 segment"));
  w.window.end();
}

void TestEarlierWork::closingSaysWhatCannotBeKept() {
  Journey w({series()});
  QVERIFY(w.settle());
  measureIn(w, 10);
  QVERIFY(areKept(1));
  QVERIFY(QDir(Autosave::folder()).removeRecursively());
  QFile inTheWay(Autosave::folder());
  QVERIFY(inTheWay.open(QIODevice::WriteOnly));
  inTheWay.close();
  QVERIFY(!w.window.close());
  pressInBox(w, "Close without saving");
  QVERIFY2(w.window.isVisible(), "it would be lost");
  const auto boxes = w.window.findChildren<QMessageBox*>(QStringLiteral("closeBox"));
  const auto says = [](const QMessageBox* box) {
    return box->isVisible() && box->informativeText().contains(QStringLiteral("cannot be kept"));
  };
  QVERIFY(std::ranges::any_of(boxes, says));
  pressInBox(w, "Close without saving");
  QVERIFY(!w.window.isVisible());
}

// Moved aside, the names of its segments would be too long for a file system.
void TestEarlierWork::segmentsMoveAsideWholeOrNotAtAll() {
  QVERIFY(QDir().mkpath(Autosave::folder()));
  const QString path =
      QDir(Autosave::folder()).filePath(QString(195, QLatin1Char('a')) + QStringLiteral(".volumen"));
  Workspace workspace;
  const LoadedSeriesPtr ball = ballSeries();
  workspace = withSeries(workspace, sceneViewId, ball->series, {});
  workspace = withNewSegment(workspace, keyOf(ball->series), ball->volume->geometry(), {});
  QVERIFY(saveSession(path.toStdString(), workspace));
  QCOMPARE(segmentFilesOf(path).size(), 1);
  Session session;
  Jobs jobs;
  SessionFiles files(session, jobs);
  Autosave autosave(session, files);
  QSignalSpy failed(&autosave, &Autosave::failed);
  autosave.discard({path, {}, {}, nullptr});
  QTRY_COMPARE_WITH_TIMEOUT(failed.count(), 1, longest);
  QVERIFY(QFile::exists(path));
  QCOMPARE(segmentFilesOf(path).size(), 1);
}

void TestEarlierWork::whatPlaysIsNotWritten() {
  MeasureWindow w;
  QVERIFY(areKept(1));
  QTest::qWait(2500);
  const auto kept = [] { return contentsOf(QDir(Autosave::folder()).filePath(keptSessions().value(0))); };
  const QByteArray before = kept();
  int places = 0;
  connect(&w.session(), &Session::workspaceChanged, this,
          [&](const Workspace& was, const Workspace& is) { places += was.crosshairs != is.crosshairs; });
  w.child<QAction>("playFrames")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(places > 10, longest);
  QTest::qWait(2500);
  QVERIFY(places > 15);
  QVERIFY2(kept() == before, "it was written while it played");
  w.child<QAction>("playFrames")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(kept() != before, longest);
}

void TestEarlierWork::labelsThatAreNotKeptAreReleased() {
  const std::string path = dir_->filePath(QStringLiteral("kept.volumen")).toStdString();
  const LoadedSeriesPtr ball = ballSeries();
  const Workspace without = withSeries({}, sceneViewId, ball->series, {});
  std::weak_ptr<const LabelMap> labels;
  {
    const Workspace with = withNewSegment(without, keyOf(ball->series), ball->volume->geometry(), {});
    labels = with.segmentMaps[0].labels;
    QVERIFY(keepSession(path, with, {}));
    QCOMPARE(segmentFilesOf(QString::fromStdString(path)).size(), 1);
  }
  QVERIFY2(!labels.expired(), "changes of it may follow");
  QVERIFY(keepSession(path, without, {}));
  QVERIFY(labels.expired());
  QVERIFY(segmentFilesOf(QString::fromStdString(path)).isEmpty());
}

VOLUMEN_TEST(TestEarlierWork);
#include "tst_earlier_work.moc"
