// Guards what is sent to peers that take no JPEG 2000: the frames that volumen itself reads from the file,
// with attributes that describe them; what cannot be decoded is refused in a sentence.
#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QtEndian>

#include "io/dicom/decode.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/taking_peer.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;
using namespace volumen::dicom;

class TestArchivePlain : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void framesArriveAsVolumenReadsThem_data();
  void framesArriveAsVolumenReadsThem();
  void whatCannotBeDecodedIsRefused_data();
  void whatCannotBeDecodedIsRefused();

 private:
  QString fileOf(const QByteArray& bytes);
  Outcome send(const TakingPeer& peer, const QByteArray& file);

  QTemporaryDir folder_;
  int files_ = 0;
};

namespace {

constexpr const char *explicitLittleEndian = "1.2.840.10008.1.2.1", *jpeg2000 = "1.2.840.10008.1.2.4.90";
constexpr const char *ctLossless =
                         "dicom-ts-cornerstone/"
                         "CTImage.dcm_JPEG2000LosslessOnlyTransferSyntax_1.2.840.10008.1.2.4.90.dcm",
                     *ctLossy =
                         "dicom-ts-cornerstone/"
                         "CTImage.dcm_JPEG2000TransferSyntax_1.2.840.10008.1.2.4.91.dcm";

QByteArray dataFile(const char* name) { return contentsOf(QString::fromStdString(dataPath(name))); }

// Returns the bytes of an attribute of group 0028 that is a US.
QByteArray word(char element, char group, char value) {
  return QByteArray("\x28\0", 2) + element + group + QByteArray("US\2\0", 4) + value + '\0';
}
const QByteArray bitsStored12 = word(1, 1, 12), highBit11 = word(2, 1, 11), isSigned = word(3, 1, 1),
                 byPixel = word(6, 0, 0);

// Takes the last `count` bytes of the last fragment away, so that all lengths are right.
QByteArray cutOff(QByteArray file, int count) {
  const qsizetype stream = file.lastIndexOf(QByteArray("\xff\x4f\xff\x51", 4));
  char* const length = file.data() + stream - 4;
  qToLittleEndian(qFromLittleEndian<quint32>(length) - quint32(count), length);
  return file.remove(file.lastIndexOf(QByteArray("\xfe\xff\xdd\xe0", 4)) - count, count);
}

std::vector<DecodedFrame> framesOf(const FileHeader& header) {
  std::vector<DecodedFrame> frames;
  const auto source = PixelSource::open(header);
  for (std::size_t n = 0; source && n < header.frames.size(); ++n)
    if (auto frame = source->frame(int(n)); frame) frames.push_back(std::move(*frame));
  return frames;
}

}  // namespace

void TestArchivePlain::initTestCase() { NEED_DATA(dataPath()); }

QString TestArchivePlain::fileOf(const QByteArray& bytes) {
  const QString path = folder_.filePath(QStringLiteral("%1.dcm").arg(++files_));
  QFile file(path);
  return file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size() ? path : QString();
}

Outcome TestArchivePlain::send(const TakingPeer& peer, const QByteArray& file) {
  const QString archives = fileOf(
      R"({"archives": [{"name": "to", "kind": "dimse", "host": "127.0.0.1", "calledAe": "ANY", "port": )" +
      QByteArray::number(peer.port()) + "}]}");
  return runProgram({QStringLiteral("archive"), QStringLiteral("send"), QStringLiteral("to"), fileOf(file),
                     QStringLiteral("--archives"), archives, QStringLiteral("--json")});
}

void TestArchivePlain::framesArriveAsVolumenReadsThem_data() {
  QTest::addColumn<QByteArray>("file");
  QTest::addColumn<QByteArray>("photometric");
  QTest::addColumn<int>("bitsStored");
  QTest::addColumn<bool>("isLossy");
  const QByteArray grey = "MONOCHROME2", rgb = "RGB";
  const QByteArray ultrasound = dataFile("dicom-pydicom/data_store/US1_J2KR.dcm"),
                   tenFrames = dataFile("dicom-pydicom/data_store/emri_small_jpeg_2k_lossless.dcm"),
                   isSignedStream = dataFile("dicom-pydicom/test_files/MR_small_jp2klossless.dcm");
  QTest::newRow("lossless, signed") << dataFile(ctLossless) << grey << 16 << false;
  QTest::newRow("lossy, signed") << dataFile(ctLossy) << grey << 16 << true;
  QTest::newRow("ten frames of 12 bits") << tenFrames << grey << 12 << false;
  QTest::newRow("YBR_RCT becomes RGB") << ultrasound << rgb << 8 << false;
  QTest::newRow("YBR_ICT becomes RGB, lossy")
      << dataFile("dicom-pydicom/data_store/US1_J2KI.dcm") << rgb << 8 << true;
  QTest::newRow("HTJ2K, lossless") << dataFile("dicom-ts-cornerstone/HTJ2KLossless_08_RGB.dcm") << rgb << 8
                                   << false;
  QTest::newRow("HTJ2K, lossy") << dataFile("dicom-ts-cornerstone/HTJ2K_08_RGB.dcm") << rgb << 8 << false;
  QTest::newRow("an unsigned stream in a signed file")
      << dataFile("dicom-pydicom/test_files/J2K_pixelrep_mismatch.dcm") << grey << 13 << false;
  QTest::newRow("a signed stream in an unsigned file")
      << QByteArray(isSignedStream).replace(isSigned, word(3, 1, 0)) << grey << 16 << false;
  QTest::newRow("colour planes, which JPEG 2000 does not have")
      << QByteArray(ultrasound).replace(byPixel, word(6, 0, 1)) << rgb << 8 << false;
  QTest::newRow("values of more bits than the file says")
      << QByteArray(tenFrames).replace(bitsStored12, word(1, 1, 8)).replace(highBit11, word(2, 1, 7)) << grey
      << 0 << false;
  QTest::newRow("JPEG 2000 that the file calls JPEG-LS")
      << renamed(dataFile(ctLossless), jpeg2000, "1.2.840.10008.1.2.4.80") << grey << 16 << false;
}

