// Guards picture files, pixel by pixel: a slice or frame as on screen, at its own pixels or at any width.
// Also guards a whole stack with one file for each position, and a contact sheet. None changes the workspace.
#include <QLabel>
#include <QTemporaryDir>

#include "results/text/text.h"
#include "tests/ui/frames_window.h"
#include "tests/ui/measure_window.h"
#include "tests/ui/picture_window.h"
#include "ui/overlays/slice_sheet.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

class TestPictureFiles : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsSeenIsWhatIsSaved_data();
  void whatIsSeenIsWhatIsSaved();
  void aFrameIsSavedAsItIsSeen();
  void ownPixelsAreThoseOfTheFile_data();
  void ownPixelsAreThoseOfTheFile();
  void aFrameHasItsOwnPixels();
  void aWindowAloneIsThatOfItsPictures();
  void itIsAsWideAsWanted();
  void textsAreWrittenOverThePictureItself();
  void namesAreHiddenInTheFileAlone();
  void aStackIsAFileForEachPlace();
  void aStackOfFramesIsAFileForEachFrame();
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

// Values of 0 and 1000 in a window of 0 to 1000 are black and white. Each pixel is the voxel under its
// centre, however the view is zoomed.
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
  // The folder also holds files of other functions' rows with the same names.
  const QImage image =
      saved(w, at(QTest::currentDataTag()) + QStringLiteral(" own pixels.png"), own, 0, false);
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

// The picture has as many pixels as the file, as squares of the smaller edge. A view of the same size shows
// the same.
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

// Air in one view by the lung window, and in another by the series window 40 / 400, within one grey level.
void TestPictureFiles::aWindowAloneIsThatOfItsPictures() {
  MeasureWindow w(ballSeries(32, 10, {0, 0, 0}));
  w.child<QAction>("windowAlone")->trigger();
  QTest::keyClick(w.view(), Qt::Key_6);
  QTRY_VERIFY_WITH_TIMEOUT(w.view()->picture().size() == w.view()->pixels(), longest);
  const auto grey = [](Window window) { return 255 * (0.5 - window.centre / window.width); };
  const auto airIn = [&](const char* name) { return qGray(saved(w, at(name), own, 0, false).pixel(0, 0)); };
  QVERIFY(std::abs(airIn("alone.png") - grey({-600, 1500})) <= 1);
  w.session().setFocus(coronalViewId);
  QVERIFY(std::abs(airIn("not alone.png") - grey({40, 400})) <= 1);
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

// Texts are those of a picture of the same size on screen. The picture is not copied, however large it is.
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
    QVERIFY2(w.view()->stack().place.index != number - 1, "the wheel counts from the other end");
    const QImage file(made.filePath(QStringLiteral("CT Ball-000%1.png").arg(number)));
    QCOMPARE(rgb(file), w.view()->capture());
  }
  QTRY_COMPARE_WITH_TIMEOUT(
      QDir(folder.path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot).size(), 2,
      longest);
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
  // Texts make the sheet higher. They lie above the pictures and in their lower half.
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

// `more` is the number of header lines beyond those of patient and series.
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
