// Guards pages of key images. Each picture appears once, each study on separate pages, with the chosen number
// per page. Pictures have true size where they fit, measured in the PDF and on paper.
#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPdfWriter>
#include <QPrintDialog>
#include <QPushButton>
#include <QTemporaryDir>

#include "results/text/text.h"
#include "tests/ui/derived_2d.h"
#include "tests/ui/measure_window.h"
#include "tests/ui/pdf_images.h"
#include "tests/unit/suite.h"
#include "ui/overlays/picture_pages.h"
#include "ui/panels/pages_dialog.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Relative tolerance of a length on paper, which is written with few digits.
constexpr double sizeWithin = 0.005;

// Returns a ball whose slices are those of a DICOM series.
LoadedSeriesPtr dicomBall(const char* patient = "42", double spacing = 1) {
  auto series = std::make_shared<LoadedSeries>(*ballSeries(32, 10, {0, 0, 0}, glm::dvec3(spacing)));
  series->series.patientId = patient;
  for (int n = 0; n < 32; ++n) {
    series->series.sopInstanceUids.push_back(series->series.id + "." + std::to_string(n));
    series->series.frames.push_back(0);
  }
  return series;
}

// Marks `count` slices as key images, from the current one.
void mark(MeasureWindow& w, int count) {
  w.view()->setFocus();
  for (int n = 0; n < count; ++n) {
    QTest::keyClick(&w.window, Qt::Key_K);
    w.view()->scroll(1);
  }
}

PagesDialog* ask(Journey& w, int perPage, bool inTrueSize) {
  w.child<QAction>("keyImagePages")->trigger();
  for (auto* dialog : w.window.findChildren<PagesDialog*>()) {
    if (!dialog->isVisible()) continue;
    dialog->findChild<QComboBox*>(QStringLiteral("pagesPictures"))->setCurrentText(QString::number(perPage));
    dialog->findChild<QCheckBox*>(QStringLiteral("pagesTrueSize"))->setChecked(inTrueSize);
    return dialog;
  }
  return nullptr;
}

void press(QDialog* dialog, const char* button) {
  QTest::mouseClick(dialog->findChild<QPushButton*>(QLatin1String(button)), Qt::LeftButton);
}

// Saves the pages as a PDF and returns their image rectangles.
std::vector<std::vector<QRectF>> saved(Journey& w, int perPage, bool inTrueSize, const QString& path,
                                       bool namesHidden = false) {
  PagesDialog* dialog = ask(w, perPage, inTrueSize);
  dialog->findChild<QCheckBox*>(QStringLiteral("pagesHideNames"))->setChecked(namesHidden);
  press(dialog, "pagesPdf");
  answer(w, "pagesFileDialog", path);
  const bool isThere = QTest::qWaitFor([&] { return QFile::exists(path); }, longest);
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  return isThere ? pagesIn(path) : std::vector<std::vector<QRectF>>();
}

bool isAbout(double mm, double wanted) { return std::abs(mm / wanted - 1) < sizeWithin; }

}  // namespace

class TestKeyImagePages : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void pagesHaveSoManyPlaces_data();
  void pagesHaveSoManyPlaces();
  void picturesLieInTheirPlaces_data();
  void picturesLieInTheirPlaces();
  void trueSizeSaysWhoseMmItIs_data();
  void trueSizeSaysWhoseMmItIs();
  void pagesAreMadeAsTheyArePainted();
  void soManyStandOnAPage_data();
  void soManyStandOnAPage();
  void picturesAreTheSlicesThatTheyName();
  void namesAreHiddenOnPages();
  void trueSizeIsMeasured_data();
  void trueSizeIsMeasured();
  void onPaperToo();
  void whatDoesNotFitIsAsLargeAsItsPlace();
  void eachStudyHasPagesOfItsOwn();
  void picturesOfDocumentsAreThere();
  void whatCannotBeWrittenIsTold();
  void withoutKeyImagesThereIsASentence();

 private:
  QString at(const char* name) const {
    return folder_.filePath(QLatin1String(name)) + QStringLiteral(".pdf");
  }
  QTemporaryDir folder_;
};

void TestKeyImagePages::pagesHaveSoManyPlaces_data() {
  QTest::addColumn<int>("perPage");
  QTest::addColumn<QSize>("upright");
  QTest::newRow("1") << 1 << QSize(1, 1);
  QTest::newRow("2") << 2 << QSize(1, 2);
  QTest::newRow("4") << 4 << QSize(2, 2);
  QTest::newRow("6") << 6 << QSize(2, 3);
  QTest::newRow("9") << 9 << QSize(3, 3);
  QTest::newRow("12") << 12 << QSize(3, 4);
}

