// Guards design.md 7 (files are untrusted): broken and hostile image files are refused in a sentence that
// names the file. Nothing outside their folder is read, and no memory is allocated for missing data.
#include <bzlib.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/files/image_file.h"
#include "io/study/series.h"
#include "tests/fixtures/cpu_timer.h"
#include "tests/unit/io/gzipped.h"
#include "tests/unit/suite.h"

using namespace volumen;
using tests::gzipped;

namespace {

QByteArray bzip2(QByteArray plain) {
  QByteArray packed(plain.size() / 100 + 1000, '\0');
  unsigned size = unsigned(packed.size());
  if (BZ2_bzBuffToBuffCompress(packed.data(), &size, plain.data(), unsigned(plain.size()), 9, 0, 0) != BZ_OK)
    qFatal("bzip2");
  packed.resize(size);
  return packed;
}

QByteArray samples(int count) { return QByteArray(count, '\7'); }

// Returns a NRRD of 4 x 3 x 2 bytes in whose header `change` is replaced by `to`.
QByteArray nrrd(const QByteArray& data, const QByteArray& change = {}, const QByteArray& to = {}) {
  QByteArray header =
      "NRRD0004\ntype: uchar\ndimension: 3\nspace: LPS\nsizes: 4 3 2\nspace directions: (1,0,0) (0,1,0) "
      "(0,0,2)\nspace origin: (0,0,0)\nencoding: raw\n";
  if (!change.isEmpty()) header.replace(change, to);
  return header + "\n" + data;
}

QByteArray meta(const QByteArray& data, const QByteArray& change = {}, const QByteArray& to = {}) {
  QByteArray header =
      "ObjectType = Image\nNDims = 3\nDimSize = 4 3 2\nElementType = MET_UCHAR\nElementSpacing = 1 1 2\n"
      "ElementDataFile = LOCAL\n";
  if (!change.isEmpty()) header.replace(change, to);
  return header + data;
}

template <class T>
void put(QByteArray& header, int place, T value) {
  std::memcpy(header.data() + place, &value, sizeof value);
}

// Returns a NIfTI-1 file of 4 x 3 x 2 bytes whose header `change` may damage.
QByteArray nifti(int dataBytes, const std::function<void(QByteArray&)>& change = {}) {
  QByteArray header(352, '\0');
  put<std::int32_t>(header, 0, 348);
  const std::int16_t dims[] = {3, 4, 3, 2, 1, 1, 1, 1};
  for (int n = 0; n < 8; ++n) {
    put(header, 40 + 2 * n, dims[n]);
    put(header, 76 + 4 * n, 1.0f);
  }
  put<std::int16_t>(header, 70, 2);
  put<std::int16_t>(header, 72, 8);
  put(header, 108, 352.0f);
  put<std::int16_t>(header, 254, 1);
  for (int row = 0; row < 3; ++row) put(header, 280 + 20 * row, 1.0f);
  header.replace(344, 4, QByteArray("n+1\0", 4));
  if (change) change(header);
  return header + samples(dataBytes);
}

const float notANumber = std::numeric_limits<float>::quiet_NaN();

QByteArray repeated(const QByteArray& piece, int count) {
  QByteArray all;
  for (int n = 0; n < count; ++n) all += piece;
  return all;
}

}  // namespace

class TestFilesHostile : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void isRefused_data();
  void isRefused();
  void soundFileIsNot_data();
  void soundFileIsNot();
  void everyCutIsRefused_data();
  void everyCutIsRefused();
  void everyBitFlipEndsWell_data();
  void everyBitFlipEndsWell();
  void linksOutAndPipesAreRefused();

 private:
  std::string write(const QString& name, const QByteArray& content) const;
  static Result<Loaded> load(const std::string& path);
  QTemporaryDir folder_;
};

std::string TestFilesHostile::write(const QString& name, const QByteArray& content) const {
  QFile file(folder_.filePath(name));
  file.remove();  // ext4 flushes a file that is truncated and rewritten
  if (!file.open(QIODevice::WriteOnly)) qFatal("no temporary file");
  file.write(content);
  return file.fileName().toStdString();
}

Result<Loaded> TestFilesHostile::load(const std::string& path) {
  const auto found = readImageFileHeaders(path);
  if (!found) return found.error();
  return loadImageFile((*found)[0]);
}

