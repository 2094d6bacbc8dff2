// Guards printing. It prints the view in focus as it was when requested, at a higher resolution, under
// patient and study. In true size, 1 mm on paper is 1 mm of the patient. The page is laid out to fit,
// measured in the PDF.
#include <QCheckBox>
#include <QMessageBox>
#include <QPrintDialog>
#include <QPushButton>
#include <QTemporaryDir>
#include <algorithm>
#include <array>
#include <cmath>

#include "tests/ui/frames_window.h"
#include "tests/ui/measure_window.h"
#include "tests/ui/pdf_images.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Returns a ball with header lines for patient and study.
LoadedSeriesPtr knownBall(const char* patient, double radius = 10, double spacing = 1) {
  auto series = std::make_shared<LoadedSeries>(*ballSeries(32, radius, {3, -2, 4}, glm::dvec3(spacing)));
  series->series.patientName = patient;
  series->series.studyDate = "20260314";
  return series;
}

// Opens the printer's dialog by the key.
QPrintDialog* askToPrint(Journey& w, const QString& path, bool inTrueSize) {
  QApplication::setActiveWindow(&w.window);  // as a window manager does after a dialog
  QTest::keyClick(&w.window, Qt::Key_P, Qt::ControlModifier);
  auto* dialog = w.child<QPrintDialog>("printDialog");
  if (!dialog) qFatal("the key opens no dialog");
  dialog->findChild<QLineEdit*>(QStringLiteral("filename"))->setText(path);
  auto* trueSize = dialog->findChild<QCheckBox*>(QStringLiteral("printTrueSize"));
  if (inTrueSize) QTest::mouseClick(trueSize, Qt::LeftButton, {}, {8, trueSize->height() / 2});
  return dialog;
}

bool isPrinted(const QString& path) {
  const bool isThere = QTest::qWaitFor([&] { return imagesIn(path).size() == 1; }, longest);
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  return isThere;
}

bool isBright(QRgb pixel) { return qRed(pixel) > 200 && qGreen(pixel) > 200 && qBlue(pixel) > 200; }

// Counts the bright pixels within a part of a picture, given in fractions.
int brightIn(const QImage& image, const QRectF& part) {
  const QRect pixels(int(part.x() * image.width()), int(part.y() * image.height()),
                     int(part.width() * image.width()), int(part.height() * image.height()));
  int count = 0;
  for (int y = pixels.top(); y <= pixels.bottom(); ++y)
    for (int x = pixels.left(); x <= pixels.right(); ++x) count += isBright(image.pixel(x, y)) ? 1 : 0;
  return count;
}

// Returns the length of the longest bright line near the bottom, which is the scale.
int scalePixels(const QImage& image) {
  int longest = 0;
  for (int y = image.height() * 9 / 10; y < image.height(); ++y)
    for (int x = 0, run = 0; x < image.width(); ++x) {
      run = isBright(image.pixel(x, y)) ? run + 1 : 0;
      longest = std::max(longest, run);
    }
  return longest;
}

}  // namespace

class TestPrinting : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aSliceIsPrintedInTrueSize_data();
  void aSliceIsPrintedInTrueSize();
  void aPageSaysWhoseItIs_data();
  void aPageSaysWhoseItIs();
  void whatIsCroppedIsToldBefore();
  void textsAndScaleStandInWhatIsPrinted();
  void trueSizeStandsBesideThePrinter();
  void onlyWhatHasASizeHasATrueOne();
  void mmAtTheDetectorAreNotThePatients();
  void withoutASeriesThereIsASentence();
};

void TestPrinting::aSliceIsPrintedInTrueSize_data() {
  QTest::addColumn<bool>("inTrueSize");
  QTest::newRow("true size") << true;
  QTest::newRow("as large as fits") << false;
}

void TestPrinting::aSliceIsPrintedInTrueSize() {
  QFETCH(bool, inTrueSize);
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("slice.pdf"));
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  QTest::keyClick(&w.window, Qt::Key_P, Qt::ControlModifier);
  auto* dialog = w.child<QPrintDialog>("printDialog");
  QVERIFY(dialog);
  auto* name = dialog->findChild<QLineEdit*>(QStringLiteral("filename"));
  QVERIFY(name);
  name->setText(path);
  dialog->findChild<QCheckBox*>(QStringLiteral("printTrueSize"))->setChecked(inTrueSize);
  dialog->accept();
  QTRY_VERIFY_WITH_TIMEOUT(QFileInfo(path).size() > 0, longest);
  QTRY_COMPARE_WITH_TIMEOUT(imagesIn(path).size(), std::size_t(1), longest);
  const QSizeF mm = imagesIn(path).front().size();
  const SlicePlane plane = *w.view()->plane();
  const QSizeF seen = QSizeF(plane.size.x, plane.size.y) * plane.mmPerPixel;
  QVERIFY2(std::abs(mm.width() / mm.height() / (seen.width() / seen.height()) - 1) < 0.005,
           qPrintable(QStringLiteral("%1 x %2 mm").arg(mm.width()).arg(mm.height())));
  if (inTrueSize)
    QVERIFY(std::abs(mm.width() / seen.width() - 1) < 0.005);
  else
    QVERIFY(mm.width() > 150);
}

void TestPrinting::aPageSaysWhoseItIs_data() {
  QTest::addColumn<ViewId>("view");
  QTest::addColumn<bool>("inTrueSize");
  QTest::addColumn<bool>("hidden");
  QTest::newRow("a slice") << ViewId(axialViewId) << false << false;
  QTest::newRow("a slice in true size") << ViewId(axialViewId) << true << false;
  QTest::newRow("a slice with names hidden") << ViewId(coronalViewId) << true << true;
  QTest::newRow("3D") << ViewId(sceneViewId) << false << false;
}

