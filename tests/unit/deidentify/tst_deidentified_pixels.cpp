// Guards that copies without identity hide nothing beside their pixels: overlays in unused bits, bytes
// behind the last pixel, comments in code streams. DCMTK reads the files.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcpxitem.h>

#include <QFile>

#include "tests/unit/deidentify/exported.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestDeidentifiedPixels : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void overlaysInUnusedBitsGo_data();
  void overlaysInUnusedBitsGo();
  void compressedOverlaysAreTold_data();
  void compressedOverlaysAreTold();
  void bytesBehindThePixelsGo_data();
  void bytesBehindThePixelsGo();
  void commentsOfCodeStreamsGo_data();
  void commentsOfCodeStreamsGo();

 private:
  Exported exported_;
};

namespace {

constexpr int pixelCount = 12;

void addOverlay(DcmDataset& data, Uint16 bit) {
  data.putAndInsertString(DCM_Modality, "MR");
  data.putAndInsertUint16(DcmTag(0x6000, 0x0010, EVR_US), 3);
  data.putAndInsertUint16(DcmTag(0x6000, 0x0011, EVR_US), 4);
  data.putAndInsertUint16(DcmTag(0x6000, 0x0102, EVR_US), bit);
}

std::vector<Uint16> pixelsOf(DcmFileFormat& file) {
  const Uint16* words = nullptr;
  unsigned long count = 0;
  const bool isRead = file.getDataset()->findAndGetUint16Array(DCM_PixelData, words, &count).good();
  return isRead ? std::vector<Uint16>(words, words + count) : std::vector<Uint16>();
}

// Returns the first fragment of compressed pixels; null if there is none.
DcmPixelItem* fragmentOf(DcmFileFormat& file) {
  DcmElement* element = nullptr;
  if (file.getDataset()->findAndGetElement(DCM_PixelData, element).bad()) return nullptr;
  auto* const pixels = dynamic_cast<DcmPixelData*>(element);
  E_TransferSyntax syntax = EXS_Unknown;
  const DcmRepresentationParameter* parameter = nullptr;
  DcmPixelSequence* fragments = nullptr;
  DcmPixelItem* fragment = nullptr;
  if (!pixels) return nullptr;
  pixels->getOriginalRepresentationKey(syntax, parameter);
  if (pixels->getEncapsulatedRepresentation(syntax, parameter, fragments).bad()) return nullptr;
  return fragments->getItem(fragment, 1).good() ? fragment : nullptr;
}

QByteArray bytesOfFragment(DcmFileFormat& file) {
  DcmPixelItem* const fragment = fragmentOf(file);
  Uint8* bytes = nullptr;
  if (!fragment || fragment->getUint8Array(bytes).bad()) return {};
  return {reinterpret_cast<const char*>(bytes), qsizetype(fragment->getLength())};
}

// Returns a marker of a code stream with its segment.
QByteArray segment(int marker, const QByteArray& content) {
  const qsizetype length = content.size() + 2;
  return QByteArray("\xff") + char(marker) + char(length >> 8) + char(length & 0xff) + content;
}

}  // namespace

void TestDeidentifiedPixels::overlaysInUnusedBitsGo_data() {
  QTest::addColumn<QByteArray>("syntax");
  for (const char* syntax :
       {UID_LittleEndianExplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax,
        UID_BigEndianExplicitTransferSyntax, UID_DeflatedExplicitVRLittleEndianTransferSyntax})
    QTest::newRow(dcmFindNameOfUID(syntax)) << QByteArray(syntax);
}

// Bit 15 is the overlay, bit 14 is unused, and bit 11 belongs to the pixels.
void TestDeidentifiedPixels::overlaysInUnusedBitsGo() {
  QFETCH(QByteArray, syntax);
  DicomPicture picture;
  picture.bitsStored = 12;
  for (int n = 0; n < pixelCount; ++n) picture.pixels.push_back(std::uint16_t(0xc800 + n));
  picture.edit = [](DcmDataset& data) { addOverlay(data, 15); };
  const QString path = exported_.pathOf("in.dcm");
  writeDicom(path.toStdString(), picture, syntax.constData());
  const Outcome a = exported_.run(path);
  QVERIFY2(a.status == 0 && !a.err.contains("burned"), a.err);
  const auto copy = exported_.only();
  QVERIFY(copy);
  std::vector<Uint16> expected;
  for (int n = 0; n < pixelCount; ++n) expected.push_back(Uint16(0x4800 + n));
  QVERIFY(pixelsOf(*copy) == expected);
}

void TestDeidentifiedPixels::compressedOverlaysAreTold_data() {
  QTest::addColumn<int>("bit");
  QTest::addColumn<bool>("isTold");
  QTest::newRow("in bit 15") << 15 << true;
  QTest::newRow("with data of its own") << 0 << false;
}

