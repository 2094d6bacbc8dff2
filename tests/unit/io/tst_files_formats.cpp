// Guards design.md 7, 10 and picture.md 1: features of the formats that the real data lack. Covers every
// encoding, type, byte order, space, unit and way to name data files.
#include <bzlib.h>
#include <zlib.h>

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QtEndian>
#include <cmath>
#include <cstring>
#include <set>

#include "io/files/image_file.h"
#include "io/load.h"
#include "io/open.h"
#include "tests/unit/suite.h"

using namespace volumen;

namespace {

QByteArray counted(int from, int count) {
  QByteArray bytes;
  for (int n = 0; n < count; ++n) bytes += char(from + n);
  return bytes;
}

QByteArray zlibbed(const QByteArray& plain) { return qCompress(plain).mid(4); }

QByteArray bzipped(QByteArray plain) {
  QByteArray packed(plain.size() + 1000, '\0');
  unsigned size = unsigned(packed.size());
  if (BZ2_bzBuffToBuffCompress(packed.data(), &size, plain.data(), unsigned(plain.size()), 9, 0, 0) != BZ_OK)
    qFatal("bzip2");
  packed.resize(size);
  return packed;
}

glm::dvec3 vectorOf(const QList<double>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

class TestFilesFormats : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void samplesAreFound_data();
  void samplesAreFound();
  void everyTypeInBothOrders_data();
  void everyTypeInBothOrders();
  void geometryIsTurnedToLps_data();
  void geometryIsTurnedToLps();
  void axesOfTimeAreVolumes_data();
  void axesOfTimeAreVolumes();
  void filesOfOneNameKeepTheirVolumes();
  void rescaleOfMetaImage();
  void wideValuesAreRoundedAloud();

 private:
  std::string write(const QString& name, const QByteArray& content) const;
  QTemporaryDir folder_;
};

std::string TestFilesFormats::write(const QString& name, const QByteArray& content) const {
  QFile file(folder_.filePath(name));
  if (!file.open(QIODevice::WriteOnly)) qFatal("no temporary file");
  file.write(content);
  return file.fileName().toStdString();
}

void TestFilesFormats::samplesAreFound_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("content");
  const QByteArray nrrd = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 3 2\nspacings: 1 1 1\n";
  const QByteArray meta = "NDims = 3\nDimSize = 2 3 2\nElementType = MET_UCHAR\nElementSpacing = 1 1 1\n";
  const QByteArray data = counted(1, 12), junk = "one\ntwo\n";
  write(QStringLiteral("whole.raw"), data);
  write(QStringLiteral("two words.raw"), data);
  write(QStringLiteral("junk.raw"), junk + data);
  write(QStringLiteral("packed.gz"), zlibbed("xyz" + data));
  for (int n = 0; n < 2; ++n)
    write(QStringLiteral("part.%1").arg(n + 9, 2, 10, QLatin1Char('0')), data.mid(6 * n, 6));
  QByteArray text = "\n", hex = "\n";
  for (char c : data)
    text += QByteArray::number(c) + (c % 3 ? ", " : "\n"), hex += QByteArray(1, c).toHex() + "\n";
  const auto row = [](const char* title, const char* name, const QByteArray& content) {
    QTest::newRow(title) << QString::fromLatin1(name) << content;
  };
  row("nrrd raw", "a.nrrd", nrrd + "encoding: raw\n\n" + data);
  row("nrrd raw, CRLF", "a.nrrd", QByteArray(nrrd + "encoding: raw\n\n").replace("\n", "\r\n") + data);
  row("nrrd text", "a.nrrd", nrrd + "encoding: text\n\n" + text);
  row("nrrd hex", "a.nrrd", nrrd + "encoding: hex\n\n" + hex);
  row("nrrd hex, capitals", "a.nrrd", nrrd + "encoding: hex\n\n" + hex.toUpper());
  row("nrrd of the first version", "a.nrrd",
      QByteArray(nrrd + "encoding: hex\n\n" + hex).replace(0, nrrd.indexOf('\n'), "NRRD00.01"));
  row("nrrd gzip", "a.nrrd", nrrd + "encoding: gz\n\n" + zlibbed(data));
  row("nrrd bzip2", "a.nrrd", nrrd + "encoding: bzip2\n\n" + bzipped(data));
  write(QStringLiteral("packed.bz2"), bzipped("xyz" + data));
  row("nrrd bz2, byte skip", "a.nhdr", nrrd + "encoding: bz2\nbyte skip: 3\ndata file: packed.bz2\n");
  row("nrrd bz2, byte skip -1", "a.nhdr", nrrd + "encoding: bz2\nbyte skip: -1\ndata file: packed.bz2\n");
  row("nrrd line and byte skip", "a.nhdr",
      nrrd + "encoding: raw\nline skip: 1\nbyte skip: 4\ndata file: junk.raw\n");
  row("nrrd byte skip -1", "a.nhdr", nrrd + "encoding: raw\nbyteskip: -1\ndatafile: junk.raw\n");
  row("nrrd gzip, byte skip", "a.nhdr", nrrd + "encoding: gzip\nbyte skip: 3\ndata file: packed.gz\n");
  row("nrrd gzip, byte skip -1", "a.nhdr", nrrd + "encoding: gzip\nbyte skip: -1\ndata file: packed.gz\n");
  row("nrrd name with a space", "a.nhdr", nrrd + "encoding: raw\ndata file: two words.raw\n");
  row("nrrd list", "a.nhdr", nrrd + "encoding: raw\ndata file: LIST\npart.09\npart.10\n");
  row("nrrd list of 2-D files", "a.nhdr", nrrd + "encoding: raw\ndata file: LIST 2\n./part.09\n./part.10\n");
  row("nrrd pattern", "a.nhdr", nrrd + "encoding: raw\ndata file: part.%02d 9 10 1\n");
  row("meta local", "a.mha", meta + "ElementDataFile = LOCAL\n" + data);
  row("meta, CRLF", "a.mha", QByteArray(meta + "ElementDataFile = LOCAL\n").replace("\n", "\r\n") + data);
  row("meta with colons", "a.mha",
      QByteArray(meta + "ElementDataFile = LOCAL\n").replace(" = ", ": ") + data);
  row("meta of an array", "a.mha",
      QByteArray(meta + "ElementDataFile = LOCAL\n").replace("UCHAR", "UCHAR_ARRAY") + data);
  row("meta zlib", "a.mha", meta + "CompressedData = True\nElementDataFile = LOCAL\n" + zlibbed(data));
  row("meta text", "a.mha", meta + "BinaryData = False\nElementDataFile = LOCAL\n" + text);
  row("meta file", "a.mhd", meta + "ElementDataFile = whole.raw\n");
  row("meta HeaderSize", "a.mhd", meta + "HeaderSize = 8\nElementDataFile = junk.raw\n");
  row("meta HeaderSize -1", "a.mhd", meta + "HeaderSize = -1\nElementDataFile = junk.raw\n");
  row("meta list", "a.mhd", meta + "ElementDataFile = LIST\npart.09\npart.10\n");
  row("meta pattern", "a.mhd", meta + "ElementDataFile = part.%02d 9 10 1\n");
}

