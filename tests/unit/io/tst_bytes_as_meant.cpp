// Guards import.md: if a file contradicts its bytes, the bytes are right. Covers the transfer syntax, the
// wrapping of deflated data, VRs, numbers of frames, and positions without a pixel size.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <zlib.h>

#include <cstring>
#include <limits>

#include "tests/unit/io/dicom_bytes.h"
#include "tests/unit/io/dicom_frames.h"
#include "tests/unit/io/frame_of.h"
#include "tests/unit/io/other_formats.h"
#include "tests/unit/io/series_summary.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestBytesAsMeant : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void syntaxIsThatOfThePixels_data();
  void syntaxIsThatOfThePixels();
  void deflatedDataMayBeWrapped_data();
  void deflatedDataMayBeWrapped();
  void oddFramesOfBigEndianWords_data();
  void oddFramesOfBigEndianWords();
  void framesAreCountedByTheirBytes_data();
  void framesAreCountedByTheirBytes();
  void unknownVrsAreLeftBehind_data();
  void unknownVrsAreLeftBehind();
  void framesWithoutASizeOfPixels();
  void directionsThatAreNone_data();
  void directionsThatAreNone();
};

namespace {

constexpr const char *nativeLittle = "1.2.840.10008.1.2.1", *nativeBig = "1.2.840.10008.1.2.2",
                     *rle = "1.2.840.10008.1.2.5", *jpegLossless = "1.2.840.10008.1.2.4.70",
                     *jpegLs = "1.2.840.10008.1.2.4.80";

DicomPicture counted() {
  DicomPicture p;
  p.columns = p.rows = 16;
  for (int n = 0; n < 256; ++n) p.pixels.push_back(std::uint16_t(1000 + n * n % 251));
  return p;
}

/// Returns where these bytes begin; the end if they do not occur.
std::ptrdiff_t placeOf(const Buffer& bytes, const std::string& text) {
  return std::search(bytes.begin(), bytes.end(), text.begin(), text.end()) - bytes.begin();
}

/// Makes a file claim another transfer syntax.
void rename(const std::string& path, const std::string& from, std::string to) {
  Buffer bytes = readAll(path);
  const std::ptrdiff_t at = placeOf(bytes, from);
  if (to.size() % 2) to += '\0';
  const std::size_t old = from.size() + from.size() % 2;
  bytes.erase(bytes.begin() + at, bytes.begin() + at + std::ptrdiff_t(old));
  bytes.insert(bytes.begin() + at, to.begin(), to.end());
  bytes[std::size_t(at - 2)] = std::uint8_t(to.size());
  writeAll(path, bytes);
}

std::string reasonOf(const Study& study) { return study.refused.empty() ? "" : study.refused[0].reason; }

}  // namespace

void TestBytesAsMeant::syntaxIsThatOfThePixels_data() {
  QTest::addColumn<QByteArray>("written");
  QTest::addColumn<QByteArray>("said");
  QTest::addColumn<QByteArray>("warning");
  const auto row = [](const char* name, const char* written, const char* said, const char* warning) {
    QTest::newRow(name) << QByteArray(written) << QByteArray(said) << QByteArray(warning);
  };
  row("as it is", rle, rle, "");
  row("RLE, said to be native", rle, nativeLittle, "are compressed as \"RLE Lossless\"");
  row("JPEG, said to be native", jpegLossless, nativeLittle, "are compressed as \"JPEG Lossless");
  row("JPEG-LS, said to be native", jpegLs, nativeLittle, "are compressed as \"JPEG-LS");
  row("JPEG, said to be RLE", jpegLossless, rle, "are compressed as \"JPEG Lossless");
  row("RLE, said to be JPEG", rle, jpegLossless, "are compressed as \"RLE Lossless\"");
  row("native, said to be RLE", nativeLittle, rle, "its pixels are not compressed");
  row("native, said to be JPEG", nativeLittle, jpegLossless, "its pixels are not compressed");
}

void TestBytesAsMeant::syntaxIsThatOfThePixels() {
  QFETCH(QByteArray, written);
  QFETCH(QByteArray, said);
  QFETCH(QByteArray, warning);
  const DicomFolder folder;
  const DicomPicture picture = counted();
  folder.add("a", picture, written.constData());
  rename(folder.path("a"), written.toStdString(), said.toStdString());
  const Study study = folder.open();
  QVERIFY2(study.volumes.size() == 1, reasonOf(study).c_str());
  const auto loaded = loadSeries(study.volumes[0]);
  QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
  for (std::size_t n = 0; n < picture.pixels.size(); ++n)
    QCOMPARE(loaded->acquired->valueAt(n), float(picture.pixels[n]));
  QCOMPARE(warns(study.volumes[0].warnings, "its transfer syntax is"), !warning.isEmpty());
  if (!warning.isEmpty()) QVERIFY(warns(study.volumes[0].warnings, warning.toStdString()));
}

