// Guards slices.md 2: colour in synthetic files: palettes of every form, planes, halved colour differences,
// and coded colours.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QTemporaryDir>

#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/io/frame_of.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

using Edit = std::function<void(DcmDataset&)>;
using Words = std::vector<std::uint16_t>;
Q_DECLARE_METATYPE(Edit)

class TestFrameColour : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void palettes_data();
  void palettes();
  void layouts_data();
  void layouts();
  void codersKeepColours_data();
  void codersKeepColours();
};

namespace {

/// Sets 8-bit samples of a photometric interpretation.
void setColour(DcmDataset& data, const char* photometric, int samples, const std::vector<std::uint8_t>& bytes,
               int planar = 0) {
  data.putAndInsertString(DCM_PhotometricInterpretation, photometric);
  data.putAndInsertUint16(DCM_SamplesPerPixel, Uint16(samples));
  if (samples > 1) data.putAndInsertUint16(DCM_PlanarConfiguration, Uint16(planar));
  data.putAndInsertUint16(DCM_BitsAllocated, 8);
  data.putAndInsertUint16(DCM_BitsStored, 8);
  data.putAndInsertUint16(DCM_HighBit, 7);
  data.putAndInsertUint8Array(DCM_PixelData, bytes.data(), bytes.size());
}

/// Sets the same table for all three colours.
void setPalette(DcmDataset& data, const Words& descriptor, const Words& entries, bool segmented = false) {
  for (Uint16 colour = 0; colour < 3; ++colour) {
    data.putAndInsertUint16Array(DcmTag(0x0028, Uint16(0x1101 + colour), EVR_US), descriptor.data(),
                                 descriptor.size());
    const Uint16 element = Uint16((segmented ? 0x1221 : 0x1201) + colour);
    data.putAndInsertUint16Array(DcmTag(0x0028, element, EVR_OW), entries.data(), entries.size());
  }
}

Result<Frame> frameWith(DicomPicture picture, const Edit& edit, const char* syntax = "1.2.840.10008.1.2.1") {
  QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("a")).toStdString();
  picture.edit = edit;
  writeDicom(path, picture, syntax);
  return frameOf(path);
}

DicomPicture rowOfFour() {
  DicomPicture p;
  p.columns = 4;
  p.rows = 1;
  return p;
}

QList<int> asList(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace

void TestFrameColour::palettes_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<QList<int>>("reds");
  const auto row = [](const char* name, Words descriptor, Words entries, QList<int> reds,
                      bool segmented = false) {
    QTest::newRow(name) << Edit([=](DcmDataset& data) {
      setColour(data, "PALETTE COLOR", 1, {0, 1, 2, 3});
      setPalette(data, descriptor, entries, segmented);
    }) << reds;
  };
  row("entries of 16 bits: the upper ones", {4, 0, 16}, {0x11ff, 0x2200, 0x8000, 0xffff},
      {0x11, 0x22, 0x80, 0xff});
  row("entries of 8 bits, one a word", {4, 0, 8}, {1, 20, 30, 255}, {1, 20, 30, 255});
  row("entries of 8 bits, two a word", {4, 0, 8}, {0x1401, 0xff1e}, {1, 20, 30, 255});
  row("beyond either end", {2, 1, 16}, {0x0500, 0x0900}, {5, 5, 9, 9});
  Words all(65536);
  for (std::size_t n = 0; n < all.size(); ++n) all[n] = std::uint16_t(n * 256);
  row("0 entries are 65536", {0, 0, 16}, all, {0, 1, 2, 3});
  row("segments: discrete and linear", {4, 0, 16}, {0, 2, 0x1000, 0x2000, 1, 2, 0x4000}, {16, 32, 48, 64},
      true);
  row("segments: indirect", {4, 0, 16}, {0, 2, 0x1000, 0x2000, 2, 1, 0, 0}, {16, 32, 16, 32}, true);
  row("segments of 8 bits", {4, 0, 8}, {0x0200, 0x2010, 0x0201, 0x0040}, {16, 32, 48, 64}, true);
  row("segments of 8 bits: indirect", {4, 0, 8}, {0x0200, 0x2010, 0x0102, 0, 0}, {16, 32, 16, 32}, true);
  QTest::newRow("signed pixels, first input -2") << Edit([](DcmDataset& data) {
    setColour(data, "PALETTE COLOR", 1, {0xfe, 0xff, 0, 1});
    data.putAndInsertUint16(DCM_PixelRepresentation, 1);
    setPalette(data, {4, 0xfffe, 16}, {0x0100, 0x0200, 0x0300, 0x0400});
  }) << QList<int>{1, 2, 3, 4};
}

