// Guards import.md: pictures of one bit a pixel (multi-frame single bit secondary captures, scanned pages).
// Their bits run on from frame to frame, lowest first, whatever their number and byte order (PS3.5 8.1.1,
// annex D).
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QTemporaryDir>
#include <random>

#include "io/load.h"
#include "io/open.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/io/frame_of.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

const QByteArray littleEndian = "1.2.840.10008.1.2.1", bigEndian = "1.2.840.10008.1.2.2",
                 implicitLittle = "1.2.840.10008.1.2", deflated = "1.2.840.10008.1.2.1.99";

struct BitPicture {
  int columns = 4, rows = 3, frames = 1;
  std::vector<bool> bits;  // columns x rows x frames

  BitPicture(int c, int r, int f, unsigned seed) : columns(c), rows(r), frames(f) {
    std::mt19937 random(seed);
    bits.resize(std::size_t(c) * std::size_t(r) * std::size_t(f));
    for (std::size_t n = 0; n < bits.size(); ++n) bits[n] = random() % 2;
  }

  bool at(int x, int y, int frame) const { return bits[std::size_t((frame * rows + y) * columns + x)]; }

  /// Returns the bits as words, which DCMTK writes in the byte order of the transfer syntax.
  std::vector<Uint16> words() const {
    std::vector<Uint16> all((bits.size() + 15) / 16);
    for (std::size_t n = 0; n < bits.size(); ++n)
      if (bits[n]) all[n / 16] = Uint16(all[n / 16] | 1 << n % 16);
    return all;
  }

  void putInto(DcmDataset& data) const {
    data.putAndInsertUint16(DCM_BitsAllocated, 1);
    data.putAndInsertUint16(DCM_BitsStored, 1);
    data.putAndInsertUint16(DCM_HighBit, 0);
    data.putAndInsertString(DCM_NumberOfFrames, std::to_string(frames).c_str());
    const std::vector<Uint16> all = words();
    data.putAndInsertUint16Array(DCM_PixelData, all.data(), all.size());
  }
};

struct Written {
  QTemporaryDir folder;
  std::string path = folder.filePath(QStringLiteral("a")).toStdString();

  Written(const BitPicture& bits, const char* syntax, const std::function<void(DcmDataset&)>& edit = {}) {
    DicomPicture picture;
    picture.columns = bits.columns;
    picture.rows = bits.rows;
    picture.edit = [&](DcmDataset& data) {
      bits.putInto(data);
      if (edit) edit(data);
    };
    writeDicom(path, picture, syntax);
  }
};

/// Returns the number of wrong pixels in all frames, or -1 if a frame cannot be read.
int wrongPixels(const BitPicture& bits, const std::string& path) {
  int wrong = 0;
  for (int n = 0; n < bits.frames; ++n) {
    const Result<Frame> frame = frameOf(path, n);
    if (!frame || frame->size != glm::ivec2(bits.columns, bits.rows)) return -1;
    for (int y = 0; y < bits.rows; ++y)
      for (int x = 0; x < bits.columns; ++x) wrong += valueAt(*frame, x, y) != float(bits.at(x, y, n));
  }
  return wrong;
}

using Edit = std::function<void(DcmDataset&)>;

}  // namespace

Q_DECLARE_METATYPE(Edit)

class TestBitPictures : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyPixelIsRead_data();
  void everyPixelIsRead();
  void oneOfAStackIsAVolume();
  void aPaletteColoursThem();
  void whatIsNotReadIsNamed_data();
  void whatIsNotReadIsNamed();
};

void TestBitPictures::everyPixelIsRead_data() {
  QTest::addColumn<int>("columns");
  QTest::addColumn<int>("rows");
  QTest::addColumn<int>("frames");
  QTest::addColumn<QByteArray>("syntax");
  QTest::newRow("one pixel") << 1 << 1 << 1 << littleEndian;
  QTest::newRow("one pixel a frame") << 1 << 1 << 33 << littleEndian;
  QTest::newRow("one pixel a frame, big endian") << 1 << 1 << 33 << bigEndian;
  QTest::newRow("whole bytes") << 8 << 3 << 3 << littleEndian;
  QTest::newRow("whole bytes, big endian") << 8 << 3 << 3 << bigEndian;
  QTest::newRow("whole words") << 16 << 4 << 3 << implicitLittle;
  QTest::newRow("a page") << 1275 << 1650 << 1 << littleEndian;
  QTest::newRow("deflated") << 13 << 7 << 5 << deflated;
  std::mt19937 random(38);
  const auto upTo = [&](unsigned most) { return int(1 + random() % most); };
  const QByteArray syntaxes[] = {littleEndian, bigEndian, implicitLittle, deflated};
  for (int n = 0; n < 60; ++n) {
    const int columns = upTo(37), rows = upTo(19), frames = upTo(9);
    QTest::addRow("%d: %d x %d x %d", n, columns, rows, frames)
        << columns << rows << frames << syntaxes[n % 4];
  }
}