void TestFilesHostile::isRefused_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("content");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* title, const char* name, const QByteArray& content, const char* says) {
    QTest::newRow(title) << QString::fromLatin1(name) << content << QString::fromLatin1(says);
  };
  row("nrrd: raw data short by one", "a.nrrd", nrrd(samples(23)), "too short");
  row("nrrd: gzip cut off", "a.nrrd", nrrd(gzipped(samples(24)).chopped(10), "raw", "gzip"), "cut off");
  row("nrrd: gzip without its checksum", "a.nrrd", nrrd(gzipped(samples(24)).chopped(8), "raw", "gzip"),
      "cut off");
  row("nrrd: bzip2 cut off", "a.nrrd", nrrd(bzip2(samples(24)).chopped(10), "raw", "bzip2"), "cut off");
  row("nrrd: bzip2 holds less", "a.nrrd", nrrd(bzip2(samples(23)), "raw", "bzip2"), "end after 23 bytes");
  row("nrrd: bzip2 that is none", "a.nrrd", nrrd(samples(24), "raw", "bzip2"), "damaged");
  row("nrrd: large sizes, little bzip2", "a.nrrd",
      nrrd(bzip2(samples(1000)), "4 3 2", "100 100 600").replace("raw", "bzip2"), "end after 1000 bytes");
  row("nrrd: its own data file", "a.nhdr", nrrd({}, "encoding", "data file: a.nhdr\nencoding"),
      "the header itself");
  row("meta: its own data file", "a.mhd", meta({}, "LOCAL", "a.mhd"), "the header itself");
  row("nrrd: gzip holds less", "a.nrrd", nrrd(gzipped(samples(23)), "raw", "gzip"), "fewer samples");
  row("nrrd: gzip that is none", "a.nrrd", nrrd(samples(24), "raw", "gzip"), "damaged");
  row("nrrd: sizes beyond 64 bits", "a.nrrd", nrrd(samples(24), "4 3 2", "4294967296 4294967296 4294967296"),
      "axis of 4294967296");
  row("nrrd: 10^18 samples", "a.nrrd", nrrd(samples(24), "4 3 2", "1000000 1000000 1000000"), "MiB");
  row("nrrd: large sizes, little data", "a.nrrd", nrrd(samples(24), "4 3 2", "1000 1000 500"), "too short");
  row("nrrd: large sizes, little gzip", "a.nrrd",
      nrrd(gzipped(samples(24)), "4 3 2\n", "1000 1000 500\n").replace("raw", "gzip"), "too short");
  row("nrrd: size 0", "a.nrrd", nrrd(samples(24), "4 3 2", "4 0 2"), "sizes");
  row("nrrd: size negative", "a.nrrd", nrrd(samples(24), "4 3 2", "4 -3 2"), "sizes");
  row("nrrd: dimension 100", "a.nrrd", nrrd(samples(24), "dimension: 3", "dimension: 100"), "dimension");
  row("nrrd: dimension 2^31", "a.nrrd", nrrd(samples(24), "dimension: 3", "dimension: 2147483648"),
      "dimension");
  row("nrrd: data file /etc/passwd", "a.nhdr", nrrd({}, "encoding", "data file: /etc/passwd\nencoding"),
      "own folder");
  row("nrrd: data file ../../etc/passwd", "a.nhdr",
      nrrd({}, "encoding", "data file: ../../../../../../../../../etc/passwd\nencoding"), "own folder");
  row("nrrd: data file /dev/zero", "a.nhdr", nrrd({}, "encoding", "data file: /dev/zero\nencoding"),
      "own folder");
  row("nrrd: data file is the folder", "a.nhdr", nrrd({}, "encoding", "data file: .\nencoding"),
      "regular file");
  row("nrrd: data file is not there", "a.nhdr", nrrd({}, "encoding", "data file: none.raw\nencoding"),
      "not there");
  row("nrrd: pattern %n", "a.nhdr", nrrd({}, "encoding", "data file: %n%n%s 1 2 1\nencoding"), "pattern");
  row("nrrd: pattern %s", "a.nhdr", nrrd({}, "encoding", "data file: f%s 1 2 1\nencoding"), "pattern");
  row("nrrd: pattern of step 0", "a.nhdr", nrrd({}, "encoding", "data file: f%d 1 2 0\nencoding"), "pattern");
  row("nrrd: pattern of 10^9 files", "a.nhdr", nrrd({}, "encoding", "data file: f%d 1 999999999 1\nencoding"),
      "pattern");
  row("nrrd: pattern of width 10^9", "a.nhdr",
      nrrd({}, "encoding", "data file: f%0999999999d 1 2 1\nencoding"), "pattern");
  row("nrrd: list of 20000 files", "a.nhdr",
      nrrd({}, "encoding: raw\n", "encoding: raw\ndata file: LIST\n" + repeated("x\n", 20000)), "20000");
  row("nrrd: empty list", "a.nhdr", nrrd({}, "encoding: raw\n", "encoding: raw\ndata file: LIST\n"),
      "0 data files");
  row("nrrd: line of 2 MB", "a.nrrd",
      nrrd(samples(24), "encoding", "#" + QByteArray(2 << 20, 'x') + "\nencoding"), "1 MiB");
  row("nrrd: header cut off", "a.nrrd", nrrd(samples(24)).left(100), "encoding");
  row("nrrd: header without end", "a.nrrd", nrrd({}).chopped(1), "cut off");
  row("nrrd: origin NaN", "a.nrrd", nrrd(samples(24), "origin: (0,0,0)", "origin: (nan,0,0)"), "position");
  row("nrrd: direction NaN", "a.nrrd", nrrd(samples(24), "(1,0,0)", "(nan,0,0)"), "not finite");
  row("nrrd: direction infinite", "a.nrrd", nrrd(samples(24), "(1,0,0)", "(1e999,0,0)"), "space directions");
  row("nrrd: parallel directions", "a.nrrd", nrrd(samples(24), "(0,1,0)", "(2,0,0)"), "span space");
  row("nrrd: field given twice", "a.nrrd", nrrd(samples(24), "encoding", "sizes: 4 3 2\nencoding"), "twice");
  row("nrrd: no byte order", "a.nrrd", nrrd(samples(48), "uchar", "short"), "byte order");
  row("nrrd: type block", "a.nrrd", nrrd(samples(24), "uchar", "block"), "block");
  row("nrrd: byte skip -2", "a.nrrd", nrrd(samples(24), "encoding", "byte skip: -2\nencoding"), "byte skip");
  row("nrrd: byte skip 2^62", "a.nrrd",
      nrrd(samples(24), "encoding", "byte skip: 4611686018427387904\nencoding"), "byte skip");
  row("nrrd: byte skip beyond the end", "a.nrrd", nrrd(samples(24), "encoding", "byte skip: 1\nencoding"),
      "too short");
  row("nrrd: line skip beyond the end", "a.nrrd", nrrd(samples(24), "encoding", "line skip: 9\nencoding"),
      "fewer lines");
  row("nrrd: text with words", "a.nrrd", nrrd(repeated("1 ", 23) + "rm", "raw", "text"), "no number");
  row("nrrd: text out of range", "a.nrrd", nrrd(repeated("1 ", 23) + "256", "raw", "text"), "no number");
  row("nrrd: text short", "a.nrrd", nrrd(repeated("1    ", 23), "raw", "text"), "fewer samples");
  row("nrrd: hex with others", "a.nrrd", nrrd(QByteArray(48, 'g'), "raw", "hex"), "hexadecimal");
  row("nrrd: colour", "a.nrrd",
      nrrd(samples(18), "sizes: 4 3 2\nspace directions: (1,0,0)",
           "sizes: 3 3 2\nkinds: RGB-color domain domain\nspace directions: none"),
      "colour image");

  for (const char* kind : {"RGBA", "RGBAcolor", "rgbcolor", "RGB", "HSV-color", "XYZ", "3-color", "4color"})
    row((std::string("nrrd: ") + kind).c_str(), "a.nrrd",
        nrrd(samples(18), "sizes: 4 3 2\nspace directions: (1,0,0)",
             QByteArray("sizes: 3 3 2\nkinds: ") + kind + " domain domain\nspace directions: none"),
        "colour image");

  row("meta: local data short", "a.mha", meta(samples(23)), "too short");
  row("meta: broken zlib", "a.mha", meta(samples(24), "ElementType", "CompressedData = True\nElementType"),
      "damaged");
  row("meta: NDims 100", "a.mha", meta(samples(24), "NDims = 3", "NDims = 100"), "NDims");
  row("meta: NDims 0", "a.mha", meta(samples(24), "NDims = 3", "NDims = 0"), "NDims");
  row("meta: NDims -1", "a.mha", meta(samples(24), "NDims = 3", "NDims = -1"), "NDims");
  row("meta: DimSize overflow", "a.mha", meta(samples(24), "4 3 2", "2147483648 2147483648 2147483648"),
      "MiB");
  row("meta: /etc/passwd", "a.mhd", meta({}, "LOCAL", "/etc/passwd"), "own folder");
  row("meta: pattern %n%n%s", "a.mhd", meta({}, "LOCAL", "%n%n%s 1 2 1"), "pattern");
  row("meta: pattern of step 0", "a.mhd", meta({}, "LOCAL", "f%d 1 2 0"), "pattern");
  row("meta: list with a way out", "a.mhd", meta({}, "LOCAL", "LIST\n../../../../../../etc/passwd"),
      "own folder");
  row("meta: spacing 0", "a.mha", meta(samples(24), "1 1 2", "1 0 2"), "above 0");
  row("meta: spacing NaN", "a.mha", meta(samples(24), "1 1 2", "1 nan 2"), "above 0");
  row("meta: matrix of rank 2", "a.mha",
      meta(samples(24), "ElementType", "TransformMatrix = 1 0 0 0 1 0 1 1 0\nElementType"), "span space");
  row("meta: matrix too short", "a.mha",
      meta(samples(24), "ElementType", "TransformMatrix = 1 0 0\nElementType"), "9 numbers");
  row("meta: slope 0", "a.mha",
      meta(samples(24), "ElementType", "ElementToIntensityFunctionSlope = 0\nElementType"), "slope");
  row("meta: three channels", "a.mha",
      meta(samples(72), "ElementType", "ElementNumberOfChannels = 3\nElementType"), "colour image");
  row("meta: line of 2 MB", "a.mha",
      meta(samples(24), "NDims", "Comment = " + QByteArray(2 << 20, 'x') + "\nNDims"), "first MiB");
  row("meta: header cut off", "a.mha", meta({}).left(60), "ElementDataFile");
  row("meta: a scene", "a.mha", meta(samples(24), "= Image", "= Scene"), "Scene");

  const auto spoiled = [&](const char* title, auto place, auto value, const char* says) {
    row(title, "a.nii", nifti(24, [=](QByteArray& h) { put(h, place, value); }), says);
  };
  row("nifti: data short by one", "a.nii", nifti(23), "too short");
  row("nifti: gzip cut off", "a.nii.gz", gzipped(nifti(24)).chopped(12), "cut off");
  spoiled("nifti: vox_offset NaN", 108, notANumber, "vox_offset");
  spoiled("nifti: vox_offset infinite", 108, std::numeric_limits<float>::infinity(), "vox_offset");
  spoiled("nifti: vox_offset 1e30", 108, 1e30f, "vox_offset");
  spoiled("nifti: vox_offset negative", 108, -352.0f, "vox_offset");
  spoiled("nifti: vox_offset inside the header", 108, 16.0f, "vox_offset");
  spoiled("nifti: vox_offset beyond the end", 108, 4096.0f, "too short");
  spoiled("nifti: 0 dimensions", 40, std::int16_t(0), "dimensions");
  spoiled("nifti: 99 dimensions", 40, std::int16_t(99), "dimensions");
  spoiled("nifti: axis of 0", 42, std::int16_t(0), "axis of 0");
  spoiled("nifti: axis negative", 44, std::int16_t(-5), "axis of -5");
  spoiled("nifti: 32767^2 voxels", 42, std::int32_t(0x7fff7fff), "too short");
  spoiled("nifti: sform infinite", 280, std::numeric_limits<float>::infinity(), "not finite");
  spoiled("nifti: origin infinite", 292, std::numeric_limits<float>::infinity(), "position");
  spoiled("nifti: RGB", 70, std::int16_t(128), "colour image");
  spoiled("nifti: complex", 70, std::int16_t(32), "complex");
  spoiled("nifti: no such type", 70, std::int16_t(77), "type 77");
  spoiled("nifti: CIFTI", 68, std::int16_t(3001), "CIFTI");
  row("nifti: Analyze", "a.nii", nifti(24, [](QByteArray& h) { h.replace(344, 4, QByteArray(4, '\0')); }),
      "damaged NIfTI");
  row("nifti: magic of a pair in one file", "a.nii",
      nifti(24, [](QByteArray& h) { h.replace(344, 4, QByteArray("ni1\0", 4)); }), ".hdr");
  row("nifti: pair without its other half", "lonely.hdr",
      nifti(0, [](QByteArray& h) { h.replace(344, 4, QByteArray("ni1\0", 4)); }), "lonely.img");
  row("nifti: not one", "a.nii", QByteArray(400, '\1'), "348");
  row("empty file", "a.nrrd", {}, "NRRD");
}