void TestFilesFormats::samplesAreFound() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  const auto found = readImageFileHeaders(write(name, content));
  QVERIFY2(found.ok(), found.ok() ? "" : found.message().c_str());
  const auto loaded = loadImageFile((*found)[0]);
  QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
  QCOMPARE(loaded->acquired->size(), glm::ivec3(2, 3, 2));
  for (std::size_t n = 0; n < 12; ++n) QCOMPARE(loaded->acquired->valueAt(n), float(n + 1));
}

namespace {

template <class T>
void addType(const char* nrrdName, const char* metaName, const char* keptAs) {
  const std::vector<T> values{T(0), T(1), std::numeric_limits<T>::max(), std::numeric_limits<T>::lowest()};
  for (const bool big : {false, true}) {
    QByteArray data;
    QList<float> expected;
    for (T v : values) {
      char bytes[sizeof(T)];
      big ? qToBigEndian(v, bytes) : qToLittleEndian(v, bytes);
      data.append(bytes, sizeof(T));
      // Volumes limit |value| to 1e30 (design.md 10).
      expected.append(float(std::clamp(double(v), -1e30, 1e30)));
    }
    const QByteArray nrrd =
        QByteArray("NRRD0004\ntype: ") + nrrdName +
        "\ndimension: 3\nsizes: 2 2 1\nspacings: 1 1 1\nencoding: raw\nendian: " + (big ? "big" : "little") +
        "\n\n" + data;
    const QByteArray meta = QByteArray("NDims = 3\nDimSize = 2 2 1\nElementSpacing = 1 1 1\nElementType = ") +
                            metaName + "\nElementByteOrderMSB = " + (big ? "True" : "False") +
                            "\nElementDataFile = LOCAL\n" + data;
    QTest::addRow("nrrd %s %s", nrrdName, big ? "big" : "little")
        << QStringLiteral("t.nrrd") << nrrd << expected << QString::fromLatin1(keptAs);
    QTest::addRow("meta %s %s", metaName, big ? "big" : "little")
        << QStringLiteral("t.mha") << meta << expected << QString::fromLatin1(keptAs);
  }
}

}  // namespace

