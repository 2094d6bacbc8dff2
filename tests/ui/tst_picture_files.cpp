// Guards what files of pictures hold, pixel by pixel: a slice or a frame as on screen, all of it at its own
// pixels, at any width; a whole stack, a file for each place; a contact sheet. What is done in the window
// meanwhile changes none of it, and nothing of it changes the workspace; what is cancelled leaves nothing.
#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QThread>
#include <atomic>

#include "tests/ui/frames_window.h"
#include "tests/ui/measure_window.h"
#include "tests/ui/two_series.h"
#include "ui/overlays/slice_sheet.h"
#include "ui/panels/picture_dialog.h"
#include "ui/views/picture_run.h"
#include "ui/widgets/banner.h"
#include "ui/workspace/text.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

enum Size { asSeen, own, wide };

QImage rgb(const QImage& image) { return image.convertToFormat(QImage::Format_RGB32); }

// The dialog of an action.
PictureDialog* ask(Journey& w, const char* action) {
  w.child<QAction>(action)->trigger();
  for (auto* dialog : w.window.findChildren<PictureDialog*>())
    if (dialog->isVisible()) return dialog;
  return nullptr;
}

void set(QDialog* dialog, const char* spin, int value) {
  dialog->findChild<QSpinBox*>(QLatin1String(spin))->setValue(value);
}

void tick(QDialog* dialog, const char* box, bool on) {
  dialog->findChild<QCheckBox*>(QLatin1String(box))->setChecked(on);
}

void accept(QDialog* dialog) {
  QTest::mouseClick(dialog->findChild<QPushButton*>(QStringLiteral("pictureSave")), Qt::LeftButton);
}

// What the file holds once it is there.
QImage written(const QString& path) {
  return QTest::qWaitFor([&] { return QFile::exists(path); }, longest) ? rgb(QImage(path)) : QImage();
}

QImage saved(Journey& w, const QString& path, Size size, int width, bool texts, bool hidden = false) {
  PictureDialog* dialog = ask(w, "saveSizedPicture");
  dialog->findChild<QComboBox*>(QStringLiteral("pictureSize"))->setCurrentIndex(size);
  if (size == wide) set(dialog, "pictureWidth", width);
  tick(dialog, "pictureTexts", texts);
  tick(dialog, "pictureHideNames", hidden);
  accept(dialog);
  answer(w, "pictureFilesDialog", path);
  const QImage image = written(path);
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  return image;
}

// The one that is put in place of the picture on screen where texts are left out.
QImage plain(const FlatView& view, QSize pixels) {
  const auto drawn = drawSlice(*view.requestFor(pixels));
  return drawn ? rgb(*drawn) : QImage();
}

void goTo(FlatView* view, int place) { view->scroll(place - view->place().index); }

// To the slice of a number, by what the corner says.
bool showNumber(FlatView* view, int number) {
  for (int place = 0; place < view->place().count; ++place) {
    goTo(view, place);
    const QStringList lines = view->overlays().topRight;
    if (lines.contains(QStringLiteral("%1 / %2").arg(number).arg(view->place().count))) return true;
  }
  return false;
}

}  // namespace

class TestPictureFiles : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsSeenIsWhatIsSaved_data();
  void whatIsSeenIsWhatIsSaved();
  void aFrameIsSavedAsItIsSeen();
  void ownPixelsAreThoseOfTheFile_data();
  void ownPixelsAreThoseOfTheFile();
  void aFrameHasItsOwnPixels();
  void itIsAsWideAsWanted();
  void textsAreWrittenOverThePictureItself();
  void namesAreHiddenInTheFileAlone();
  void itIsWhatWasSeenThen();
  void itIsWhatWasSeenAsOneWasAsked();
  void aSeriesThatIsClosedMeanwhileIsPictured();
  void numbersAreThoseOfThePicture();
  void aStackIsAFileForEachPlace();
  void aReformattedStackCountsPlaces();
  void aStackOfFramesIsAFileForEachFrame();
  void whatIsCancelledLeavesNothing();
  void whatIsBeingWrittenIsWrittenToItsEnd();
  void theWindowAsksBeforePicturesAreLost();
  void whereNothingCanBeWrittenIsTold();
  void aSheetHoldsPicturesInRowsAndColumns_data();
  void aSheetHoldsPicturesInRowsAndColumns();
  void theHeadHoldsForAllPictures_data();
  void theHeadHoldsForAllPictures();
  void onlyFlatViewsHaveThem();

 private:
  QString at(const char* name) const { return folder_.filePath(QLatin1String(name)); }
  QTemporaryDir folder_;
};