void TestFilesHostile::isRefused() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  QFETCH(QString, says);
  const std::string path = write(name, content);
  QVERIFY(looksLikeImageFile(path));
  struct rusage before {
  }, after{};
  getrusage(RUSAGE_SELF, &before);
  const tests::CpuTimer timer;
  const Result<Loaded> loaded = load(path);
  getrusage(RUSAGE_SELF, &after);
  QVERIFY2(!loaded.ok(), "was loaded");
  QVERIFY2(loaded.message().find(says.toStdString()) != std::string::npos, loaded.message().c_str());
  QVERIFY2(loaded.message().find(path.substr(0, path.find_last_of('.'))) != std::string::npos,
           loaded.message().c_str());
  QVERIFY2(loaded.message().size() < 500, loaded.message().c_str());
  // for headers of 2 MB and zlib's tables, but for none of the promised volumes
  constexpr long fewKilobytes = 64 << 10;
  QVERIFY(after.ru_maxrss - before.ru_maxrss < fewKilobytes);
  QVERIFY(timer.elapsed() < 2000);
}

void TestFilesHostile::soundFileIsNot_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("content");
  QTest::newRow("nrrd") << QStringLiteral("s.nrrd") << nrrd(samples(24));
  QTest::newRow("nrrd gzip") << QStringLiteral("s.nrrd") << nrrd(gzipped(samples(24)), "raw", "gzip");
  QTest::newRow("nrrd bzip2") << QStringLiteral("s.nrrd") << nrrd(bzip2(samples(24)), "raw", "bzip2");
  QTest::newRow("nrrd text") << QStringLiteral("s.nrrd") << nrrd(repeated("7 ", 24), "raw", "text");
  QTest::newRow("nrrd hex") << QStringLiteral("s.nrrd") << nrrd(repeated("07", 24), "raw", "hex");
  QTest::newRow("meta") << QStringLiteral("s.mha") << meta(samples(24));
  QTest::newRow("nifti") << QStringLiteral("s.nii") << nifti(24);
  QTest::newRow("nifti gzip") << QStringLiteral("s.nii.gz") << gzipped(nifti(24));
}

