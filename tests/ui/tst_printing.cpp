// Guards that what is printed is the view in focus as it is seen, finer, and in true size 1 mm on paper for 1
// mm of the patient, measured in the PDF.
#include <zlib.h>
#include <QCheckBox>
#include <QPrintDialog>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTransform>

#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"
#include "ui/overlays/printed_page.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

QByteArray inflated(const QByteArray& packed) {
  QByteArray out(64 << 20, '\0');
  uLongf size = uLongf(out.size());
  if (uncompress(reinterpret_cast<Bytef*>(out.data()), &size,
                 reinterpret_cast<const Bytef*>(packed.constData()), uLong(packed.size())) != Z_OK)
    return {};
  return out.left(qsizetype(size));
}

// Where the first image of a PDF lies on its page, mm: its streams are read as PDF 1.4, 8.4.4 (cm, q, Q)
// and 8.8 (Do) say.
QSizeF imageMm(const QByteArray& pdf) {
  for (qsizetype at = pdf.indexOf("stream\n"); at >= 0; at = pdf.indexOf("stream\n", at + 1)) {
    const qsizetype from = at + 7, to = pdf.indexOf("endstream", from);
    const QByteArray text = inflated(pdf.mid(from, to - from));
    if (!text.contains(" Do")) continue;
    std::vector<QTransform> stack{QTransform()};
    QList<double> numbers;
    for (const QByteArray& word : text.simplified().split(' ')) {
      bool isNumber = false;
      const double number = word.toDouble(&isNumber);
      if (isNumber) {
        numbers << number;
        continue;
      }
      if (word == "q") stack.push_back(stack.back());
      if (word == "Q") stack.pop_back();
      if (word == "cm" && numbers.size() >= 6) {
        const double* n = numbers.constData() + numbers.size() - 6;
        stack.back() = QTransform(n[0], n[1], n[2], n[3], n[4], n[5]) * stack.back();
      }
      if (word == "Do") return stack.back().mapRect(QRectF(0, 0, 1, 1)).size() * (25.4 / 72);
      numbers.clear();
    }
  }
  return {};
}

}  // namespace

class TestPrinting : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void picturesFitThePaperOrHaveTheirSize();
  void aSliceIsPrintedInTrueSize_data();
  void aSliceIsPrintedInTrueSize();
  void onlyWhatHasASizeHasATrueOne();
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
  QFile file(path);
  QVERIFY(file.open(QIODevice::ReadOnly));
  const QSizeF mm = imageMm(file.readAll());
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

void TestPrinting::withoutASeriesThereIsASentence() {
  Journey w;
  w.child<QAction>("printPicture")->trigger();
  QCOMPARE(w.child<Banner>("banner")->sentence(), QStringLiteral("Open a series first."));
}

VOLUMEN_TEST(TestPrinting);
#include "tst_printing.moc"
