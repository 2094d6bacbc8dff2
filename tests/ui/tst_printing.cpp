// Guards that what is printed is the view in focus as it is seen, finer, and in true size 1 mm on paper for 1
// mm of the patient, measured in the PDF.
#include <QCheckBox>
#include <QPrintDialog>
#include <QTemporaryDir>

#include "tests/ui/frames_window.h"
#include "tests/ui/measure_window.h"
#include "tests/ui/pdf_images.h"
#include "tests/unit/suite.h"
#include "ui/overlays/printed_page.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

class TestPrinting : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void picturesFitThePaperOrHaveTheirSize();
  void aSliceIsPrintedInTrueSize_data();
  void aSliceIsPrintedInTrueSize();
  void onlyWhatHasASizeHasATrueOne();
  void mmAtTheDetectorAreNotThePatients();
  void withoutASeriesThereIsASentence();
};

void TestPrinting::picturesFitThePaperOrHaveTheirSize() {
  const QImage picture(400, 200, QImage::Format_RGB32);
  QCOMPARE(placeOnPaper({picture, {}}, {200, 300}), QRectF(0, 100, 200, 100));
  QCOMPARE(placeOnPaper({picture, {}}, {300, 100}), QRectF(50, 0, 200, 100));
  QCOMPARE(placeOnPaper({picture, 0.25}, {200, 300}), QRectF(50, 125, 100, 50));
  QCOMPARE(placeOnPaper({picture, 1.0}, {200, 300}), QRectF(-100, 50, 400, 200));
}

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