void TestPrinting::aPageSaysWhoseItIs() {
  QFETCH(ViewId, view);
  QFETCH(bool, inTrueSize);
  QFETCH(bool, hidden);
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("page.pdf"));
  MeasureWindow w(knownBall("Doe^Jane"));
  QVERIFY(w.settle());
  w.session().setFocus(view);
  if (hidden) w.child<QAction>("hideNames")->trigger();
  askToPrint(w, path, inTrueSize)->accept();
  const bool isThere = isPrinted(path);
  if (hidden) w.child<QAction>("hideNames")->trigger();
  QVERIFY(isThere);
  const QString texts = textsIn(path).join(QLatin1Char('\n'));
  QCOMPARE(texts.contains(QStringLiteral("Doe, Jane (42)")), !hidden);
  QCOMPARE(texts.contains(QStringLiteral("2026-03-14")), !hidden);
  QVERIFY2(texts.contains(QStringLiteral("CT Ball")), qPrintable(texts));
  QCOMPARE(texts.contains(QStringLiteral("True size")), inTrueSize);
  QVERIFY(texts.contains(QStringLiteral("Not for clinical use")));
}

// What does not fit in true size is printed only after confirmation.
void TestPrinting::whatIsCroppedIsToldBefore() {
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("large.pdf"));
  MeasureWindow w(knownBall("Doe^Jane", 45, 15));
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  const auto question = [&]() -> QMessageBox* {
    for (auto* box : w.window.findChildren<QMessageBox*>(QStringLiteral("cropBox")))
      if (box->isVisible()) return box;
    return nullptr;
  };
  askToPrint(w, path, true)->accept();
  QVERIFY(question());
  QVERIFY2(
      question()->informativeText().endsWith(QStringLiteral(" fit on the paper: the edges are left out.")),
      qPrintable(question()->informativeText()));
  question()->reject();
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  QVERIFY(w.window.jobs().rows().empty() && QFileInfo(path).size() == 0);
  askToPrint(w, path, true)->accept();
  for (QAbstractButton* button : question()->buttons())
    if (button->text() == QStringLiteral("Print the middle")) QTest::mouseClick(button, Qt::LeftButton);
  QVERIFY(isPrinted(path));
  QVERIFY(textsIn(path).filter(QStringLiteral("CT Ball, the middle: ")).size() == 1);
}

// The picture is larger than the paper. Each side has its letter, the corner its texts, and the scale is
// true.
void TestPrinting::textsAndScaleStandInWhatIsPrinted() {
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("middle.pdf"));
  MeasureWindow w(knownBall("Doe^Jane", 45, 15));
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  askToPrint(w, path, true)->accept();
  for (QAbstractButton* button : w.child<QMessageBox>("cropBox")->buttons())
    if (button->text() == QStringLiteral("Print the middle")) QTest::mouseClick(button, Qt::LeftButton);
  QVERIFY(isPrinted(path));
  const QRectF mm = imagesIn(path).front();
  const QImage image = pixelsIn(path).at(0);
  QVERIFY2(QRectF(0, 0, 210, 297).contains(mm), "all of it lies on the paper");
  for (const QRectF& place :
       {QRectF(0, 0.45, 0.08, 0.1), QRectF(0.92, 0.45, 0.08, 0.1), QRectF(0.45, 0, 0.1, 0.06),
        QRectF(0.45, 0.9, 0.1, 0.1), QRectF(0, 0, 0.35, 0.06), QRectF(0.65, 0, 0.35, 0.06)})
    QVERIFY2(brightIn(image, place) > 20, qPrintable(QStringLiteral("%1, %2").arg(place.x()).arg(place.y())));
  const double scaleMm = scalePixels(image) * mm.width() / image.width();
  const double power = std::pow(10.0, std::floor(std::log10(scaleMm)));
  constexpr double endsMm = 0.6;  // width of the ticks at its ends
  QVERIFY2(
      std::ranges::any_of(std::array{1, 2, 5},
                          [&](int of) { return std::abs(scaleMm - endsMm / 2 - of * power) < endsMm / 2; }),
      qPrintable(QString::number(scaleMm)));
}

// The check box is visible, not among the folded options.
void TestPrinting::trueSizeStandsBesideThePrinter() {
  MeasureWindow w;
  w.child<QAction>("printPicture")->trigger();
  QVERIFY(w.child<QCheckBox>("printTrueSize")->isVisible());
  w.child<QPrintDialog>("printDialog")->reject();
}

void TestPrinting::onlyWhatHasASizeHasATrueOne() {
  MeasureWindow w;
  w.session().setFocus(sceneViewId);
  w.child<QAction>("printPicture")->trigger();
  QVERIFY(!w.child<QCheckBox>("printTrueSize")->isEnabled());
  w.child<QPrintDialog>("printDialog")->reject();
}

void TestPrinting::mmAtTheDetectorAreNotThePatients() {
  NEED_FILES();
  Frames w({"cr-chest-mono1-jpeg8.dcm"});
  QVERIFY(w.shows());
  w.session().setFocus(axialViewId);
  w.child<QAction>("printPicture")->trigger();
  auto* trueSize = w.child<QCheckBox>("printTrueSize");
  QVERIFY(trueSize->isEnabled());
  QCOMPARE(trueSize->text(), QStringLiteral("True size: 1 mm (at detector) is 1 mm on paper"));
  w.child<QPrintDialog>("printDialog")->reject();
}

void TestPrinting::withoutASeriesThereIsASentence() {
  Journey w;
  w.child<QAction>("printPicture")->trigger();
  QCOMPARE(w.child<Banner>("banner")->sentence(), QStringLiteral("Open a series first."));
}

VOLUMEN_TEST(TestPrinting);
#include "tst_printing.moc"
