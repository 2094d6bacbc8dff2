// Guards design.md 7 (walls a and b): no file crashes or hangs the program or shows an invented picture.
#include <sys/stat.h>

#include <QTemporaryDir>
#include <algorithm>
#include <filesystem>
#include <random>

#include "io/load.h"
#include "io/open.h"
#include "tests/fixtures/cpu_timer.h"
#include "tests/unit/io/dicom_bytes.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestDicomHostile : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void refusedWithAReason_data();
  void refusedWithAReason();
  void sparseZerosTakeNoTime();
  void folderOfTrapsIsWalked();
  void cutAnywhereItNeverInvents_data();
  void cutAnywhereItNeverInvents();
  void cutScanThatEndsProperlyIsRefused_data();
  void cutScanThatEndsProperlyIsRefused();
  void flippedBytesDoNoHarm_data();
  void flippedBytesDoNoHarm();
};

void TestDicomHostile::refusedWithAReason_data() {
  QTest::addColumn<QByteArray>("bytes");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* name, const Buffer& b, const char* says) {
    QTest::newRow(name) << QByteArray(reinterpret_cast<const char*>(b.data()), qsizetype(b.size()))
                        << QString::fromLatin1(says);
  };
  const std::string explicitSyntax = "1.2.840.10008.1.2.1", jpeg = "1.2.840.10008.1.2.4.70";
  const std::string rle = "1.2.840.10008.1.2.5", jpeg2000 = "1.2.840.10008.1.2.4.90";
  row("sequences nested 100,000 deep", nested("SQ", true, 100000), "deeper than 64");
  row("sequences nested, implicit VR", nested("SQ", false, 100000), "deeper than 64");
  row("sequences nested in VR UN", nested("UN", true, 100000), "deeper than 64");
  row("group 0000 in the data set", native([] {
        Builder b = Builder::file();
        b.bytes.resize(b.bytes.size() + 4096);
        return b;
      }()),
      "group 0000");
  Builder longer = Builder::file();
  longer.longElement(0x00091010, "OB", 0xfffffffe);
  row("a length beyond the file", longer.bytes, "claims 4294967294 bytes");
  row("deflate bomb", deflateBomb(), "grows beyond 64 MiB");
  for (const char* frames : {"10000000000", "99999999999999999999", "4294967297", "-1", "1A", "1.5"})
    row((std::string("NumberOfFrames ") + frames).c_str(),
        native(picture(explicitSyntax, 0x00280008, 0, frames)), "NumberOfFrames");
  row("NumberOfFrames 0, half a frame", native(picture(explicitSyntax, 0x00280008, 0, "0"), 16, 16),
      "NumberOfFrames");
  row("frames without data", native(picture(explicitSyntax, 0x00280008, 0, "1000")), "");
  row("no rows", native(picture(explicitSyntax, 0x00280010, 0)), "Rows");
  row("65535 rows, few bytes", native(picture(explicitSyntax, 0x00280010, 65535)), "cut off: 32 of 524280");
  row("short by one byte", native(picture(explicitSyntax), 32, 31), "cut off: 31 of 32");
  row("bits allocated 7", native(picture(explicitSyntax, 0x00280100, 7)), "BitsAllocated is 7");
  row("bits allocated 65535", native(picture(explicitSyntax, 0x00280100, 65535)), "BitsAllocated is 65535");
  row("bits stored 17 of 16", native(picture(explicitSyntax, 0x00280101, 17)), "BitsStored is 17");
  row("high bit below the stored bits", native(picture(explicitSyntax, 0x00280102, 3)), "HighBit is 3");
  for (unsigned samples : {0u, 2u, 255u})
    row(("samples per pixel " + std::to_string(samples)).c_str(),
        native(picture(explicitSyntax, 0x00280002, samples)), "SamplesPerPixel");
  row("JPEG of 20000 x 20000", fragment(picture(jpeg), jpegStream(20000, 20000)), "");
  row("JPEG larger than the file says", fragment(picture(jpeg), jpegStream(5, 4)), "5 x 4 pixels");
  row("JPEG smaller than the file says", fragment(picture(jpeg), jpegStream(2, 2)), "2 x 2 pixels");
  row("JPEG with marker FF01", fragment(picture(jpeg), jpegStream(4, 4, 0x01)), "marker");
  row("JPEG without data", fragment(picture(jpeg), {0xff, 0xd8, 0xff, 0xd9}), "no picture");
  row("native, in fragments of nothing known", fragment(picture(explicitSyntax), {1, 2, 3, 4}),
      "they hold no picture that is known");
  row("JPEG without fragments", native(picture(jpeg), 34, 34), "not in fragments");
  row("RLE offset beyond", fragment(picture(rle), rleStream(2, 64, 9999, 100)), "outside its data");
  row("RLE with 2^31 segments", fragment(picture(rle), rleStream(0x7fffffff, 64, 80, 100)), "segments");
  row("RLE header cut off", fragment(picture(rle), rleStream(2, 64, 80, 20)), "cut off");
  row("RLE without fragments", fragment(picture(rle), {}), "");
  row("JPEG 2000 of 20000 x 20000", fragment(picture(jpeg2000), jpeg2000Stream(20000, 20000, false)),
      "20000");
  row("JPEG 2000 with 16 million tiles", fragment(picture(jpeg2000), jpeg2000Stream(4000, 4000, true)),
      "tiles");
  row("JPEG 2000 of nothing but a header", fragment(picture(jpeg2000), jpeg2000Stream(4, 4, false)),
      "damaged");
}

