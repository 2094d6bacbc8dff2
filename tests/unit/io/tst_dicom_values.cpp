// Guards design.md 7 and 10 (values): bits stored, high bit, sign, overlays, wide integers, floats, and RLE,
// JPEG and JPEG-LS of each.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QTemporaryDir>
#include <cmath>

#include "io/dicom/decode.h"
#include "io/load.h"
#include "io/open.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

dicom::PixelFormat formatOf(int columns, int allocated, int stored, int highBit, bool isSigned) {
  dicom::PixelFormat f;
  f.columns = columns;
  f.rows = 1;
  f.bitsAllocated = allocated;
  f.bitsStored = stored;
  f.highBit = highBit;
  f.isSigned = isSigned;
  return f;
}

QList<double> valuesOf(const dicom::Samples& samples) {
  return std::visit([](const auto& v) { return QList<double>(v.begin(), v.end()); }, samples);
}

}  // namespace

class TestDicomValues : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void storedBitsAreTakenAndSigned_data();
  void storedBitsAreTakenAndSigned();
  void codersKeepEveryValue_data();
  void codersKeepEveryValue();
  void wideIntegersBecomeFloat();
  void extremeRescaleStaysFinite();
};

void TestDicomValues::storedBitsAreTakenAndSigned_data() {
  QTest::addColumn<QByteArray>("bytes");
  QTest::addColumn<int>("allocated");
  QTest::addColumn<int>("stored");
  QTest::addColumn<int>("highBit");
  QTest::addColumn<bool>("isSigned");
  QTest::addColumn<bool>("bigEndian");
  QTest::addColumn<QList<double>>("values");
  const auto row = [](const char* name, const char* hex, int allocated, int stored, int highBit,
                      bool isSigned, bool bigEndian, QList<double> values) {
    QTest::newRow(name) << QByteArray::fromHex(hex) << allocated << stored << highBit << isSigned << bigEndian
                        << values;
  };
  row("8 bits", "00807fff", 8, 8, 7, false, false, {0, 128, 127, 255});
  row("8 bits signed", "00807fff", 8, 8, 7, true, false, {0, -128, 127, -1});
  row("16 bits", "00800180ffff", 16, 16, 15, false, false, {32768, 32769, 65535});
  row("16 bits signed", "00800180ffff", 16, 16, 15, true, false, {-32768, -32767, -1});
  row("16 bits big endian", "80008001", 16, 16, 15, true, true, {-32768, -32767});
  row("12 bits signed: 0xF0F is -241", "ff0f0f0fff07", 16, 12, 11, true, false, {-1, -241, 2047});
  row("12 bits with overlays above", "ff1f0ff0ff8f", 16, 12, 11, false, false, {4095, 15, 4095});
  row("12 bits signed with overlays above", "ff1f0ff8ff87", 16, 12, 11, true, false, {-1, -2033, 2047});
  row("12 bits on top of 16", "f0ff1000", 16, 12, 15, false, false, {4095, 1});
  row("12 bits signed on top of 16", "f0ff1000", 16, 12, 15, true, false, {-1, 1});
  row("32 bits", "ffffffff01000080", 32, 32, 31, false, false, {4294967295.0, 2147483649.0});
  row("32 bits signed", "ffffffff01000080", 32, 32, 31, true, false, {-1, -2147483647.0});
}

void TestDicomValues::storedBitsAreTakenAndSigned() {
  QFETCH(QByteArray, bytes);
  QFETCH(int, allocated);
  QFETCH(int, stored);
  QFETCH(int, highBit);
  QFETCH(bool, isSigned);
  QFETCH(bool, bigEndian);
  QFETCH(QList<double>, values);
  dicom::PixelFormat format = formatOf(int(values.size()), allocated, stored, highBit, isSigned);
  format.bigEndian = bigEndian;
  const dicom::Bytes view(reinterpret_cast<const std::uint8_t*>(bytes.constData()),
                          std::size_t(bytes.size()));
  const auto frame = dicom::decodeFrame(format, dicom::transferSyntax("1.2.840.10008.1.2.1"), view);
  QVERIFY(frame.ok());
  QCOMPARE(valuesOf(frame->samples), values);
}