void TestBytesAsMeant::deflatedDataMayBeWrapped_data() {
  QTest::addColumn<int>("windowBits");
  QTest::newRow("raw, as the standard has it") << -MAX_WBITS;
  QTest::newRow("zlib") << MAX_WBITS;
  QTest::newRow("gzip") << MAX_WBITS + 16;
}

void TestBytesAsMeant::deflatedDataMayBeWrapped() {
  QFETCH(int, windowBits);
  const DicomFolder folder;
  const DicomPicture picture = counted();
  folder.add("a", picture);
  const Buffer whole = readAll(folder.path("a"));
  const auto begin = std::size_t(placeOf(whole, std::string("\x08\0\x16\0UI", 6)));
  Buffer packed(2 * whole.size() + 1000);
  z_stream z{};
  deflateInit2(&z, 6, Z_DEFLATED, windowBits, 8, Z_DEFAULT_STRATEGY);
  z.next_in = const_cast<Bytef*>(whole.data()) + begin;
  z.avail_in = uInt(whole.size() - begin);
  z.next_out = packed.data();
  z.avail_out = uInt(packed.size());
  deflate(&z, Z_FINISH);
  packed.resize(packed.size() - z.avail_out);
  deflateEnd(&z);
  Buffer bytes = Builder::file("1.2.840.10008.1.2.1.99").bytes;
  bytes.insert(bytes.end(), packed.begin(), packed.end());
  writeAll(folder.path("a"), bytes);
  const Study study = folder.open();
  QVERIFY2(study.volumes.size() == 1, reasonOf(study).c_str());
  const auto loaded = loadSeries(study.volumes[0]);
  QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
  QCOMPARE(loaded->acquired->valueAt(255), float(picture.pixels[255]));
}

void TestBytesAsMeant::oddFramesOfBigEndianWords_data() {
  QTest::addColumn<int>("frames");
  QTest::newRow("one") << 1;
  QTest::newRow("two") << 2;
  QTest::newRow("three") << 3;
}

// Frames have 3 x 3 bytes, so that neighbours share a word.
void TestBytesAsMeant::oddFramesOfBigEndianWords() {
  QFETCH(int, frames);
  const int count = 9 * frames;
  std::vector<Uint16> words(std::size_t(count + 1) / 2);
  for (int n = 0; n < count; ++n) words[std::size_t(n / 2)] |= Uint16((n + 1) << (n % 2 ? 8 : 0));
  const DicomFolder folder;
  DicomPicture picture;
  picture.columns = picture.rows = 3;
  picture.edit = [&](DcmDataset& d) {
    d.putAndInsertUint16(DCM_BitsAllocated, 8);
    d.putAndInsertUint16(DCM_BitsStored, 8);
    d.putAndInsertUint16(DCM_HighBit, 7);
    d.putAndInsertString(DCM_NumberOfFrames, QByteArray::number(frames).constData());
    d.putAndInsertUint16Array(DCM_PixelData, words.data(), words.size());
  };
  folder.add("a", picture, nativeBig);
  for (int f = 0; f < frames; ++f) {
    const auto frame = frameOf(folder.path("a"), f);
    QVERIFY2(frame.ok(), frame.ok() ? "" : frame.message().c_str());
    for (int n = 0; n < 9; ++n) QCOMPARE(frame->values[std::size_t(n)], float(9 * f + n + 1));
  }
}

void TestBytesAsMeant::framesAreCountedByTheirBytes_data() {
  QTest::addColumn<int>("words");  // 12 are one frame
  QTest::addColumn<QByteArray>("syntax");
  QTest::addColumn<int>("frames");  // 0 if refused
  QTest::newRow("one") << 12 << QByteArray(nativeLittle) << 1;
  QTest::newRow("three") << 36 << QByteArray(nativeLittle) << 3;
  QTest::newRow("one and a half") << 18 << QByteArray(nativeLittle) << 0;
  QTest::newRow("half of one") << 6 << QByteArray(nativeLittle) << 0;
  QTest::newRow("one that is compressed") << 12 << QByteArray(rle) << 1;
}