void TestFrameColour::palettes() {
  QFETCH(Edit, edit);
  QFETCH(QList<int>, reds);
  const Result<Frame> frame = frameWith(rowOfFour(), edit);
  QVERIFY2(frame.ok(), frame.ok() ? "" : frame.message().c_str());
  QList<int> grey;
  for (const int red : reds) grey << red << red << red;
  QCOMPARE(asList(frame->rgb), grey);
}

void TestFrameColour::layouts_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<QList<int>>("rgb");
  const auto row = [](const char* name, const char* photometric, std::vector<std::uint8_t> bytes, int planar,
                      QList<int> rgb) {
    QTest::newRow(name) << Edit([=](DcmDataset& d) { setColour(d, photometric, 3, bytes, planar); }) << rgb;
  };
  const QList<int> four{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  row("RGB by pixel", "RGB", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, 0, four);
  row("RGB by plane", "RGB", {1, 4, 7, 10, 2, 5, 8, 11, 3, 6, 9, 12}, 1, four);
  // Y, Y + 1.402 (255 - 128) clipped to 255; Y - 0.714136 x 127; Y + 1.772 (0 - 128) clipped to 0.
  row("YBR_FULL by pixel", "YBR_FULL", {128, 128, 128, 128, 128, 255, 200, 0, 128, 7, 128, 128}, 0,
      {128, 128, 128, 255, 37, 128, 200, 244, 0, 7, 7, 7});
  row("YBR_FULL by plane", "YBR_FULL", {128, 128, 200, 7, 128, 128, 0, 128, 128, 255, 128, 128}, 1,
      {128, 128, 128, 255, 37, 128, 200, 244, 0, 7, 7, 7});
  row("YBR_FULL_422: two pixels share their colour", "YBR_FULL_422", {128, 10, 128, 255, 7, 9, 128, 128}, 0,
      {255, 37, 128, 188, 0, 10, 7, 7, 7, 9, 9, 9});
}

void TestFrameColour::layouts() {
  QFETCH(Edit, edit);
  QFETCH(QList<int>, rgb);
  const Result<Frame> frame = frameWith(rowOfFour(), edit);
  QVERIFY2(frame.ok(), frame.ok() ? "" : frame.message().c_str());
  QCOMPARE(asList(frame->rgb), rgb);
}

void TestFrameColour::codersKeepColours_data() {
  QTest::addColumn<QByteArray>("syntax");
  QTest::newRow("big endian") << QByteArray("1.2.840.10008.1.2.2");
  QTest::newRow("deflated") << QByteArray("1.2.840.10008.1.2.1.99");
  QTest::newRow("RLE") << QByteArray("1.2.840.10008.1.2.5");
  QTest::newRow("JPEG lossless") << QByteArray("1.2.840.10008.1.2.4.70");
  QTest::newRow("JPEG-LS") << QByteArray("1.2.840.10008.1.2.4.80");
}

void TestFrameColour::codersKeepColours() {
  QFETCH(QByteArray, syntax);
  DicomPicture picture;
  picture.columns = 32;
  picture.rows = 16;
  std::vector<std::uint8_t> bytes;
  for (int n = 0; n < 3 * 32 * 16; ++n) bytes.push_back(std::uint8_t(n * 7919 % 251));
  const Result<Frame> frame = frameWith(
      picture, [&](DcmDataset& d) { setColour(d, "RGB", 3, bytes); }, syntax.constData());
  QVERIFY2(frame.ok(), frame.ok() ? "" : frame.message().c_str());
  QVERIFY(frame->rgb == bytes);
}

VOLUMEN_TEST(TestFrameColour);
#include "tst_frame_colour.moc"