void TestFilesFormats::everyTypeInBothOrders_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("content");
  QTest::addColumn<QList<float>>("expected");
  QTest::addColumn<QString>("keptAs");
  addType<std::int8_t>("signed char", "MET_CHAR", "int16");
  addType<std::uint8_t>("unsigned char", "MET_UCHAR", "uint8");
  addType<std::int16_t>("short", "MET_SHORT", "int16");
  addType<std::uint16_t>("unsigned short int", "MET_USHORT", "uint16");
  addType<std::int32_t>("int32_t", "MET_INT", "float32");
  addType<std::uint32_t>("uint", "MET_UINT", "float32");
  addType<qint64>("long long", "MET_LONG_LONG", "float32");
  addType<quint64>("uint64", "MET_ULONG_LONG", "float32");
  addType<float>("float", "MET_FLOAT", "float32");
  addType<double>("double", "MET_DOUBLE", "float32");
}

void TestFilesFormats::everyTypeInBothOrders() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  QFETCH(QList<float>, expected);
  QFETCH(QString, keptAs);
  const auto found = readImageFileHeaders(write(name, content));
  QVERIFY2(found.ok(), found.ok() ? "" : found.message().c_str());
  QCOMPARE((*found)[0].valueType, keptAs.toStdString());
  const auto loaded = loadImageFile((*found)[0]);
  QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
  QCOMPARE(std::string(loaded->acquired->typeName()), keptAs.toStdString());
  for (int n = 0; n < expected.size(); ++n) QCOMPARE(loaded->acquired->valueAt(std::size_t(n)), expected[n]);
}

namespace {

template <class T>
void put(QByteArray& header, int place, T value) {
  std::memcpy(header.data() + place, &value, sizeof value);
}

// Returns a NIfTI-1 file of 2 x 3 x 4 bytes with spacing 1, 2, 3. Its qform is rotated by 90 degrees about
// the third axis and has its origin at (10, 20, 30), RAS.
QByteArray niftiOfQform(float qfac, char units, float pixdim3 = 3) {
  QByteArray file(352 + 24, '\0');
  put<std::int32_t>(file, 0, 348);
  const std::int16_t dims[] = {3, 2, 3, 4, 1, 1, 1, 1};
  for (int n = 0; n < 8; ++n) put(file, 40 + 2 * n, dims[n]);
  const float pixdim[] = {qfac, 1, 2, pixdim3};
  for (int n = 0; n < 4; ++n) put(file, 76 + 4 * n, pixdim[n]);
  put<std::int16_t>(file, 70, 2);
  put<std::int16_t>(file, 72, 8);
  put(file, 108, 352.0f);
  file[123] = units;
  put<std::int16_t>(file, 252, 1);
  put(file, 264, std::sqrt(0.5f));
  for (int n = 0; n < 3; ++n) put(file, 268 + 4 * n, 10.0f * float(n + 1));
  file.replace(344, 4, QByteArray("n+1\0", 4));
  return file;
}

}  // namespace