void TestPictureFiles::whatIsSeenIsWhatIsSaved_data() {
  QTest::addColumn<int>("view");
  QTest::addColumn<bool>("texts");
  QTest::newRow("axial, with what is measured") << axialViewId << true;
  QTest::newRow("coronal") << coronalViewId << true;
  QTest::newRow("sagittal, without a text") << sagittalViewId << false;
}

void TestPictureFiles::whatIsSeenIsWhatIsSaved() {
  QFETCH(int, view);
  QFETCH(bool, texts);
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view(view)->picture().isNull(), longest);
  w.draw(ShapeKind::length, {{60, 60}, {120, 90}});
  w.session().select(0);
  w.session().setFocus(view);
  const Workspace before = w.session().workspace();
  const int steps = w.session().undoStack().count();
  const QImage image = saved(w, at(QTest::currentDataTag()) + QStringLiteral(".png"), asSeen, 0, texts);
  const QImage seen = texts ? w.view(view)->capture() : plain(*w.view(view), w.view(view)->pixels());
  QCOMPARE(image, seen);
  QCOMPARE(w.session().undoStack().count(), steps);
  QVERIFY(w.session().workspace() == before);
}

void TestPictureFiles::aFrameIsSavedAsItIsSeen() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  w.session().setFocus(axialViewId);
  QCOMPARE(saved(w, at("frame.png"), asSeen, 0, true), w.view()->capture());
}

void TestPictureFiles::ownPixelsAreThoseOfTheFile_data() {
  QTest::addColumn<int>("view");
  QTest::addColumn<double>("sliceMm");
  QTest::newRow("axial") << axialViewId << 1.0;
  QTest::newRow("axial of thick slices") << axialViewId << 3.0;
  QTest::newRow("coronal") << coronalViewId << 1.0;
  QTest::newRow("sagittal") << sagittalViewId << 1.0;
}

// Values of 0 and 1000 under a window of 0 to 1000 are black and white: each pixel is the voxel that lies
// under its centre, however the view is zoomed.
void TestPictureFiles::ownPixelsAreThoseOfTheFile() {
  QFETCH(int, view);
  QFETCH(double, sliceMm);
  constexpr int n = 32;
  const LoadedSeriesPtr series = ballSeries(n, 10, {3, -2, 4}, {1, 1, sliceMm});
  MeasureWindow w(series);
  w.session().setFocus(view);
  w.session().change(QStringLiteral("test"), [&](Workspace& all) {
    all.series.edit(keyOf(series->series)).window = Window{500, 1000};
    FlatLook& look = all.editView(view).flats.editOrAdd(keyOf(series->series));
    look.zoom = 3.3;
    look.panMm = {7, -5};
  });
  const QImage image = saved(w, at(QTest::currentDataTag()) + QStringLiteral(".png"), own, 0, false);
  QCOMPARE(image.size(), QSize(n, n));
  const Volume& volume = *series->volume;
  const SlicePlane plane = *w.view(view)->plane();
  const glm::dvec3 middle = volume.geometry().centre();
  const glm::dvec3 centre = middle + plane.normal() * glm::dot(plane.centre - middle, plane.normal());
  int white = 0;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const glm::dvec3 p = centre + (x + 0.5 - n / 2) * plane.right + (y + 0.5 - n / 2) * plane.down;
      const glm::ivec3 voxel(glm::round(volume.geometry().voxelFromPatient(p)));
      const bool isBall = volume.value(voxel.x, voxel.y, voxel.z) > 500;
      white += isBall;
      QCOMPARE(qGray(image.pixel(x, y)), isBall ? 255 : 0);
    }
  QVERIFY(white > 100);
}