void TestFilesHostile::soundFileIsNot() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  const Result<Loaded> loaded = load(write(name, content));
  QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
  QCOMPARE(loaded->acquired->size(), glm::ivec3(4, 3, 2));
  for (std::size_t n = 0; n < 24; ++n) QCOMPARE(loaded->acquired->valueAt(n), 7.0f);
}

void TestFilesHostile::everyCutIsRefused_data() { soundFileIsNot_data(); }

void TestFilesHostile::everyCutIsRefused() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  // Trailing white space of text may be missing.
  const qsizetype whole = content.trimmed().size();
  for (qsizetype length = 0; length < whole; ++length) {
    const Result<Loaded> loaded = load(write(name, content.left(length)));
    QVERIFY2(!loaded.ok(), std::to_string(length).c_str());
  }
}

void TestFilesHostile::everyBitFlipEndsWell_data() { soundFileIsNot_data(); }

// Files must neither crash nor hang, but load as something or be refused in a sentence.
void TestFilesHostile::everyBitFlipEndsWell() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  const bool compressed = name.endsWith(QStringLiteral(".gz"));
  int refused = 0;
  for (qsizetype byte = 0; byte < content.size(); ++byte) {
    QByteArray spoiled = content;
    spoiled[byte] = char(spoiled[byte] ^ (1 << (byte % 8)));
    const Result<Loaded> loaded = load(write(name, spoiled));
    if (!loaded) {
      QVERIFY(!loaded.message().empty());
      ++refused;
    } else if (compressed && byte >= 10) {
      // After gzip's header of ten bytes, the checksum detects every change.
      QFAIL(std::to_string(byte).c_str());
    }
  }
  QVERIFY(refused > 0);
}