void TestFilesFormats::geometryIsTurnedToLps_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("content");
  QTest::addColumn<QList<double>>("origin");
  QTest::addColumn<QList<double>>("far");
  QTest::addColumn<bool>("calibrated");
  QTest::addColumn<int>("warnings");
  const QList<double> start{1, 2, 3}, end{1 + 1.0, 2 + 2 * 2.0, 3 + 3 * 3.0};
  const QByteArray sizes = "type: uchar\ndimension: 3\nsizes: 2 3 4\nencoding: raw\n",
                   directions = "space directions: (1,0,0) (0, 2, 0) (0,0,3)\nspace origin: (1,2,3)\n";
  const auto nrrd = [&](const char* title, const QByteArray& fields, QList<double> origin, QList<double> far,
                        bool calibrated, int warnings) {
    QTest::newRow(title) << QStringLiteral("g.nrrd") << "NRRD0005\n" + sizes + fields + "\n" + counted(0, 24)
                         << origin << far << calibrated << warnings;
  };
  nrrd("nrrd LPS", "space: left-posterior-superior\n" + directions, start, end, true, 0);
  nrrd("nrrd RAS", "space: RAS\n" + directions, {-1, -2, 3}, {-2, -6, 12}, true, 0);
  nrrd("nrrd LAS", "space: left-anterior-superior\n" + directions, {1, -2, 3}, {2, -6, 12}, true, 0);
  nrrd("nrrd scanner", "space: scanner-xyz\n" + directions, start, end, true, 1);
  nrrd("nrrd space dimension", "space dimension: 3\n" + directions, start, end, true, 1);
  nrrd("nrrd RAS with time",
       "space: RAST\nspace directions: (1,0,0,0) (0,2,0,0) (0,0,3,0)\nspace origin: (1,2,3,9)\n", {-1, -2, 3},
       {-2, -6, 12}, true, 0);
  nrrd("nrrd cm", "space: LPS\nspace units: \"cm\" \"cm\" \"cm\"\n" + directions, {10, 20, 30}, {20, 60, 120},
       true, 1);
  nrrd("nrrd no origin", "space: LPS\nspace directions: (1,0,0) (0,2,0) (0,0,3)\n", {0, 0, 0}, {1, 4, 9},
       true, 1);
  nrrd("nrrd spacings", "spacings: 1 2 3\n", {0, 0, 0}, {1, 4, 9}, true, 1);
  nrrd("nrrd cells between mins and maxs",
       "axis mins: 0 0 0\naxis maxs: 2 6 12\ncenterings: cell cell cell\n", {0.5, 1, 1.5}, {1.5, 5, 10.5},
       true, 1);
  nrrd("nrrd nodes between mins and maxs",
       "axis mins: 1 2 3\naxis maxs: 2 6 12\ncenterings: node node node\n", start, end, true, 1);
  nrrd("nrrd one spacing not known", "spacings: 1 2 nan\n", {0, 0, 0}, {1, 2, 3}, false, 1);
  nrrd("nrrd nothing", "", {0, 0, 0}, {1, 2, 3}, false, 1);

  const QByteArray meta = "NDims = 3\nDimSize = 2 3 4\nElementType = MET_UCHAR\n";
  const auto mha = [&](const char* title, const QByteArray& fields, QList<double> origin, QList<double> far,
                       bool calibrated, int warnings) {
    QTest::newRow(title) << QStringLiteral("g.mha")
                         << meta + fields + "ElementDataFile = LOCAL\n" + counted(0, 24) << origin << far
                         << calibrated << warnings;
  };
  const QByteArray whole = "ElementSpacing = 1 2 3\nOffset = 1 2 3\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n";
  mha("meta", whole, start, end, true, 0);
  mha("meta, other names", "ElementSize = 1 2 3\nPosition = 1 2 3\nOrientation = 1 0 0 0 1 0 0 0 1\n", start,
      end, true, 0);
  mha("meta, rows are axes", "ElementSpacing = 1 2 3\nTransformMatrix = 0 1 0 0 0 1 1 0 0\n", {0, 0, 0},
      {9, 1, 4}, true, 0);
  mha("meta, no matrix", "ElementSpacing = 1 2 3\n", {0, 0, 0}, {1, 4, 9}, true, 1);
  mha("meta, um",
      "DistanceUnits = um\nElementSpacing = 1000 2000 3000\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n", {0, 0, 0},
      {1, 4, 9}, true, 1);
  mha("meta, orientation not known", whole + "AnatomicalOrientation = ???\n", start, end, true, 1);
  mha("meta, orientation known", whole + "AnatomicalOrientation = RAI\n", start, end, true, 0);
  mha("meta, no spacing", "", {0, 0, 0}, {1, 2, 3}, false, 1);

  // Voxel (1, 2, 3) is at RAS (10 - 4, 20 + 1, 30 + 9): i runs along +y, j along -x.
  QTest::newRow("nifti qform") << QStringLiteral("q.nii") << niftiOfQform(1, 2) << QList<double>{-10, -20, 30}
                               << QList<double>{-6, -21, 39} << true << 0;
  QTest::newRow("nifti qform, qfac -1")
      << QStringLiteral("q.nii") << niftiOfQform(-1, 2) << QList<double>{-10, -20, 30}
      << QList<double>{-6, -21, 21} << true << 0;
  QTest::newRow("nifti um") << QStringLiteral("q.nii") << niftiOfQform(1, 3)
                            << QList<double>{-0.01, -0.02, 0.03} << QList<double>{-0.006, -0.021, 0.039}
                            << true << 1;
  QByteArray bare = niftiOfQform(1, 2, 0);
  put<std::int16_t>(bare, 252, 0);
  QTest::newRow("nifti without spacing")
      << QStringLiteral("q.nii") << bare << QList<double>{0, 0, 0} << QList<double>{1, 2, 3} << false << 1;
}