// As many as the file has, in squares of the smaller edge; a view of the same size shows the same.
void TestPictureFiles::aFrameHasItsOwnPixels() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  w.session().setFocus(axialViewId);
  const VoxelGeometry& geometry = frameIn(w.view())->geometry();
  const glm::dvec2 mm(geometry.spacing()), size = glm::dvec2(geometry.size) * mm / std::min(mm.x, mm.y);
  const QSize pixels(int(std::ceil(size.x - 1e-6)), int(std::ceil(size.y - 1e-6)));
  const QImage image = saved(w, at("own.png"), own, 0, false);
  QCOMPARE(image.size(), pixels);
  const auto whole = drawSlice(*w.view()->requestForOwnPixels());
  QVERIFY(whole);
  QCOMPARE(image, rgb(*whole));
}

void TestPictureFiles::itIsAsWideAsWanted() {
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  const QSize seen = w.view()->pixels();
  const QSize twice = 2 * seen;
  QCOMPARE(saved(w, at("same.png"), wide, seen.width(), true), w.view()->capture());
  QCOMPARE(saved(w, at("twice.png"), wide, twice.width(), false), plain(*w.view(), twice));
  const QImage withTexts = saved(w, at("texts.png"), wide, twice.width(), true);
  QCOMPARE(withTexts.size(), twice);
  QVERIFY(withTexts != plain(*w.view(), twice));
}

// As they are in a picture of the same size on screen; nothing of the picture is copied, however large it is.
void TestPictureFiles::textsAreWrittenOverThePictureItself() {
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  QCOMPARE(w.view()->captureWith(plain(*w.view(), w.view()->pixels())), w.view()->capture());
  QImage picture = plain(*w.view(), 3 * w.view()->pixels());
  const uchar* pixels = picture.constBits();
  const QImage with = w.view()->captureWith(std::move(picture));
  QCOMPARE(with.constBits(), pixels);
}

void TestPictureFiles::namesAreHiddenInTheFileAlone() {
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  const QImage named = w.view()->capture();
  const QImage hidden = saved(w, at("hidden.png"), asSeen, 0, true, true);
  QVERIFY(!namesHidden());
  QCOMPARE(w.view()->capture(), named);
  w.child<QAction>("hideNames")->trigger();
  QCOMPARE(hidden, w.view()->capture());
  w.child<QAction>("hideNames")->trigger();
  QVERIFY(hidden != named);
}

// Not what is scrolled to while a place is chosen.
void TestPictureFiles::itIsWhatWasSeenThen() {
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  const QImage seen = w.view()->capture();
  accept(ask(w, "saveSizedPicture"));
  w.view()->scroll(5);
  QVERIFY(w.view()->capture() != seen);
  answer(w, "pictureFilesDialog", at("then.png"));
  QCOMPARE(written(at("then.png")), seen);
}

