// Guards import.md: `info` reports what the window shows of a picture: millimetres at the detector, an
// applied Modality LUT, and the component of a file that a volume holds.
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestSaidAsShown : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void infoSays_data();
  void infoSays();
};

void TestSaidAsShown::infoSays_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<QByteArray>("says");
  QTest::addColumn<QByteArray>("saysNot");
  const auto row = [](const char* file, const char* says, const char* saysNot) {
    QTest::newRow(file) << QString::fromLatin1(file) << QByteArray(says) << QByteArray(saysNot);
  };
  row("dicom-2d/cr-chest-mono1-jpeg8.dcm",
      "its frames are measured in mm: a pixel is 0.175 x 0.175 mm at detector", "mm, no orientation");
  row("dicom-pydicom/data_store/mlut_18.dcm", "applied to its frames alone", "measured in mm: a pixel");
  row("nifti-meta/niftireader/5D_small.nii", "component x", "This is volume");
}

void TestSaidAsShown::infoSays() {
  NEED_DATA(dataPath());
  QFETCH(QString, file);
  QFETCH(QByteArray, says);
  QFETCH(QByteArray, saysNot);
  const Outcome a =
      runProgram({QStringLiteral("info"), QString::fromStdString(dataPath(file.toStdString()))});
  QVERIFY2(a.out.contains(says), a.out);
  QVERIFY2(!a.out.contains(saysNot), a.out);
}

VOLUMEN_TEST(TestSaidAsShown);
#include "tst_said_as_shown.moc"