void TestFilesFormats::geometryIsTurnedToLps() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  QFETCH(QList<double>, origin);
  QFETCH(QList<double>, far);
  QFETCH(bool, calibrated);
  QFETCH(int, warnings);
  const auto found = readImageFileHeaders(write(name, content));
  QVERIFY2(found.ok(), found.ok() ? "" : found.message().c_str());
  const VoxelGeometry& g = (*found)[0].acquired;
  QCOMPARE(g.calibrated, calibrated);
  // The bound allows for the digits in headers. NIfTI's are float32.
  constexpr double bound = 1e-5;
  QVERIFY(glm::length(g.origin - vectorOf(origin)) < bound);
  QVERIFY(glm::length(g.patientFromVoxel({1, 2, 3}) - vectorOf(far)) < bound);
  QCOMPARE(int((*found)[0].warnings.size()), warnings);
}

void TestFilesFormats::axesOfTimeAreVolumes_data() {
  QTest::addColumn<QByteArray>("axes");
  QTest::addColumn<int>("step");  // between samples of one volume
  QTest::newRow("last, by kind") << QByteArray("sizes: 2 2 2 3\nkinds: domain domain domain list\n") << 1;
  QTest::newRow("first, by kind") << QByteArray("sizes: 3 2 2 2\nkinds: time domain domain domain\n") << 3;
  QTest::newRow("last, by nothing") << QByteArray("sizes: 2 2 2 3\n") << 1;
  QTest::newRow("last, none")
      << QByteArray("sizes: 2 2 2 3\nspace: LPS\nspace directions: (1,0,0) (0,1,0) (0,0,1) none\n") << 1;
  QTest::newRow("first, with a direction of nothing")
      << QByteArray(
             "sizes: 3 2 2 2\nspace: LPS\nspace directions: (2e-303,2e-303,2e-303) (1,0,0) (0,1,0) (0,0,1)\n"
             "kinds: vector domain domain domain\n")
      << 3;
  QTest::newRow("first, by its direction in time")
      << QByteArray(
             "sizes: 3 2 2 2\nspace: LPST\nspace directions: (0,0,0,1) (1,0,0,0) (0,1,0,0) (0,0,1,0)\n")
      << 3;
}