void TestBytesAsMeant::framesAreCountedByTheirBytes() {
  QFETCH(int, words);
  QFETCH(QByteArray, syntax);
  QFETCH(int, frames);
  const DicomFolder folder;
  DicomPicture picture;
  picture.edit = [&](DcmDataset& d) {
    const std::vector<Uint16> pixels(std::size_t(words), 7);
    d.putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
    if (syntax == nativeLittle) d.putAndInsertString(DCM_NumberOfFrames, "0");
  };
  folder.add("a", picture, syntax.constData());
  if (syntax != nativeLittle) {
    Buffer bytes = readAll(folder.path("a"));
    Builder b;
    b.shortElement(0x00280008, "IS", "0");
    const std::ptrdiff_t rows = placeOf(bytes, std::string("\x28\0\x10\0US", 6));
    bytes.insert(bytes.begin() + rows, b.bytes.begin(), b.bytes.end());
    writeAll(folder.path("a"), bytes);
  }
  const Study study = folder.open();
  QCOMPARE(study.refused.size(), std::size_t(frames == 0));
  if (frames == 0) {
    QVERIFY2(reasonOf(study).find("NumberOfFrames is \"0\"") != std::string::npos, reasonOf(study).c_str());
    return;
  }
  const auto last = frameOf(folder.path("a"), frames - 1);
  QVERIFY2(last.ok(), last.ok() ? "" : last.message().c_str());
  QCOMPARE(last->values[11], 7.f);
  QVERIFY(!frameOf(folder.path("a"), frames).ok());
}

void TestBytesAsMeant::unknownVrsAreLeftBehind_data() {
  QTest::addColumn<QByteArray>("elements");  // inserted before Rows
  const auto element = [](unsigned number, const std::string& vr, int lengthBytes, const QByteArray& value) {
    Builder b;
    b.tag(0x00270000 | number);
    b.text(vr);
    if (lengthBytes == 4) b.word(0);
    lengthBytes == 2 ? b.word(unsigned(value.size())) : b.dword(std::uint32_t(value.size()));
    b.text(value.toStdString());
    return QByteArray(reinterpret_cast<const char*>(b.bytes.data()), qsizetype(b.bytes.size()));
  };
  const QByteArray four = "abcd", many(300, 'x');
  QTest::newRow("two letters, a short length") << element(0x1001, "ZZ", 2, four);
  QTest::newRow("two letters, a long length") << element(0x1001, "ZZ", 4, many);
  QTest::newRow("small letters, a long length") << element(0x1001, "ox", 4, four);
  QTest::newRow("question marks") << element(0x1001, "??", 2, four);
  QTest::newRow("question marks, a long length") << element(0x1001, "??", 4, many);
  QTest::newRow("zeros") << element(0x1001, std::string(2, '\0'), 2, four);
  QTest::newRow("none, as in implicit VR") << element(0x1001, "", -4, many);
  QTest::newRow("empty, none") << element(0x1001, "", -4, {});
  Builder sequence;
  sequence.tag(0x00271001);
  sequence.text("??");
  sequence.word(0), sequence.dword(0xffffffff);
  sequence.tag(0xfffee000), sequence.dword(0xffffffff);
  sequence.tag(0xfffee00d), sequence.dword(0);
  sequence.tag(0xfffee0dd), sequence.dword(0);
  QTest::newRow("a sequence without a length")
      << QByteArray(reinterpret_cast<const char*>(sequence.bytes.data()), qsizetype(sequence.bytes.size()));
  QTest::newRow("three in a row") << element(0x1001, "??", 2, four) + element(0x1002, "", -4, many) +
                                         element(0x1003, "ZZ", 4, many);
}

void TestBytesAsMeant::unknownVrsAreLeftBehind() {
  QFETCH(QByteArray, elements);
  const DicomFolder folder;
  const DicomPicture picture = counted();
  folder.add("a", picture);
  Buffer bytes = readAll(folder.path("a"));
  // Inserts before the first element of group 0028.
  const std::ptrdiff_t at = placeOf(bytes, std::string("\x28\0\x02\0US", 6));
  QVERIFY(at < std::ptrdiff_t(bytes.size()));
  bytes.insert(bytes.begin() + at, elements.begin(), elements.end());
  writeAll(folder.path("a"), bytes);
  const Study study = folder.open();
  QVERIFY2(study.volumes.size() == 1, reasonOf(study).c_str());
  const auto loaded = loadSeries(study.volumes[0]);
  QVERIFY(loaded.ok());
  QCOMPARE(loaded->acquired->valueAt(255), float(picture.pixels[255]));
}