// Not what is scrolled to, nor nothing, where the view changes while the dialog is open.
void TestPictureFiles::itIsWhatWasSeenAsOneWasAsked() {
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

void TestPictureFiles::aSeriesThatIsClosedMeanwhileIsPictured() {
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  const QImage seen = plain(*w.view(), w.view()->pixels());
  PictureDialog* dialog = ask(w, "saveSizedPicture");
  tick(dialog, "pictureTexts", false);
  accept(dialog);
  w.session().close({w.view()->state().series});
  QVERIFY(w.session().workspace().series.empty());
  answer(w, "pictureFilesDialog", at("closed.png"));
  QCOMPARE(written(at("closed.png")), seen);
}

// A region of two series, one of which lies over the other no more once the picture is made.
void TestPictureFiles::numbersAreThoseOfThePicture() {
  const LoadedSeriesPtr pet = petIn("A");
  MeasureWindow w(ballIn("A"));
  w.session().keep(pet);
  w.session().change(QStringLiteral("test"), withOverlay(w.session().workspace(), axialViewId, &pet->series));
  w.draw(ShapeKind::rectangle, {{70, 60}, {131, 111}});
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

void TestPictureFiles::aStackIsAFileForEachPlace() {
  const QTemporaryDir folder;
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  w.draw(ShapeKind::length, {{60, 60}, {120, 90}});
  w.session().select(0);
  for (const char* name : {"CT Ball", "CT Ball (2)"}) {
    PictureDialog* dialog = ask(w, "saveStack");
    set(dialog, "pictureFirst", 3);
    set(dialog, "pictureLast", 9);
    set(dialog, "pictureEvery", 2);
    QCOMPARE(dialog->findChild<QLabel*>(QStringLiteral("pictureCount"))->text(),
             QStringLiteral("4 pictures, every 2."));
    accept(dialog);
    answer(w, "pictureFilesDialog", folder.path());
    QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(folder.filePath(QLatin1String(name))), longest);
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  }
  const QDir made(folder.filePath(QStringLiteral("CT Ball")));
  const QTemporaryDir another;
  QVERIFY(QDir(another.path()).mkdir(QStringLiteral("usual")));
  QCOMPARE(QFileInfo(made.path()).permissions(),
           QFileInfo(another.filePath(QStringLiteral("usual"))).permissions());
  QCOMPARE(made.entryList(QDir::Files),
           QStringList({QStringLiteral("CT Ball-0003.png"), QStringLiteral("CT Ball-0005.png"),
                        QStringLiteral("CT Ball-0007.png"), QStringLiteral("CT Ball-0009.png")}));
  QCOMPARE(w.child<QLabel>("toldText")->text().section(QLatin1Char('/'), 0, 0),
           QStringLiteral("Saved 4 pictures in "));
  for (const int number : {3, 5, 7, 9}) {
    QVERIFY(showNumber(w.view(), number));
    QVERIFY2(w.view()->place().index != number - 1, "the wheel counts from the other end");
    const QImage file(made.filePath(QStringLiteral("CT Ball-000%1.png").arg(number)));
    QCOMPARE(rgb(file), w.view()->capture());
  }
  QTRY_COMPARE_WITH_TIMEOUT(
      QDir(folder.path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot).size(), 2,
      longest);
}

void TestPictureFiles::aReformattedStackCountsPlaces() {
  const QTemporaryDir folder;
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view(coronalViewId)->picture().isNull(), longest);
  w.session().setFocus(coronalViewId);
  PictureDialog* dialog = ask(w, "saveStack");
  QCOMPARE(dialog->findChild<QSpinBox*>(QStringLiteral("pictureLast"))->suffix(), QStringLiteral(" of 32"));
  set(dialog, "pictureFirst", 8);
  set(dialog, "pictureLast", 8);
  accept(dialog);
  answer(w, "pictureFilesDialog", folder.path());
  const QString path = folder.filePath(QStringLiteral("CT Ball/CT Ball-0008.png"));
  const QImage file = written(path);
  goTo(w.view(coronalViewId), 7);
  QCOMPARE(file, w.view(coronalViewId)->capture());
}

void TestPictureFiles::aStackOfFramesIsAFileForEachFrame() {
  NEED_FILES();
  const QTemporaryDir folder;
  Frames w({clipFile});
  QVERIFY(w.shows());
  w.session().setFocus(axialViewId);
  PictureDialog* dialog = ask(w, "saveStack");
  set(dialog, "pictureLast", 3);
  accept(dialog);
  answer(w, "pictureFilesDialog", folder.path());
  const auto made = [&] { return QDir(folder.path()).entryList(QDir::Dirs | QDir::NoDotAndDotDot); };
  QTRY_COMPARE_WITH_TIMEOUT(made().size(), 1, longest);
  const QDir files(folder.filePath(made().front()));
  QCOMPARE(files.entryList(QDir::Files).size(), 3);
  for (int n = 0; n < 3; ++n) {
    if (n > 0) QVERIFY(w.after([&] { w.view()->scroll(1); }));
    QVERIFY(w.shows());
    QCOMPARE(rgb(QImage(files.filePath(files.entryList(QDir::Files)[n]))), w.view()->capture());
  }
}