void TestDicomHostile::refusedWithAReason() {
  QFETCH(QByteArray, bytes);
  QFETCH(QString, says);
  QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("a")).toStdString();
  writeAll(path, Buffer(bytes.begin(), bytes.end()));
  const CpuTimer timer;
  const Result<Study> study = openStudy(path);
  QVERIFY(study.ok());
  std::string reason = study->refused.empty() ? "" : study->refused[0].reason;
  if (!study->volumes.empty()) {
    const Result<Loaded> loaded = loadSeries(study->volumes[0]);
    QVERIFY2(!loaded.ok(), "loaded");
    reason = loaded.message();
  }
  QVERIFY2(reason.find(says.toStdString()) != std::string::npos && reason.ends_with("."), reason.c_str());
  QVERIFY2(timer.elapsed() < 2000, "slow");
}

void TestDicomHostile::sparseZerosTakeNoTime() {
  QTemporaryDir folder;
  const std::string plain = folder.filePath(QStringLiteral("plain")).toStdString();
  const std::string magic = folder.filePath(QStringLiteral("magic")).toStdString();
  writeAll(plain, Buffer(1));
  writeAll(magic, Builder::file().bytes);
  for (const std::string& path : {plain, magic}) std::filesystem::resize_file(path, std::uintmax_t(1) << 30);
  const CpuTimer timer;
  const Result<Study> study = openStudy(folder.path().toStdString());
  QVERIFY(study.ok() && study->volumes.empty());
  QCOMPARE(study->refused.size(), std::size_t(1));
  QCOMPARE(study->other.size(), std::size_t(1));
  QVERIFY2(timer.elapsed() < 2000, "slow");
}

void TestDicomHostile::folderOfTrapsIsWalked() {
  QTemporaryDir folder;
  const std::filesystem::path root = folder.path().toStdString();
  std::filesystem::create_directories(root / "deep/deeper");
  std::filesystem::create_directory_symlink(root, root / "deep/deeper/loop");
  std::filesystem::create_symlink("self", root / "self");
  std::filesystem::create_symlink("/nowhere/at/all", root / "dangling");
  QVERIFY(mkfifo((root / "fifo").c_str(), 0600) == 0);
  writeAll(root / "empty", {});
  writeAll(root / "text.txt", {'h', 'e', 'l', 'l', 'o'});
  writeDicom(root / "deep/deeper/picture", {});
  std::filesystem::create_hard_link(root / "deep/deeper/picture", root / "same picture");
  std::filesystem::create_symlink(root / "same picture", root / "and again");
  const Result<Study> study = openStudy(root);
  QVERIFY(study.ok());
  QCOMPARE(study->volumes.size(), std::size_t(1));
  QCOMPARE(study->volumes[0].acquired.size.z, 1);
  QCOMPARE(study->volumes[0].warnings.size(),
           std::size_t(2));  // no thickness, lost files; none about copies
  QCOMPARE(study->volumes[0].unread.size(), std::size_t(4));
  QCOMPARE(study->volumes[0].unread.back().path, (root / "empty").string());
  QCOMPARE(study->other.size(), std::size_t(1));
  QCOMPARE(study->refused.size(), std::size_t(4));  // the empty file, two links to nowhere, the pipe
  const Result<Study> missing = openStudy(root / "no such file");
  QVERIFY(!missing.ok() && missing.message().ends_with("."));
}