// As in real tomosynthesis, each frame has a position, and PixelSpacing is 0.
void TestBytesAsMeant::framesWithoutASizeOfPixels() {
  const DicomFolder folder;
  DicomPicture picture;
  picture.orientation = picture.spacing = "";
  picture.edit = [](DcmDataset& d) {
    makeFrames(d, 4);
    d.findAndDeleteElement(DCM_ImagePositionPatient);
    d.putAndInsertString(DCM_Modality, "MG");
    d.putAndInsertString(DCM_ImagerPixelSpacing, "0.1\\0.1");
    group(d, -1, DCM_PlaneOrientationSequence)
        .putAndInsertString(DCM_ImageOrientationPatient, "1\\0\\0\\0\\1\\0");
    group(d, -1, DCM_PixelMeasuresSequence).putAndInsertString(DCM_PixelSpacing, "0\\0");
    for (int n = 0; n < 4; ++n)
      group(d, n, DCM_PlanePositionSequence)
          .putAndInsertString(DCM_ImagePositionPatient, ("0\\0\\" + QByteArray::number(9 - n)).constData());
  };
  folder.add("a", picture);
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const Series& series = study.volumes[0];
  QVERIFY(!series.acquired.calibrated);
  QVERIFY2(summaryOf(series).endsWith(QStringLiteral(": 3,2,1,0")), qPrintable(summaryOf(series)));
  QVERIFY(warns(series.warnings, "its PixelSpacing is missing or 0: its frames are stacked in the order"));
  QVERIFY(warns(series.warnings, "a pixel is 0.1 x 0.1 mm at detector"));
}

void TestBytesAsMeant::directionsThatAreNone_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("content");
  QTest::addColumn<QList<double>>("spacing");
  QTest::addColumn<QByteArray>("says");
  const auto nifti = [](bool qform, float spoiled, int place) {
    QByteArray file(352 + 24, '\0');
    const auto set = [&](int at, auto value) { put(file, at, value, false); };
    set(0, std::int32_t(348));
    const std::int16_t dims[] = {3, 2, 3, 4, 1, 1, 1, 1};
    for (int n = 0; n < 8; ++n) set(40 + 2 * n, dims[n]);
    for (int n = 0; n < 4; ++n) set(76 + 4 * n, n ? float(n) : 1.f);
    set(70, std::int16_t(2)), set(72, std::int16_t(8)), set(108, 352.f);
    set(252, std::int16_t(qform)), set(254, std::int16_t(1));
    for (int n = 0; n < 3; ++n) set(280 + 20 * n, 2.f);
    set(place, spoiled);
    file.replace(344, 4, QByteArray("n+1\0", 4));
    return file;
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto row = [](const char* title, const char* name, const QByteArray& content, QList<double> spacing,
                      const char* says) {
    QTest::newRow(title) << QString::fromLatin1(name) << content << spacing << QByteArray(says);
  };
  row("an sform that is one", "a.nii", nifti(true, 2, 280), {2, 2, 2}, "differ by up to");
  row("an sform with a column of zeros", "a.nii", nifti(true, 0, 300), {1, 2, 3}, "the qform is taken");
  row("an sform with NaN", "a.nii", nifti(true, nan, 284), {1, 2, 3}, "the qform is taken");
  row("an sform with NaN as its place", "a.nii", nifti(true, nan, 292), {1, 2, 3}, "the qform is taken");
  QByteArray flat = nifti(true, 0, 300);
  put(flat, 284, 2.f, false);
  row("an sform of axes in one plane", "a.nii", flat, {1, 2, 3}, "the qform is taken");
  row("the same without qform", "a.nii", nifti(false, 0, 280), {1, 2, 3}, "the sizes of voxels alone");
  row("MGH with a direction of zeros", "a.mgh", mgh([](QByteArray& h) { put(h, 62, 0.f); }), {1, 2, 3},
      "its directions are not used");
  row("MetaImage with a direction of zeros", "a.mha",
      "NDims = 3\nDimSize = 2 3 4\nElementType = MET_UCHAR\nElementSpacing = 1 2 3\n"
      "TransformMatrix = 1 0 0 0 1 0 0 0 0\nElementDataFile = LOCAL\n" +
          QByteArray(24, '\1'),
      {1, 2, 3}, "its directions are not used");
}

void TestBytesAsMeant::directionsThatAreNone() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  QFETCH(QList<double>, spacing);
  QFETCH(QByteArray, says);
  const DicomFolder folder;
  const std::string path = folder.path(name.toStdString());
  writeAll(path, Buffer(content.begin(), content.end()));
  const Study study = folder.open();
  QVERIFY2(study.volumes.size() == 1, reasonOf(study).c_str());
  const glm::dvec3 mm = study.volumes[0].acquired.spacing();
  for (int a = 0; a < 3; ++a) QVERIFY(std::abs(mm[a] - spacing[a]) < 1e-6);
  QVERIFY(warns(study.volumes[0].warnings, says.toStdString()));
  QVERIFY(loadSeries(study.volumes[0]).ok());
}

VOLUMEN_TEST(TestBytesAsMeant);
#include "tst_bytes_as_meant.moc"