void TestPictureFiles::whatIsCancelledLeavesNothing() {
  const QTemporaryDir folder;
  MeasureWindow w(ballSeries(96, 30));
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  PictureDialog* dialog = ask(w, "saveStack");
  dialog->findChild<QComboBox*>(QStringLiteral("pictureSize"))->setCurrentIndex(wide);
  set(dialog, "pictureWidth", 3000);
  accept(dialog);
  answer(w, "pictureFilesDialog", folder.path());
  QTRY_VERIFY_WITH_TIMEOUT(w.child<QWidget>("cancelTask")->isVisible(), longest);
  QVERIFY(w.child<QLabel>("taskText")->text().startsWith(QStringLiteral("Saving pictures")));
  QTest::mouseClick(w.child<QWidget>("cancelTask"), Qt::LeftButton);
  QTRY_COMPARE_WITH_TIMEOUT(w.child<Banner>("banner")->sentence(),
                            QStringLiteral("Interrupted; nothing was written."), longest);
  const auto all = QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot;
  QTRY_COMPARE_WITH_TIMEOUT(QDir(folder.path()).entryList(all), QStringList(), longest);
}

// The last that is done cannot be cancelled, and says so.
void TestPictureFiles::whatIsBeingWrittenIsWrittenToItsEnd() {
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  Session& session = w.session();
  auto* run = new PictureRun(*w.window.views(), session, w.window.jobs(), QStringLiteral("Saving pictures"),
                             {{session.workspace(), axialViewId}}, {});  // deletes itself
  std::atomic<bool> isWriting = false, mayEnd = false;
  QSignalSpy ended(run, &PictureRun::ended);
  run->start([](std::size_t, const MadePicture&) { return Status(); },
             [&] {
               isWriting = true;
               while (!mayEnd) QThread::msleep(1);
               return Status();
             });
  const auto rows = [&] { return w.window.jobs().rows(); };
  QCOMPARE(rows().size(), std::size_t(1));
  QVERIFY(rows()[0].canBeCancelled);
  QTRY_VERIFY_WITH_TIMEOUT(isWriting, longest);
  const bool isListed = rows().size() == 1 && !rows()[0].canBeCancelled;
  if (isListed) w.window.jobs().cancel(rows()[0].id);
  const bool goesOn = !run->hasEnded();
  mayEnd = true;
  QVERIFY(isListed && goesOn);
  QTRY_COMPARE_WITH_TIMEOUT(ended.count(), 1, longest);
  QCOMPARE(ended[0][0].toString(), QString());
}

void TestPictureFiles::theWindowAsksBeforePicturesAreLost() {
  const QTemporaryDir folder;
  MeasureWindow w(ballSeries(96, 30));
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  PictureDialog* dialog = ask(w, "saveStack");
  dialog->findChild<QComboBox*>(QStringLiteral("pictureSize"))->setCurrentIndex(wide);
  set(dialog, "pictureWidth", 3000);
  accept(dialog);
  answer(w, "pictureFilesDialog", folder.path());
  QTRY_VERIFY_WITH_TIMEOUT(w.child<QWidget>("cancelTask")->isVisible(), longest);
  QVERIFY(!w.window.close());
  auto* box = w.child<QMessageBox>("closeBox");
  QVERIFY(box->text().contains(QStringLiteral("pictures that are being written")));
  box->reject();
  QTest::mouseClick(w.child<QWidget>("cancelTask"), Qt::LeftButton);
  QTRY_COMPARE_WITH_TIMEOUT(w.child<Banner>("banner")->sentence(),
                            QStringLiteral("Interrupted; nothing was written."), longest);
}