void TestKeyImagePages::pagesHaveSoManyPlaces() {
  QFETCH(int, perPage);
  QFETCH(QSize, upright);
  QCOMPARE(pageGrid(perPage, {190, 270}), upright);
  QCOMPARE(pageGrid(perPage, {270, 190}), upright.transposed());
}

void TestKeyImagePages::picturesLieInTheirPlaces_data() {
  QTest::addColumn<QSizeF>("paper");
  QTest::addColumn<bool>("inTrueSize");
  for (const bool inTrueSize : {false, true}) {
    QTest::addRow("A4%s", inTrueSize ? ", true size" : "") << QSizeF(186, 273) << inTrueSize;
    QTest::addRow("A4 across%s", inTrueSize ? ", true size" : "") << QSizeF(273, 186) << inTrueSize;
    QTest::addRow("a label%s", inTrueSize ? ", true size" : "") << QSizeF(100, 150) << inTrueSize;
  }
}

// Pictures lie on the paper, under the header, without overlap, and whole or in true size.
void TestKeyImagePages::picturesLieInTheirPlaces() {
  QFETCH(QSizeF, paper);
  QFETCH(bool, inTrueSize);
  const QImage image(400, 300, QImage::Format_RGB32);
  for (const int perPage : {1, 2, 4, 6, 9, 12}) {
    const PageLook look{perPage, inTrueSize};
    PicturePage page{{QStringLiteral("Doe, Jane"), QStringLiteral("2026-03-14 CT head")}, {}};
    for (int n = 0; n < perPage; ++n)
      page.pictures.push_back({image, n % 2 ? std::optional(0.05 * n) : std::nullopt, {}});
    for (int n = 0; n < perPage; ++n) {
      const QRectF place = pagePlace(page, n, look, paper);
      QVERIFY(QRectF({0, 8}, QSizeF(paper.width(), paper.height() - 8))
                  .adjusted(-1e-6, 0, 1e-6, 1e-6)
                  .contains(place));
      QVERIFY(std::abs(place.width() / place.height() - 4.0 / 3) < 1e-9);
      for (int other = 0; other < n; ++other) QVERIFY(!place.intersects(pagePlace(page, other, look, paper)));
      const auto mm = page.pictures[std::size_t(n)].mmPerPixel;
      QVERIFY(mm || !isInTrueSize(page, n, look, paper));
      if (isInTrueSize(page, n, look, paper)) QCOMPARE(place.width(), 400 * *mm);
    }
    QCOMPARE(isInTrueSize(page, 1 % perPage, look, paper), inTrueSize && perPage > 1);
  }
}

void TestKeyImagePages::trueSizeSaysWhoseMmItIs_data() {
  QTest::addColumn<double>("mmPerPixel");
  QTest::addColumn<QString>("word");
  QTest::addColumn<QString>("text");
  QTest::newRow("the patient's") << 0.1 << QString() << QStringLiteral("True size");
  QTest::newRow("at the detector") << 0.1 << QStringLiteral("at detector")
                                   << QStringLiteral("True size (at detector)");
  QTest::newRow("too large") << 10.0 << QStringLiteral("at detector")
                             << QStringLiteral("Not true size: too large for its place");
  QTest::newRow("none") << 0.0 << QString() << QStringLiteral("Not true size: not calibrated");
}

void TestKeyImagePages::trueSizeSaysWhoseMmItIs() {
  QFETCH(double, mmPerPixel);
  QFETCH(QString, word);
  QFETCH(QString, text);
  const QImage image(400, 300, QImage::Format_RGB32);
  const auto mm = mmPerPixel > 0 ? std::optional(mmPerPixel) : std::nullopt;
  const PicturePage page{{}, {{image, mm, {}, word}}};
  QCOMPARE(scaleText(page, 0, {1, true}, {186, 273}), text);
  QCOMPARE(scaleText(page, 0, {1, false}, {186, 273}), QString());
}

// Pages are made one by one, so that at most one is in memory.
void TestKeyImagePages::pagesAreMadeAsTheyArePainted() {
  std::vector<std::size_t> made;
  QPdfWriter writer(at("painted"));
  const auto page = [&](std::size_t n) {
    made.push_back(n);
    return PicturePage{{}, {{QImage(40, 30, QImage::Format_RGB32), {}, {}}}};
  };
  QVERIFY(paintPages(writer, {3, page}, {1, false}));
  QCOMPARE(made, (std::vector<std::size_t>{0, 1, 2}));
  QCOMPARE(pagesIn(at("painted")).size(), std::size_t(3));
}