void TestArchivePlain::framesArriveAsVolumenReadsThem() {
  QFETCH(QByteArray, file);
  QFETCH(QByteArray, photometric);
  QFETCH(int, bitsStored);
  QFETCH(bool, isLossy);
  const TakingPeer peer({explicitLittleEndian});
  const Outcome outcome = send(peer, file);
  QVERIFY2(outcome.status == 0, outcome.err);
  QCOMPARE(peer.dataSets().size(), 1);
  const QByteArray data = peer.dataSets().first();
  const Inspection before = inspect(fileOf(file).toStdString()), after = inspect(fileOf(data).toStdString());
  QCOMPARE(after.kind, Inspection::Kind::picture);
  const PixelFormat& format = after.header.format;
  QCOMPARE(format.photometric, photometric.toStdString());
  QCOMPARE(format.bitsAllocated, before.header.format.bitsAllocated);
  QCOMPARE(format.highBit, format.bitsStored - 1);
  if (bitsStored > 0) QCOMPARE(format.bitsStored, bitsStored);
  QVERIFY(!format.planar);
  QCOMPARE(after.header.lossyRatio, before.header.lossyRatio);
  QCOMPARE(data.contains(QByteArray("\x28\0\x10\x21"
                                    "CS\2\0"
                                    "01",
                                    10)),
           isLossy);
  const std::vector<DecodedFrame> sent = framesOf(before.header), arrived = framesOf(after.header);
  QCOMPARE(arrived.size(), std::size_t(before.header.format.frames));
  QCOMPARE(sent.size(), arrived.size());
  for (std::size_t n = 0; n < sent.size(); ++n) {
    QVERIFY(arrived[n].samples == sent[n].samples);
    QCOMPARE(arrived[n].ybr, sent[n].ybr);
  }
}

void TestArchivePlain::whatCannotBeDecodedIsRefused_data() {
  QTest::addColumn<QByteArray>("file");
  QTest::addColumn<QString>("reason");
  const QByteArray ct = dataFile(ctLossless);
  const auto called = [&](const char* syntax) {
    return renamed(ct, jpeg2000, QByteArray("1.2.840.10008.1.2.4.") + syntax);
  };
  QTest::newRow("a stream that is cut off")
      << cutOff(ct, 40000)
      << QStringLiteral("and it cannot be decompressed: its JPEG 2000 picture is damaged or cut off.");
  QTest::newRow("bits") << dataFile("dicom-pydicom/data_store/liver_j2k.dcm")
                        << QStringLiteral("and it cannot be decompressed: only native pixels have one bit.");
  QTest::newRow("JPEG 2000 of several components")
      << called("92") << QStringLiteral("and it cannot be decompressed.");
  for (const char* number : {"100", "101", "102", "104", "106", "107", "108"})
    QTest::addRow("video %s", number)
        << called(number) << QStringLiteral("and volumen does not decompress videos.");
}

void TestArchivePlain::whatCannotBeDecodedIsRefused() {
  QFETCH(QByteArray, file);
  QFETCH(QString, reason);
  const TakingPeer peer({explicitLittleEndian});
  const Outcome outcome = send(peer, file);
  QCOMPARE(outcome.status, 1);
  const QString why = QJsonDocument::fromJson(outcome.out)[u"failed"][0][u"reason"].toString();
  QVERIFY2(why.endsWith(reason), qPrintable(why));
  QVERIFY(peer.dataSets().isEmpty());
}

VOLUMEN_TEST(TestArchivePlain);
#include "tst_archive_plain.moc"
