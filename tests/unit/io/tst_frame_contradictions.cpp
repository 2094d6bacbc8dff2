// Guards import.md: contradictions within a frame are resolved by a rule and reported. Covers JPEG streams
// and their labels, look-up tables with fewer bits than stated, signs and high bits.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <cmath>

#include "io/dicom/codestream.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/io/frame_of.h"
#include "tests/unit/suite.h"
#include "viewer/slice/grey.h"

using namespace volumen;
using namespace volumen::tests;

Q_DECLARE_METATYPE(dicom::JpegColours)

class TestFrameContradictions : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void jpegStreamsSayTheirColours_data();
  void jpegStreamsSayTheirColours();
  void theStreamDecides_data();
  void theStreamDecides();
  void tablesAreShownByTheirOwnRange_data();
  void tablesAreShownByTheirOwnRange();
  void aNarrowTableOfTheField();
  void palettesAreNeverBlack();
  void storedBitsDecide_data();
  void storedBitsDecide();
};

namespace {

bool says(const Frame& frame, const std::string& words) {
  return std::ranges::any_of(frame.warnings,
                             [&](const std::string& w) { return w.find(words) != std::string::npos; });
}

/// Returns the grey byte of a value.
int byteOf(const Frame& frame, float value) {
  return greyBytes(std::vector<float>{value}, frame.greys.at(0).mapping)[0];
}

void setTable(DcmDataset& d, int bits, const std::vector<Uint16>& entries) {
  DcmItem* item = nullptr;
  d.findOrCreateSequenceItem(DCM_VOILUTSequence, item);
  const Uint16 descriptor[] = {Uint16(entries.size()), 0, Uint16(bits)};
  item->putAndInsertUint16Array(DcmTag(DCM_LUTDescriptor, EVR_US), descriptor, 3);
  item->putAndInsertUint16Array(DcmTag(DCM_LUTData, EVR_OW), entries.data(), entries.size());
}

}  // namespace

void TestFrameContradictions::jpegStreamsSayTheirColours_data() {
  QTest::addColumn<QByteArray>("stream");
  QTest::addColumn<dicom::JpegColours>("colours");
  const QByteArray jfif =
                       "ffe00010"
                       "4a46494600"
                       "010100000100010000",
                   adobe = "ffee000e41646f62650064000000000";
  const auto frame = [](const char* marker, const char* ids, const char* sampling) {
    const QByteArray id(ids), s(sampling);
    return QByteArray("ff") + marker +
           "0011"
           "08"
           "0010"
           "0010"
           "03" +
           id.mid(0, 2) + s.mid(0, 2) + "00" + id.mid(2, 2) + s.mid(2, 2) + "01" + id.mid(4, 2) +
           s.mid(4, 2) + "01";
  };
  const QByteArray numbered = frame("c0", "010203", "111111"), letters = frame("c0", "524742", "111111"),
                   halved = frame("c0", "010203", "211111"), lossless = frame("c3", "010203", "111111");
  const auto row = [](const char* name, const QByteArray& hex, dicom::JpegColours colours) {
    QTest::newRow(name) << QByteArray::fromHex("ffd8" + hex) << colours;
  };
  using enum dicom::JpegColours;
  row("nothing", numbered, unsaid);
  row("JFIF", jfif + numbered, ybr);
  row("Adobe, RGB", adobe + "0" + numbered, rgb);
  row("Adobe, YCbCr", adobe + "1" + numbered, ybr);
  row("Adobe before JFIF", jfif + adobe + "0" + numbered, rgb);
  row("components R, G, B", letters, rgb);
  row("Adobe before components", adobe + "1" + letters, ybr);
  row("halved colours", halved, ybr);
  row("lossless", lossless, unsaid);
  row("lossless with a mark", jfif + lossless, unsaid);
  row("cut off", "ffe00010", unsaid);
}

void TestFrameContradictions::jpegStreamsSayTheirColours() {
  QFETCH(QByteArray, stream);
  QFETCH(dicom::JpegColours, colours);
  const dicom::Bytes bytes(reinterpret_cast<const std::uint8_t*>(stream.constData()),
                           std::size_t(stream.size()));
  QVERIFY(dicom::jpegColours(bytes) == colours);
}

void TestFrameContradictions::theStreamDecides_data() {
  QTest::addColumn<QString>("folder");
  QTest::newRow("components R, G, B") << QStringLiteral("c23e-jpeg-rgb-ids-labelled-ybr");
  QTest::newRow("Adobe") << QStringLiteral("c23f-jpeg-adobe-rgb-labelled-ybr");
}