void TestDeidentifiedPixels::compressedOverlaysAreTold() {
  QFETCH(int, bit);
  static int ofThisRow;
  ofThisRow = bit;
  DicomPicture picture;
  picture.bitsStored = 12;
  picture.pixels = std::vector<std::uint16_t>(pixelCount, 0x8001);
  picture.edit = [](DcmDataset& data) {
    addOverlay(data, Uint16(ofThisRow));
    if (ofThisRow == 0)
      data.putAndInsertUint8Array(DcmTag(0x6000, 0x3000, EVR_OB), reinterpret_cast<const Uint8*>("ab"), 2);
  };
  const QString path = exported_.pathOf("in.dcm");
  writeDicom(path.toStdString(), picture, UID_RLELosslessTransferSyntax);
  const Outcome a = exported_.run(path);
  QCOMPARE(a.status, 0);
  QFETCH(bool, isTold);
  QCOMPARE(a.err.contains("burned into the pixels"), isTold);
}

void TestDeidentifiedPixels::bytesBehindThePixelsGo_data() { overlaysInUnusedBitsGo_data(); }

void TestDeidentifiedPixels::bytesBehindThePixelsGo() {
  QFETCH(QByteArray, syntax);
  DicomPicture picture;
  picture.edit = [](DcmDataset& data) {
    const std::vector<Uint16> words(pixelCount + 5, 0x5151);
    data.putAndInsertUint16Array(DCM_PixelData, words.data(), words.size());
  };
  const QString path = exported_.pathOf("in.dcm");
  writeDicom(path.toStdString(), picture, syntax.constData());
  QCOMPARE(exported_.run(path).status, 0);
  const auto copy = exported_.only();
  QVERIFY(copy);
  std::vector<Uint16> expected(pixelCount, 0x5151);
  expected.resize(pixelCount + 5);
  QVERIFY(pixelsOf(*copy) == expected);
}

void TestDeidentifiedPixels::commentsOfCodeStreamsGo_data() {
  QTest::addColumn<QByteArray>("before");
  QTest::addColumn<QByteArray>("after");
  const QByteArray jpeg("\xff\xd8"), text("Quillfeather"), blanks(text.size(), ' '), zeros(text.size(), 0);
  const QByteArray frame = segment(0xc3, QByteArray("\x10\0\3\0\4\1\1\x11\0", 9));
  const QByteArray scan = segment(0xda, QByteArray("\1\1\0\1\0\0", 6)) + "\x12\x34" + segment(0xfe, text);
  const QByteArray app = segment(0xe0, "JFIF") + segment(0xee, "Adobe ");
  const QByteArray end("\xff\xd9");
  QTest::newRow("JPEG: a comment before the scan") << jpeg + app + segment(0xfe, text) + frame + scan + end
                                                   << jpeg + app + segment(0xfe, blanks) + frame + scan + end;
  QTest::newRow("JPEG: Exif and Photoshop")
      << jpeg + segment(0xe1, text) + segment(0xed, text) + frame + scan + end
      << jpeg + segment(0xe1, zeros) + segment(0xed, zeros) + frame + scan + end;
  const QByteArray damaged = jpeg + segment(0xfe, text) + frame + "\x12" + scan + "\x34" + end;
  QTest::newRow("JPEG: a damaged one stays") << damaged << damaged;
  const QByteArray start = QByteArray("\xff\x4f") + segment(0x51, QByteArray(41, 1));
  const QByteArray tile = segment(0x90, QByteArray(8, 0)) + segment(0x64, "\1\1" + text) + end;
  QTest::newRow("JPEG 2000: a comment before the tiles")
      << start + segment(0x64, QByteArray("\0\1", 2) + text) + tile
      << start + segment(0x64, QByteArray("\0\1", 2) + blanks) + tile;
}

void TestDeidentifiedPixels::commentsOfCodeStreamsGo() {
  QFETCH(QByteArray, before);
  const QString path = exported_.pathOf("in.dcm");
  writeDicom(path.toStdString(), DicomPicture{}, UID_JPEGProcess14SV1TransferSyntax);
  const auto file = readWithDcmtk(path);
  QVERIFY(file && fragmentOf(*file));
  if (before.size() % 2) before += '\0';
  fragmentOf(*file)->putUint8Array(reinterpret_cast<const Uint8*>(before.constData()),
                                   static_cast<unsigned long>(before.size()));
  QVERIFY(file->saveFile(QFile::encodeName(path).constData(), EXS_JPEGProcess14SV1).good());
  QVERIFY(contentsOf(path).contains("Quillfeather"));
  const Outcome a = exported_.run(path);
  QVERIFY2(a.status == 0, a.err);
  const auto copy = exported_.only();
  QVERIFY(copy);
  QFETCH(QByteArray, after);
  if (after.size() % 2) after += '\0';
  QCOMPARE(bytesOfFragment(*copy).toHex(), after.toHex());
}

VOLUMEN_TEST(TestDeidentifiedPixels);
#include "tst_deidentified_pixels.moc"