void TestPictureFiles::whereNothingCanBeWrittenIsTold() {
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

void TestPictureFiles::aSheetHoldsPicturesInRowsAndColumns_data() {
  QTest::addColumn<int>("rows");
  QTest::addColumn<int>("columns");
  QTest::addColumn<int>("last");
  QTest::addColumn<int>("every");
  QTest::addColumn<bool>("texts");
  QTest::newRow("all of the stack") << 2 << 3 << 32 << 6 << false;
  QTest::newRow("with texts") << 2 << 3 << 32 << 6 << true;
  QTest::newRow("more room than slices") << 4 << 5 << 7 << 1 << false;
  QTest::newRow("the last row is not full") << 3 << 3 << 32 << 4 << false;
}

void TestPictureFiles::aSheetHoldsPicturesInRowsAndColumns() {
  QFETCH(int, rows);
  QFETCH(int, columns);
  QFETCH(int, last);
  QFETCH(int, every);
  QFETCH(bool, texts);
  constexpr int width = 120;
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  PictureDialog* dialog = ask(w, "saveSheet");
  for (const auto& [name, value] : {std::pair("sheetRows", rows),
                                    {"sheetColumns", columns},
                                    {"pictureLast", last},
                                    {"pictureWidth", width}})
    set(dialog, name, value);
  tick(dialog, "pictureTexts", texts);
  accept(dialog);
  const QString path = at(QTest::currentDataTag()) + QStringLiteral(".png");
  answer(w, "pictureFilesDialog", path);
  const QImage sheet = written(path);
  const QSize seen = w.view()->pixels();
  const QSize tile = (QSizeF(seen) * (double(width) / seen.width())).toSize();
  const int count = (last - 1) / every + 1;
  const SliceSheet same((count + columns - 1) / columns, columns, tile, {});
  // Texts make the sheet higher; they lie above the pictures and in their lower half.
  const int above = sheet.height() - same.image().height();
  QVERIFY(texts ? above > 10 : above == 0);
  QCOMPARE(sheet.width(), same.image().width());
  for (int n = 0; n < count; ++n) {
    QVERIFY(showNumber(w.view(), n * every + 1));
    const int height = texts ? tile.height() / 2 : tile.height();
    const QImage expected = plain(*w.view(), tile).copy(0, 0, tile.width(), height);
    QCOMPARE(sheet.copy(same.placeOf(n).translated(0, above)).copy(0, 0, tile.width(), height), expected);
  }
}

void TestPictureFiles::theHeadHoldsForAllPictures_data() {
  QTest::addColumn<FrameWindow>("window");
  QTest::addColumn<int>("more");
  QTest::newRow("one window for all of them") << FrameWindow::ofSeries << 1;
  QTest::newRow("each has its own") << FrameWindow::ofEach << 0;
}

// So many lines more than those of patient and series.
void TestPictureFiles::theHeadHoldsForAllPictures() {
  NEED_FILES();
  QFETCH(FrameWindow, window);
  QFETCH(int, more);
  constexpr int width = 200;
  Frames w({"xa-96frames.dcm"});
  QVERIFY(w.shows());
  w.session().setFocus(axialViewId);
  w.session().change(QStringLiteral("test"), [&](Workspace& all) {
    all.series.edit(all.view(axialViewId).series).frameWindow = window;
  });
  PictureDialog* dialog = ask(w, "saveSheet");
  for (const auto& [name, value] :
       {std::pair("sheetRows", 1), {"sheetColumns", 2}, {"pictureLast", 2}, {"pictureWidth", width}})
    set(dialog, name, value);
  accept(dialog);
  const QString path = at(QTest::currentDataTag()) + QStringLiteral(".png");
  answer(w, "pictureFilesDialog", path);
  const QImage sheet = written(path);
  const QSize seen = w.view()->pixels();
  const QSize tile = (QSizeF(seen) * (double(width) / seen.width())).toSize();
  QStringList head = w.view()->overlays().topLeft;
  QVERIFY(!head.isEmpty() && !w.view()->overlays().bottomRight.isEmpty());
  for (int n = 0; n < more; ++n) head << QString();
  QCOMPARE(sheet.size(), SliceSheet(1, 2, tile, head).image().size());
}

void TestPictureFiles::onlyFlatViewsHaveThem() {
  MeasureWindow w;
  auto* banner = w.child<Banner>("banner");
  w.session().setFocus(sceneViewId);
  for (const char* action : {"saveSizedPicture", "saveStack", "saveSheet"}) {
    banner->hide();
    QVERIFY(!ask(w, action));
    QVERIFY(banner->sentence().startsWith(QStringLiteral("Click a slice or a frame first.")));
  }
  Journey empty;
  empty.child<QAction>("saveStack")->trigger();
  QCOMPARE(empty.child<Banner>("banner")->sentence(), QStringLiteral("Open a series first."));
}

VOLUMEN_TEST(TestPictureFiles);
#include "tst_picture_files.moc"