void TestKeyImagePages::soManyStandOnAPage_data() {
  QTest::addColumn<int>("perPage");
  QTest::addColumn<std::vector<int>>("pages");
  QTest::newRow("1 a page") << 1 << std::vector<int>{1, 1, 1, 1, 1};
  QTest::newRow("2 a page") << 2 << std::vector<int>{2, 2, 1};
  QTest::newRow("4 a page") << 4 << std::vector<int>{4, 1};
  QTest::newRow("12 a page") << 12 << std::vector<int>{5};
}

void TestKeyImagePages::soManyStandOnAPage() {
  QFETCH(int, perPage);
  QFETCH(std::vector<int>, pages);
  MeasureWindow w(dicomBall());
  mark(w, 5);
  QCOMPARE(w.session().workspace().keyImages.size(), std::size_t(5));
  const Workspace before = w.session().workspace();
  std::vector<int> made;
  for (const auto& page : saved(w, perPage, false, at(QTest::currentDataTag())))
    made.push_back(int(page.size()));
  QCOMPARE(made, pages);
  QVERIFY(w.session().workspace() == before);
}

void TestKeyImagePages::trueSizeIsMeasured_data() {
  QTest::addColumn<double>("spacing");
  QTest::newRow("32 mm") << 1.0;
  QTest::newRow("80 mm") << 2.5;
}

// Measures a whole slice: 32 pixels of the ball.
void TestKeyImagePages::trueSizeIsMeasured() {
  QFETCH(double, spacing);
  MeasureWindow w(dicomBall("42", spacing));
  mark(w, 3);
  const auto pages = saved(w, 2, true, at(QTest::currentDataTag()));
  QCOMPARE(pages.size(), std::size_t(2));
  for (const auto& page : pages)
    for (const QRectF& mm : page) {
      QVERIFY2(isAbout(mm.width(), 32 * spacing), qPrintable(QString::number(mm.width())));
      QVERIFY2(isAbout(mm.height(), 32 * spacing), qPrintable(QString::number(mm.height())));
    }
}

void TestKeyImagePages::onPaperToo() {
  const QString path = at("paper");
  MeasureWindow w(dicomBall());
  mark(w, 2);
  press(ask(w, 4, true), "pagesPrint");
  auto* dialog = w.child<QPrintDialog>("pagesPrintDialog");
  QVERIFY(dialog);
  auto* name = dialog->findChild<QLineEdit*>(QStringLiteral("filename"));
  QVERIFY(name);
  name->setText(path);
  dialog->accept();
  QTRY_COMPARE_WITH_TIMEOUT(imagesIn(path).size(), std::size_t(2), longest);
  for (const QRectF& mm : imagesIn(path)) QVERIFY(isAbout(mm.width(), 32));
}

void TestKeyImagePages::whatDoesNotFitIsAsLargeAsItsPlace() {
  MeasureWindow w(dicomBall("42", 20));
  mark(w, 1);
  const auto pages = saved(w, 1, true, at("large"));
  QCOMPARE(pages.size(), std::size_t(1));
  const QRectF mm = pages.front().front();
  QVERIFY(mm.width() > 150 && mm.width() < 210);  // of an A4 page's width
  QVERIFY(isAbout(mm.width(), mm.height()));
}

void TestKeyImagePages::eachStudyHasPagesOfItsOwn() {
  const LoadedSeriesPtr first = dicomBall("1"), second = dicomBall("2");
  MeasureWindow w(first);
  mark(w, 2);
  w.session().show(second);
  w.session().setFocus(axialViewId);
  mark(w, 1);
  w.session().show(first);
  w.session().setFocus(axialViewId);
  w.view()->scroll(4);
  mark(w, 1);
  QCOMPARE(w.session().workspace().keyImages.size(), std::size_t(4));
  const auto pages = saved(w, 12, false, at("studies"));
  QCOMPARE(pages.size(), std::size_t(2));
  QCOMPARE(pages[0].size(), std::size_t(3));
  QCOMPARE(pages[1].size(), std::size_t(1));
}

