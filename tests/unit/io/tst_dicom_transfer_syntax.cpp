// Guards design.md 1 and 7 (every transfer syntax decodes to the values of its uncompressed version, or is
// refused by name).
#include <QTemporaryDir>
#include <algorithm>
#include <cmath>

#include "io/load.h"
#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

Result<Loaded> loadOnly(const std::string& path) {
  const Result<Study> study = openStudy(path);
  if (!study) return study.error();
  if (study->volumes.empty()) return Error{study->refused.empty() ? "nothing" : study->refused[0].reason};
  return loadSeries(study->volumes[0]);
}

const std::string twin =
    "dicom-ts-cornerstone/CTImage.dcm_LittleEndianExplicitTransferSyntax_1.2.840.10008.1.2.1.dcm";

}  // namespace

class TestDicomTransferSyntax : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void decodesToTheTwinsValues_data();
  void decodesToTheTwinsValues();
  void unsupportedOnesAreRefusedByName_data();
  void unsupportedOnesAreRefusedByName();
};

void TestDicomTransferSyntax::decodesToTheTwinsValues_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<double>("largest");
  QTest::addColumn<double>("mean");
  const auto row = [](const char* name, double largest, double mean) {
    QTest::newRow(name)
        << QString::fromLatin1("dicom-ts-cornerstone/CTImage.dcm_%1.dcm").arg(QLatin1String(name)) << largest
        << mean;
  };
  row("LittleEndianImplicitTransferSyntax_1.2.840.10008.1.2", 0, 0);
  row("BigEndianExplicitTransferSyntax_1.2.840.10008.1.2.2", 0, 0);
  row("DeflatedExplicitVRLittleEndianTransferSyntax_1.2.840.10008.1.2.1.99", 0, 0);
  row("RLELosslessTransferSyntax_1.2.840.10008.1.2.5", 0, 0);
  row("JPEGProcess14TransferSyntax_1.2.840.10008.1.2.4.57", 0, 0);
  row("JPEGProcess14SV1TransferSyntax_1.2.840.10008.1.2.4.70", 0, 0);
  row("JPEGLSLosslessTransferSyntax_1.2.840.10008.1.2.4.80", 0, 0);
  row("JPEG2000LosslessOnlyTransferSyntax_1.2.840.10008.1.2.4.90", 0, 0);
  // Losses of the coders in HU (JPEG ones store 2 or 32 HU a step). A wrong picture is off by hundreds.
  row("JPEGLSLossyTransferSyntax_1.2.840.10008.1.2.4.81", 1, 0.7);
  row("JPEG2000TransferSyntax_1.2.840.10008.1.2.4.91", 5, 0.6);
  row("JPEGProcess1TransferSyntax_1.2.840.10008.1.2.4.50", 65, 20);
  row("JPEGProcess2_4TransferSyntax_1.2.840.10008.1.2.4.51", 36, 4);
  row("JPEGProcess6_8TransferSyntax_1.2.840.10008.1.2.4.53", 36, 4);
  row("JPEGProcess10_12TransferSyntax_1.2.840.10008.1.2.4.55", 36, 4);
}

void TestDicomTransferSyntax::decodesToTheTwinsValues() {
  NEED_DATA(dataPath());
  QFETCH(QString, file);
  QFETCH(double, largest);
  QFETCH(double, mean);
  const Result<Loaded> expected = loadOnly(dataPath(twin)), found = loadOnly(dataPath(file.toStdString()));
  QVERIFY(expected.ok());
  QVERIFY2(found.ok(), found.ok() ? "" : found.message().c_str());
  const Volume &a = *expected->acquired, &b = *found->acquired;
  QCOMPARE(a.geometry(), b.geometry());
  double worst = 0, sum = 0;
  const std::size_t count = std::size_t(a.geometry().voxelCount());
  for (std::size_t n = 0; n < count; ++n) {
    const double off = std::abs(double(a.valueAt(n)) - double(b.valueAt(n)));
    worst = std::max(worst, off);
    sum += off;
  }
  const QString text = QStringLiteral("largest %1, mean %2").arg(worst).arg(sum / double(count));
  QVERIFY2(worst <= largest && sum / double(count) <= mean, qPrintable(text));
}

void TestDicomTransferSyntax::unsupportedOnesAreRefusedByName_data() {
  QTest::addColumn<QByteArray>("uid");
  QTest::addColumn<QString>("name");
  QTest::newRow("JPEG XL") << QByteArray("1.2.840.10008.1.2.4.110") << QStringLiteral("\"JPEG XL Lossless\"");
  QTest::newRow("MPEG-4") << QByteArray("1.2.840.10008.1.2.4.102") << QStringLiteral("H.264");
  QTest::newRow("unknown") << QByteArray("1.2.3.4.5.6.7.8.9.10")
                           << QStringLiteral("1.2.3.4.5.6.7.8.9.10 is not known");
}

void TestDicomTransferSyntax::unsupportedOnesAreRefusedByName() {
  QFETCH(QByteArray, uid);
  QFETCH(QString, name);
  QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("a")).toStdString();
  writeDicom(path, {}, "1.2.840.10008.1.2.4.70");
  std::vector<std::uint8_t> bytes = readAll(path);
  if (uid.size() % 2 == 1) uid.append('\0');
  const std::string old = "1.2.840.10008.1.2.4.70";
  const auto at = std::search(bytes.begin(), bytes.end(), old.begin(), old.end());
  QVERIFY(at != bytes.end());
  *(at - 2) = std::uint8_t(uid.size());  // its length
  bytes.insert(bytes.erase(at, at + 22), uid.begin(), uid.end());
  writeAll(path, bytes);
  const Result<Study> study = openStudy(path);
  QVERIFY(study.ok() && study->volumes.empty());
  QVERIFY2(study->refused.at(0).reason.find(name.toStdString()) != std::string::npos,
           study->refused[0].reason.c_str());
}

VOLUMEN_TEST(TestDicomTransferSyntax);
#include "tst_dicom_transfer_syntax.moc"