void TestFilesHostile::linksOutAndPipesAreRefused() {
  const std::string secret = write(QStringLiteral("secret.raw"), samples(24));
  QVERIFY(QDir(folder_.path()).mkpath(QStringLiteral("inner")));
  QVERIFY(QFile::link(QString::fromStdString(secret), folder_.filePath(QStringLiteral("inner/link.raw"))));
  const std::string link =
      write(QStringLiteral("inner/a.nhdr"), nrrd({}, "encoding", "data file: link.raw\nencoding"));
  const Result<Loaded> loaded = load(link);
  QVERIFY(!loaded.ok());
  QVERIFY2(loaded.message().find("own folder") != std::string::npos, loaded.message().c_str());

  const QByteArray pipe = folder_.filePath(QStringLiteral("pipe.nrrd")).toUtf8();
  QCOMPARE(mkfifo(pipe.constData(), 0600), 0);
  QVERIFY(!looksLikeImageFile(pipe.toStdString()));
  QVERIFY(!load(pipe.toStdString()).ok());
  QVERIFY(QFile::link(QString::fromUtf8(pipe), folder_.filePath(QStringLiteral("inner/p.raw"))));
  QVERIFY(
      !load(write(QStringLiteral("b.nhdr"), nrrd({}, "encoding", "data file: pipe.nrrd\nencoding"))).ok());
}

VOLUMEN_TEST(TestFilesHostile);
#include "tst_files_hostile.moc"