// CT_small has 128 pixels of 0.661468 mm.
void TestKeyImagePages::picturesOfDocumentsAreThere() {
  NEED_REFERENCES();
  References2d w({ct, keyObjects});
  QVERIFY(w.has("Key objects: Of Interest") && w.has("CT (1)", "keyImageList"));
  // With 6 pictures a page, each cell would be lower than the picture.
  const auto pages = saved(w, 4, true, at("document"));
  QCOMPARE(pages.size(), std::size_t(1));
  QVERIFY(isAbout(pages.front().front().width(), 128 * 0.661468));
}

// The slices of the ball differ much. In the middle of the picture, where no text is, each voxel whose
// neighbours are like it is as bright as its value.
void TestKeyImagePages::picturesAreTheSlicesThatTheyName() {
  const LoadedSeriesPtr series = dicomBall();
  MeasureWindow w(series);
  w.session().change(QStringLiteral("test"), [&](Workspace& all) {
    all.series.edit(keyOf(series->series)).window = Window{500, 1000};
  });
  std::vector<int> slices;
  for (const int steps : {0, 8}) {
    w.view()->scroll(steps);
    slices.push_back(w.view()->stack().seen.index.value());
    mark(w, 1);
  }
  saved(w, 2, false, at("slices"));
  const std::vector<QImage> pictures = pixelsIn(at("slices"));
  QCOMPARE(pictures.size(), std::size_t(2));
  const Volume& volume = *series->volume;
  for (std::size_t n = 0; n < 2; ++n) {
    QCOMPARE(pictures[n].size(), QSize(1400, 1400));
    const auto isBall = [&](int i, int j) { return volume.value(i, j, slices[n]) > 500; };
    int compared = 0, wrong = 0;
    for (int j = 7; j < 25; ++j)
      for (int i = 7; i < 25; ++i) {
        const bool isEven = isBall(i, j) == isBall(i - 1, j) && isBall(i, j) == isBall(i + 1, j) &&
                            isBall(i, j) == isBall(i, j - 1) && isBall(i, j) == isBall(i, j + 1);
        if (!isEven) continue;
        const QRgb pixel = pictures[n].pixel(int((i + 0.5) * 1400 / 32), int((j + 0.5) * 1400 / 32));
        ++compared;
        wrong += (qGray(pixel) > 128) != isBall(i, j);
      }
    QVERIFY(compared > 150);
    QVERIFY2(wrong * 50 < compared, qPrintable(QStringLiteral("%1 of %2").arg(wrong).arg(compared)));
  }
}

// As on screen, the corner texts change and the middle stays the same.
void TestKeyImagePages::namesAreHiddenOnPages() {
  MeasureWindow w(dicomBall());
  mark(w, 1);
  saved(w, 1, false, at("named"));
  saved(w, 1, false, at("hidden"), true);
  QVERIFY(!namesHidden());
  saved(w, 1, false, at("named again"));
  w.session().prefer([](Preferences& preferences) { preferences.hideNames = true; });
  saved(w, 1, false, at("hidden on screen"), true);
  w.session().prefer([](Preferences& preferences) { preferences.hideNames = false; });
  const auto one = [&](const char* name) { return pixelsIn(at(name)).at(0); };
  QCOMPARE(pixelsIn(at("named")).size(), std::size_t(1));
  QCOMPARE(one("named again"), one("named"));
  QVERIFY(one("hidden") != one("named"));
  QCOMPARE(one("hidden on screen"), one("hidden"));
  const QRect middle(400, 400, 600, 600);
  QCOMPARE(one("hidden").copy(middle), one("named").copy(middle));
}

void TestKeyImagePages::whatCannotBeWrittenIsTold() {
  MeasureWindow w(dicomBall());
  mark(w, 1);
  press(ask(w, 6, false), "pagesPdf");
  answer(w, "pagesFileDialog", QStringLiteral("/proc/no/where.pdf"));
  QTRY_COMPARE_WITH_TIMEOUT(w.child<Banner>("banner")->sentence(),
                            QStringLiteral("Cannot write /proc/no/where.pdf: choose another place."),
                            longest);
}

void TestKeyImagePages::withoutKeyImagesThereIsASentence() {
  MeasureWindow w(dicomBall());
  QVERIFY(!ask(w, 6, false));
  QCOMPARE(w.child<Banner>("banner")->sentence(),
           QStringLiteral("There are no key images, measurements or segments: mark a picture with K, measure "
                          "with D, or make a segment."));
}

VOLUMEN_TEST(TestKeyImagePages);
#include "tst_key_image_pages.moc"