void TestBitPictures::everyPixelIsRead() {
  QFETCH(int, columns);
  QFETCH(int, rows);
  QFETCH(int, frames);
  QFETCH(QByteArray, syntax);
  const BitPicture bits(columns, rows, frames, unsigned(columns * rows + frames));
  const Written file(bits, syntax.constData());
  QCOMPARE(wrongPixels(bits, file.path), 0);
  // The padding byte that makes the length even is not another frame.
  const auto study = openStudy(file.path);
  QVERIFY(study.ok());
  for (const Series& series : study->volumes)
    for (const Warning& w : series.warnings)
      QVERIFY2(w.sentence.find("not shown") == std::string::npos, w.sentence.c_str());
}

void TestBitPictures::oneOfAStackIsAVolume() {
  const QTemporaryDir folder;
  const BitPicture bits(5, 3, 1, 7);
  for (int n = 0; n < 3; ++n) {
    DicomPicture picture;
    picture.columns = bits.columns;
    picture.instance = n + 1;
    picture.position = {0, 0, double(n)};
    picture.edit = [&](DcmDataset& data) { bits.putInto(data); };
    writeDicom(folder.filePath(QString::number(n)).toStdString(), picture);
  }
  const auto study = openStudy(folder.path().toStdString());
  QVERIFY(study.ok());
  QCOMPARE(study->volumes.size(), std::size_t(1));
  QCOMPARE(study->volumes[0].valueType, std::string("uint8"));
  const auto volume = loadSeries(study->volumes[0]);
  QVERIFY2(volume.ok(), volume.ok() ? "" : volume.message().c_str());
  for (int k = 0; k < 3; ++k)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 5; ++x) QCOMPARE(volume->drawn->value(x, y, k), float(bits.at(x, y, 0)));
}

void TestBitPictures::aPaletteColoursThem() {
  const BitPicture bits(9, 2, 1, 3);
  const Written file(bits, littleEndian.constData(), [](DcmDataset& data) {
    data.putAndInsertString(DCM_PhotometricInterpretation, "PALETTE COLOR");
    const Uint16 descriptor[] = {2, 0, 16}, entries[] = {0x2000, 0xc000};
    for (Uint16 colour = 0; colour < 3; ++colour) {
      data.putAndInsertUint16Array(DcmTag(0x0028, Uint16(0x1101 + colour), EVR_US), descriptor, 3);
      data.putAndInsertUint16Array(DcmTag(0x0028, Uint16(0x1201 + colour), EVR_OW), entries, 2);
    }
  });
  const Result<Frame> frame = frameOf(file.path);
  QVERIFY2(frame.ok(), frame.ok() ? "" : frame.message().c_str());
  for (int n = 0; n < 18; ++n)
    QCOMPARE(int(frame->rgb[std::size_t(n) * 3]), bits.bits[std::size_t(n)] ? 0xc0 : 0x20);
}

void TestBitPictures::whatIsNotReadIsNamed_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<QString>("why");
  QTest::newRow("cut off") << Edit([](DcmDataset& data) { data.putAndInsertString(DCM_NumberOfFrames, "9"); })
                           << QStringLiteral("cut off: 4 of 14 bytes");
  QTest::newRow("colours") << Edit([](DcmDataset& data) {
    data.putAndInsertString(DCM_PhotometricInterpretation, "RGB");
    data.putAndInsertUint16(DCM_SamplesPerPixel, 3);
  }) << QStringLiteral("one bit a sample");
  QTest::newRow("two bits of one") << Edit([](DcmDataset& data) {
    data.putAndInsertUint16(DCM_BitsStored, 2);
  }) << QStringLiteral("BitsStored is 2");
}

void TestBitPictures::whatIsNotReadIsNamed() {
  QFETCH(Edit, edit);
  QFETCH(QString, why);
  const Written file(BitPicture(4, 3, 2, 1), littleEndian.constData(), edit);
  const auto study = openStudy(file.path);
  QVERIFY(study.ok());
  QVERIFY(study->volumes.empty() && study->images.empty());
  QCOMPARE(study->refused.size(), std::size_t(1));
  QVERIFY2(study->refused[0].reason.find(why.toStdString()) != std::string::npos,
           study->refused[0].reason.c_str());
}

VOLUMEN_TEST(TestBitPictures);
#include "tst_bit_pictures.moc"