void TestFilesFormats::axesOfTimeAreVolumes() {
  QFETCH(QByteArray, axes);
  QFETCH(int, step);
  const auto found =
      readImageFileHeaders(write(QStringLiteral("t.nrrd"), "NRRD0005\ntype: uchar\ndimension: 4\n" + axes +
                                                               "encoding: raw\n\n" + counted(0, 24)));
  QVERIFY2(found.ok(), found.ok() ? "" : found.message().c_str());
  QCOMPARE(found->size(), std::size_t(3));
  for (int v = 0; v < 3; ++v) {
    QCOMPARE((*found)[std::size_t(v)].id, "t.nrrd#" + std::to_string(v + 1));
    const auto loaded = loadImageFile((*found)[std::size_t(v)]);
    QVERIFY(loaded.ok());
    const int first = step == 1 ? 8 * v : v;
    for (int n = 0; n < 8; ++n) QCOMPARE(loaded->acquired->valueAt(std::size_t(n)), float(first + step * n));
  }
}

// Two folders hold files of the same name. The study numbers their volumes again, and each keeps its values.
void TestFilesFormats::filesOfOneNameKeepTheirVolumes() {
  const QByteArray header = "NRRD0005\ntype: uchar\ndimension: 4\nsizes: 1 1 1 3\nencoding: raw\n\n";
  QDir(folder_.path()).mkpath(QStringLiteral("twins/a"));
  QDir(folder_.path()).mkpath(QStringLiteral("twins/b"));
  write(QStringLiteral("twins/a/t.nrrd"), header + counted(10, 3));
  write(QStringLiteral("twins/b/t.nrrd"), header + counted(20, 3));
  const Result<Study> study = openStudy(folder_.filePath(QStringLiteral("twins")).toStdString());
  QVERIFY(study.ok());
  QCOMPARE(study->volumes.size(), std::size_t(6));
  std::set<std::string> ids;
  for (std::size_t n = 0; n < 6; ++n) {
    ids.insert(study->volumes[n].id);
    const auto loaded = loadSeries(study->volumes[n]);
    QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
    QCOMPARE(loaded->acquired->valueAt(0), float(n < 3 ? 10 + n : 17 + n));
  }
  QCOMPARE(ids.size(), std::size_t(6));
}

void TestFilesFormats::rescaleOfMetaImage() {
  const auto found = readImageFileHeaders(
      write(QStringLiteral("r.mha"),
            "NDims = 3\nDimSize = 2 1 1\nElementType = MET_UCHAR\nElementSpacing = 1 1 1\n"
            "ElementToIntensityFunctionSlope = 0.5\nElementToIntensityFunctionOffset = -3\n"
            "ElementDataFile = LOCAL\n" +
                counted(10, 2)));
  QVERIFY(found.ok());
  const auto loaded = loadImageFile((*found)[0]);
  QVERIFY(loaded.ok());
  QCOMPARE(loaded->acquired->valueAt(0), 2.0f);
  QCOMPARE(loaded->acquired->valueAt(1), 2.5f);
}

void TestFilesFormats::wideValuesAreRoundedAloud() {
  const QByteArray header =
      "NRRD0004\ntype: int\ndimension: 3\nsizes: 2 1 1\nspacings: 1 1 1\nencoding: text\n\n";
  const auto warningsOf = [&](const QByteArray& values) {
    const auto found = readImageFileHeaders(write(QStringLiteral("w.nrrd"), header + values));
    return loadImageFile((*found)[0])->warnings.size() - (*found)[0].warnings.size();
  };
  QCOMPARE(warningsOf("16777216 -16777216"), std::size_t(0));
  QCOMPARE(warningsOf("16777217 5"), std::size_t(1));
}

VOLUMEN_TEST(TestFilesFormats);
#include "tst_files_formats.moc"
