// Guards that saved pictures show what was on screen when they were requested, whatever is done meanwhile. A
// cancelled run leaves no files, and a run that cannot be cancelled says so.
#include <QFileDialog>
#include <QLabel>
#include <QMessageBox>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QThread>
#include <atomic>

#include "tests/ui/kept_pictures.h"
#include "tests/ui/measure_window.h"
#include "tests/ui/picture_window.h"
#include "tests/ui/two_series.h"
#include "tests/unit/suite.h"
#include "ui/exports/flat_pictures.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Starts saving pictures that are large enough to take time.
bool isSavingStack(MeasureWindow& w, const QString& folder) {
  if (!QTest::qWaitFor([&] { return !w.view()->picture().isNull(); }, longest)) return false;
  PictureDialog* dialog = ask(w, "saveStack");
  dialog->findChild<QComboBox*>(QStringLiteral("pictureSize"))->setCurrentIndex(wide);
  set(dialog, "pictureWidth", 3000);
  accept(dialog);
  answer(w, "pictureFilesDialog", folder);
  return QTest::qWaitFor([&] { return w.child<QWidget>("cancelTask")->isVisible(); }, longest);
}

}  // namespace

class TestPictureRuns : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void itIsWhatWasSeenAsOneWasAsked();
  void numbersAreThoseOfThePicture();
  void whatIsCancelledLeavesNothing();
  void whatIsBeingWrittenIsWrittenToItsEnd();
  void theWindowAsksBeforePicturesAreLost();
  void whereNothingCanBeWrittenIsTold();

 private:
  QString at(const char* name) const { return folder_.filePath(QLatin1String(name)); }
  QTemporaryDir folder_;
};

// If the view changes while the dialog is open, the picture is neither the new slice nor empty.
void TestPictureRuns::itIsWhatWasSeenAsOneWasAsked() {
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  const QImage seen = w.view()->capture();
  PictureDialog* dialog = ask(w, "saveSizedPicture");
  w.view()->scroll(5);
  accept(dialog);
  answer(w, "pictureFilesDialog", at("asked.png"));
  QCOMPARE(written(at("asked.png")), seen);
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  dialog = ask(w, "saveSizedPicture");
  w.session().change(QStringLiteral("test"), [](Workspace& all) {
    for (const ViewId id : viewsOnScreen(all)) all.editView(id).series = {};
  });
  accept(dialog);
  QVERIFY2(w.child<QFileDialog>("pictureFilesDialog"), "it asks where to");
}

// A region measures two series. The overlay is removed once the picture is made.
void TestPictureRuns::numbersAreThoseOfThePicture() {
  const LoadedSeriesPtr pet = petIn("A");
  MeasureWindow w(ballIn("A"));
  w.session().keep(pet);
  w.session().change(QStringLiteral("test"), withOverlay(w.session().workspace(), axialViewId, &pet->series));
  w.draw(ShapeKind::rectangle, w.placesWithin(placesOf(ShapeKind::rectangle), {0, 0, 0}, 6));
  w.session().select(0);
  QTRY_VERIFY_WITH_TIMEOUT(w.view()->isMeasured(), longest);
  QVERIFY(w.drawn(w.last().id).text.join(u'\n').contains(QStringLiteral("SUVpeak")));
  const QImage seen = w.view()->capture();
  accept(ask(w, "saveSizedPicture"));
  w.session().change(QStringLiteral("test"), withOverlay(w.session().workspace(), axialViewId, nullptr));
  QTRY_VERIFY_WITH_TIMEOUT(w.view()->isMeasured(), longest);
  QVERIFY(!w.drawn(w.last().id).text.join(u'\n').contains(QStringLiteral("SUVpeak")));
  answer(w, "pictureFilesDialog", at("both.png"));
  QCOMPARE(written(at("both.png")), seen);
}

void TestPictureRuns::whatIsCancelledLeavesNothing() {
  const QTemporaryDir folder;
  MeasureWindow w(ballSeries(96, 30));
  QVERIFY(isSavingStack(w, folder.path()));
  QVERIFY(w.child<QLabel>("taskText")->text().startsWith(QStringLiteral("Saving pictures")));
  QTest::mouseClick(w.child<QWidget>("cancelTask"), Qt::LeftButton);
  QTRY_COMPARE_WITH_TIMEOUT(w.child<Banner>("banner")->sentence(),
                            QStringLiteral("Interrupted; nothing was written."), longest);
  const auto all = QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot;
  QTRY_COMPARE_WITH_TIMEOUT(QDir(folder.path()).entryList(all), QStringList(), longest);
}

// The last act of an export cannot be cancelled, and says so.
void TestPictureRuns::whatIsBeingWrittenIsWrittenToItsEnd() {
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  std::atomic<bool> isWriting = false, mayEnd = false;
  PictureSink sink = keptIn(std::make_shared<std::vector<MadePicture>>());
  sink.finish = [&](std::size_t) {
    isWriting = true;
    while (!mayEnd) QThread::msleep(1);
    return Result(QString());
  };
  Exports exports(w.window.jobs());
  QSignalSpy done(&exports, &Exports::done), failed(&exports, &Exports::failed);
  exports.run(
      {QStringLiteral("Saving pictures"),
       flatPictures(*w.window.views(), {heldNow({w.session().workspace(), axialViewId}, w.session())}, {}),
       sink});
  const auto rows = [&] { return w.window.jobs().rows(); };
  QCOMPARE(rows().size(), std::size_t(1));
  QVERIFY(rows()[0].canBeCancelled);
  QTRY_VERIFY_WITH_TIMEOUT(isWriting, longest);
  const bool isListed = rows().size() == 1 && !rows()[0].canBeCancelled;
  if (isListed) w.window.jobs().cancel(rows()[0].id);
  mayEnd = true;
  QVERIFY(isListed && failed.isEmpty());
  QTRY_COMPARE_WITH_TIMEOUT(done.count(), 1, longest);
}

void TestPictureRuns::theWindowAsksBeforePicturesAreLost() {
  const QTemporaryDir folder;
  MeasureWindow w(ballSeries(96, 30));
  QVERIFY(isSavingStack(w, folder.path()));
  QVERIFY(!w.window.close());
  auto* box = w.child<QMessageBox>("closeBox");
  QVERIFY(box->text().contains(QStringLiteral("pictures that are being written")));
  box->reject();
  QTest::mouseClick(w.child<QWidget>("cancelTask"), Qt::LeftButton);
  QTRY_COMPARE_WITH_TIMEOUT(w.child<Banner>("banner")->sentence(),
                            QStringLiteral("Interrupted; nothing was written."), longest);
}

void TestPictureRuns::whereNothingCanBeWrittenIsTold() {
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  accept(ask(w, "saveSizedPicture"));
  answer(w, "pictureFilesDialog", QStringLiteral("/proc/no/where.png"));
  auto* banner = w.child<Banner>("banner");
  QTRY_VERIFY_WITH_TIMEOUT(banner->isVisible(), longest);
  QVERIFY(banner->sentence().contains(QStringLiteral("/proc/no/where.png")));
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  banner->hide();
  accept(ask(w, "saveStack"));
  answer(w, "pictureFilesDialog", QStringLiteral("/proc"));
  QTRY_COMPARE_WITH_TIMEOUT(banner->sentence(),
                            QStringLiteral("Cannot write into /proc: choose another folder."), longest);
}

VOLUMEN_TEST(TestPictureRuns);
#include "tst_picture_runs.moc"