void TestDicomValues::codersKeepEveryValue_data() {
  QTest::addColumn<QByteArray>("syntax");
  QTest::addColumn<int>("bits");
  QTest::addColumn<bool>("isSigned");
  const std::pair<const char*, const char*> syntaxes[] = {
      {"native", "1.2.840.10008.1.2.1"},           {"big endian", "1.2.840.10008.1.2.2"},
      {"deflated", "1.2.840.10008.1.2.1.99"},      {"RLE", "1.2.840.10008.1.2.5"},
      {"JPEG lossless", "1.2.840.10008.1.2.4.57"}, {"JPEG lossless SV1", "1.2.840.10008.1.2.4.70"},
      {"JPEG-LS", "1.2.840.10008.1.2.4.80"}};
  for (const auto& [name, uid] : syntaxes)
    for (int bits : {10, 12, 16})
      for (bool isSigned : {false, true})
        QTest::addRow("%s, %d bits%s", name, bits, isSigned ? " signed" : "")
            << QByteArray(uid) << bits << isSigned;
}

void TestDicomValues::codersKeepEveryValue() {
  QFETCH(QByteArray, syntax);
  QFETCH(int, bits);
  QFETCH(bool, isSigned);
  DicomPicture p;
  p.columns = 64;
  p.rows = 32;
  p.bitsStored = bits;
  p.isSigned = isSigned;
  QList<double> expected;
  const int low = isSigned ? -(1 << (bits - 1)) : 0, count = 1 << bits;
  for (int n = 0; n < p.columns * p.rows; ++n) {
    const int value = low + int((n * 104729LL) % count);
    expected.push_back(value);
    p.pixels.push_back(std::uint16_t(value & (count - 1)));
  }
  QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("a")).toStdString();
  writeDicom(path, p, syntax.constData());
  const Result<Study> study = openStudy(path);
  QVERIFY(study.ok());
  QVERIFY2(study->volumes.size() == 1, study->refused.empty() ? "" : study->refused[0].reason.c_str());
  const Result<Loaded> loaded = loadSeries(study->volumes[0]);
  QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
  QCOMPARE(std::string(loaded->acquired->typeName()), std::string(isSigned ? "int16" : "uint16"));
  for (qsizetype n = 0; n < expected.size(); ++n)
    QCOMPARE(double(loaded->acquired->valueAt(std::size_t(n))), expected[n]);
}

void TestDicomValues::wideIntegersBecomeFloat() {
  QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("a")).toStdString();
  DicomPicture p;
  p.columns = 2;
  p.rows = 1;
  p.edit = [](DcmDataset& data) {
    data.putAndInsertUint16(DCM_BitsAllocated, 32);
    data.putAndInsertUint16(DCM_BitsStored, 32);
    data.putAndInsertUint16(DCM_HighBit, 31);
    data.putAndInsertString(DCM_RescaleSlope, "0.5");
    const Uint16 words[] = {6, 0, 1, 0x0100};  // 6 and 2^24 + 1
    data.putAndInsertUint16Array(DCM_PixelData, words, 4);
  };
  writeDicom(path, p);
  const Result<Study> study = openStudy(path);
  QVERIFY(study.ok() && study->volumes.size() == 1);
  QCOMPARE(study->volumes[0].valueType, std::string("float32"));
  const Result<Loaded> loaded = loadSeries(study->volumes[0]);
  QVERIFY(loaded.ok());
  QCOMPARE(loaded->acquired->value(0, 0, 0), 3.f);
  QCOMPARE(loaded->acquired->value(1, 0, 0), 8388608.5f);
  // 2^24 + 1 is not exact in float32.
  QVERIFY(loaded->warnings.back().sentence.find("float32") != std::string::npos);
}

void TestDicomValues::extremeRescaleStaysFinite() {
  QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("a")).toStdString();
  DicomPicture p;
  p.pixels = {5};
  p.edit = [](DcmDataset& data) { data.putAndInsertString(DCM_RescaleSlope, "1e300"); };
  writeDicom(path, p);
  const Result<Study> study = openStudy(path);
  QVERIFY(study.ok() && study->volumes.size() == 1);
  const Result<Loaded> loaded = loadSeries(study->volumes[0]);
  if (loaded.ok()) QVERIFY(std::abs(loaded->acquired->value(0, 0, 0)) <= 1e30f);
}

VOLUMEN_TEST(TestDicomValues);
#include "tst_dicom_values.moc"