void TestFrameContradictions::theStreamDecides() {
  NEED_DATA(dataPath());
  QFETCH(QString, folder);
  const auto frame = frameOf(dataPath("field-cases/" + folder.toStdString()) + "/a.dcm");
  QVERIFY2(frame.ok(), frame.ok() ? "" : frame.message().c_str());
  const struct {
    int row, column, rgb[3];
  } places[] = {
      {16, 16, {255, 0, 0}}, {16, 48, {0, 255, 0}}, {48, 16, {0, 0, 255}}, {48, 48, {200, 150, 20}}};
  for (const auto& p : places)
    for (int c = 0; c < 3; ++c) {
      const int found = frame->rgb[3 * std::size_t(p.row * frame->size.x + p.column) + std::size_t(c)];
      QVERIFY2(std::abs(found - p.rgb[c]) <= 14, qPrintable(QString::number(found)));
    }
  QVERIFY(says(*frame, "PhotometricInterpretation is YBR_FULL_422, and its JPEG stream says that it is RGB"));
}

void TestFrameContradictions::tablesAreShownByTheirOwnRange_data() {
  QTest::addColumn<int>("bits");
  QTest::addColumn<int>("largest");
  QTest::addColumn<int>("grey");  // grey of the largest value
  QTest::addColumn<bool>("told");
  QTest::newRow("16 bits, all used") << 16 << 65535 << 255 << false;
  QTest::newRow("16 bits, 12 used") << 16 << 4095 << 255 << true;
  QTest::newRow("16 bits, 14 used") << 16 << 16383 << 255 << true;
  QTest::newRow("16 bits, 10 used") << 16 << 1023 << 255 << true;
  QTest::newRow("12 bits, 8 used") << 12 << 255 << 255 << true;
  QTest::newRow("12 bits, all used") << 12 << 4095 << 255 << false;
  QTest::newRow("half of them: as it says") << 16 << 32767 << 127 << false;
  QTest::newRow("nothing but black") << 16 << 0 << 0 << false;
}

void TestFrameContradictions::tablesAreShownByTheirOwnRange() {
  QFETCH(int, bits);
  QFETCH(int, largest);
  QFETCH(int, grey);
  QFETCH(bool, told);
  const DicomFolder folder;
  DicomPicture picture;
  picture.edit = [&](DcmDataset& d) { setTable(d, bits, {0, Uint16(largest / 2), Uint16(largest)}); };
  folder.add("a", picture);
  const auto frame = frameOf(folder.path("a"));
  QVERIFY(frame.ok());
  QCOMPARE(byteOf(*frame, 2), grey);
  QCOMPARE(says(*frame, "VOI LUT says that it has"), told);
}

void TestFrameContradictions::aNarrowTableOfTheField() {
  NEED_DATA(dataPath());
  const auto frame = frameOf(dataPath("field-cases/c22-voi-lut-narrow/a.dcm"));
  QVERIFY(frame.ok());
  QVERIFY(says(*frame, "has 16 bits, and its values use 12"));
  QVERIFY(byteOf(*frame, std::ranges::max(frame->values.floats())) > 250);
}

void TestFrameContradictions::palettesAreNeverBlack() {
  const DicomFolder folder;
  DicomPicture picture;
  picture.edit = [](DcmDataset& d) {
    d.putAndInsertString(DCM_PhotometricInterpretation, "PALETTE COLOR");
    const Uint16 descriptor[] = {2, 0, 16}, entries[] = {200, 100};
    for (Uint16 colour = 0; colour < 3; ++colour) {
      d.putAndInsertUint16Array(DcmTag(0x0028, Uint16(0x1101 + colour), EVR_US), descriptor, 3);
      d.putAndInsertUint16Array(DcmTag(0x0028, Uint16(0x1201 + colour), EVR_OW), entries, 2);
    }
  };
  folder.add("a", picture);
  const auto frame = frameOf(folder.path("a"));
  QVERIFY2(frame.ok(), frame.ok() ? "" : frame.message().c_str());
  QCOMPARE(int(frame->rgb[0]), 200);
  QVERIFY(says(*frame, "palette says that it has 16 bits"));
}

void TestFrameContradictions::storedBitsDecide_data() {
  QTest::addColumn<QString>("folder");
  QTest::addColumn<float>("least");
  QTest::addColumn<float>("most");
  QTest::addColumn<bool>("told");
  QTest::newRow("a sign that the stream has not")
      << QStringLiteral("c16-j2k-sign") << -2000.f << 3000.f << true;
  QTest::newRow("ones above the high bit") << QStringLiteral("c18-high-bits") << 0.f << 15300.f << false;
}

void TestFrameContradictions::storedBitsDecide() {
  NEED_DATA(dataPath());
  QFETCH(QString, folder);
  QFETCH(float, least);
  QFETCH(float, most);
  QFETCH(bool, told);
  const auto frame = frameOf(dataPath("field-cases/" + folder.toStdString()));
  QVERIFY2(frame.ok(), frame.ok() ? "" : frame.message().c_str());
  const auto [low, high] = std::ranges::minmax(frame->values.floats());
  QCOMPARE(low, least);
  QCOMPARE(high, most);
  QCOMPARE(!frame->warnings.empty(), told);
}

VOLUMEN_TEST(TestFrameContradictions);
#include "tst_frame_contradictions.moc"