namespace {

void codings() {
  QTest::addColumn<QByteArray>("syntax");
  QTest::newRow("implicit") << QByteArray("1.2.840.10008.1.2");
  QTest::newRow("explicit") << QByteArray("1.2.840.10008.1.2.1");
  QTest::newRow("big endian") << QByteArray("1.2.840.10008.1.2.2");
  QTest::newRow("deflated") << QByteArray("1.2.840.10008.1.2.1.99");
  QTest::newRow("RLE") << QByteArray("1.2.840.10008.1.2.5");
  QTest::newRow("JPEG lossless") << QByteArray("1.2.840.10008.1.2.4.70");
  QTest::newRow("JPEG-LS") << QByteArray("1.2.840.10008.1.2.4.80");
}

/// Returns a textured picture, so that its coded bytes matter.
DicomPicture textured() {
  DicomPicture p;
  p.columns = p.rows = 24;
  std::mt19937 random(7);
  for (int n = 0; n < p.columns * p.rows; ++n) p.pixels.push_back(std::uint16_t(1000 + n + random() % 64));
  return p;
}

/// Returns whether the loaded volume is exactly the picture.
bool isThePicture(const Volume& volume, const DicomPicture& p) {
  if (volume.size() != glm::ivec3(p.columns, p.rows, 1)) return false;
  for (std::size_t n = 0; n < p.pixels.size(); ++n)
    if (volume.valueAt(n) != float(p.pixels[n])) return false;
  return true;
}

}  // namespace

void TestDicomHostile::cutAnywhereItNeverInvents_data() { codings(); }

void TestDicomHostile::cutAnywhereItNeverInvents() {
  QFETCH(QByteArray, syntax);
  QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("a")).toStdString();
  const DicomPicture p = textured();
  writeDicom(path, p, syntax.constData());
  const Buffer whole = readAll(path);
  for (std::size_t length = 0; length < whole.size(); length += 1 + length / 100) {
    writeAll(path, Buffer(whole.begin(), whole.begin() + std::ptrdiff_t(length)));
    const Result<Study> study = openStudy(path);
    QVERIFY(study.ok());
    if (study->volumes.empty()) continue;
    const Result<Loaded> loaded = loadSeries(study->volumes[0]);
    QVERIFY2(!loaded.ok() || isThePicture(*loaded->acquired, p), std::to_string(length).c_str());
  }
}

void TestDicomHostile::cutScanThatEndsProperlyIsRefused_data() {
  QTest::addColumn<QByteArray>("syntax");
  QTest::newRow("JPEG lossless") << QByteArray("1.2.840.10008.1.2.4.70");
  QTest::newRow("JPEG-LS") << QByteArray("1.2.840.10008.1.2.4.80");
}

// The decoders' libraries fill missing parts with grey and report success.
void TestDicomHostile::cutScanThatEndsProperlyIsRefused() {
  QFETCH(QByteArray, syntax);
  QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("a")).toStdString();
  const DicomPicture p = textured();
  writeDicom(path, p, syntax.constData());
  Buffer bytes = readAll(path);
  const Buffer end{0xff, 0xd9};
  const auto eoi = std::find_end(bytes.begin(), bytes.end(), end.begin(), end.end());
  QVERIFY(eoi != bytes.end());
  // The second half of the scan becomes fill bytes after an early end.
  const auto half = eoi - 300;
  std::copy(end.begin(), end.end(), half);
  std::fill(half + 2, eoi + 2, 0);
  writeAll(path, bytes);
  const Result<Study> study = openStudy(path);
  QVERIFY(study.ok() && study->volumes.size() == 1);
  const Result<Loaded> loaded = loadSeries(study->volumes[0]);
  QVERIFY(!loaded.ok());
}

void TestDicomHostile::flippedBytesDoNoHarm_data() { codings(); }

void TestDicomHostile::flippedBytesDoNoHarm() {
  QFETCH(QByteArray, syntax);
  QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("a")).toStdString();
  writeDicom(path, textured(), syntax.constData());
  const Buffer whole = readAll(path);
  std::mt19937 random(11);
  for (int trial = 0; trial < 300; ++trial) {
    Buffer bytes = whole;
    for (int n = 0; n < 3; ++n) bytes[132 + random() % (bytes.size() - 132)] = std::uint8_t(random());
    writeAll(path, bytes);
    const Result<Study> study = openStudy(path);
    QVERIFY(study.ok());
    for (const Series& s : study->volumes) {
      const Result<Loaded> loaded = loadSeries(s);
      if (!loaded.ok()) QVERIFY(!loaded.message().empty());
    }
  }
}

VOLUMEN_TEST(TestDicomHostile);
#include "tst_dicom_hostile.moc"
