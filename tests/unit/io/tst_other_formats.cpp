// Guards import.md: Analyze, MGH, GIPL, VTK and MRC are read by their definitions, and what these leave open
// is reported. Any mutation of their bytes gives a volume or a sentence.
#include <QFile>
#include <QTemporaryDir>
#include <limits>
#include <random>

#include "io/files/image_file.h"
#include "io/study/series.h"
#include "tests/unit/io/gzipped.h"
#include "tests/unit/io/other_formats.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestOtherFormats : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void isRead_data();
  void isRead();
  void bytesAreSignedOrNot_data();
  void bytesAreSignedOrNot();
  void directionsOfMgh();
  void aSectionWithoutThickness();
  void missingSpacingIsNotCalibrated_data();
  void missingSpacingIsNotCalibrated();
  void furtherAxesAreVolumes_data();
  void furtherAxesAreVolumes();
  void isRefused_data();
  void isRefused();
  void otherFormatsAreNamed_data();
  void otherFormatsAreNamed();
  void gzippedDicomIsNamed();
  void everyCutIsRefused_data();
  void everyCutIsRefused();
  void everyMutationEndsWell_data();
  void everyMutationEndsWell();

 private:
  std::string write(const QString& name, const QByteArray& content) const;
  // Write the file, with the .img of Analyze beside it, and load its first volume.
  Result<Loaded> load(const QString& name, const QByteArray& content) const;
  QTemporaryDir folder_;
};

std::string TestOtherFormats::write(const QString& name, const QByteArray& content) const {
  QFile file(folder_.filePath(name));
  file.remove();
  if (!file.open(QIODevice::WriteOnly)) qFatal("no temporary file");
  file.write(content);
  return file.fileName().toStdString();
}

Result<Loaded> TestOtherFormats::load(const QString& name, const QByteArray& content) const {
  if (name.endsWith(QLatin1String(".hdr"))) write(QStringLiteral("a.img"), samples());
  const auto found = readImageFileHeaders(write(name, content));
  if (!found) return found.error();
  return loadImageFile((*found)[0]);
}

void TestOtherFormats::isRead_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("content");
  QTest::addColumn<QByteArray>("format");
  QTest::addColumn<bool>("hasDirections");
  const auto row = [](const char* title, const char* name, const QByteArray& content, const char* format) {
    QTest::newRow(title) << QString::fromLatin1(name) << content << QByteArray(format) << (format[1] == 'G');
  };
  row("Analyze, big endian", "a.hdr", analyzeHeader(), "Analyze");
  row("MGH", "a.mgh", mgh(), "MGH");
  row("MGZ", "a.mgz", gzipped(mgh()), "MGH");
  row("GIPL", "a.gipl", gipl(), "GIPL");
  row("GIPL under another name", "a.bin", gipl(), "GIPL");
  row("GIPL in gzip", "a.gipl.gz", gzipped(gipl()), "GIPL");
  row("VTK", "a.vtk", vtk(), "VTK");
  row("VTK without a lookup table", "a.vtk", vtk("LOOKUP_TABLE default\n", ""), "VTK");
  row("VTK with an aspect ratio", "a.vtk", vtk("SPACING", "ASPECT_RATIO"), "VTK");
  row("VTK with a blank line", "a.vtk", vtk("BINARY", "\nBINARY"), "VTK");
  row("VTK in small letters", "a.vtk",
      vtk().replace("DIMENSIONS", "dimensions").replace("SCALARS", "scalars"), "VTK");
  row("VTK as text", "a.vtk", vtkText(), "VTK");
  row("VTK as text with more behind it", "a.vtk",
      vtkText() + "\nMETADATA\nINFORMATION 0\n\nSCALARS other short 1\nLOOKUP_TABLE default\n1 2 3\n", "VTK");
  row("MRC", "a.mrc", mrc(), "MRC");
  row("MRC, big endian", "a.map", mrc(true), "MRC");
  row("MRC with an extended header", "a.mrc",
      mrc(false, [](QByteArray& h) { put<std::int32_t>(h, 92, 100, false), h.append(100, '\7'); }), "MRC");
}

void TestOtherFormats::isRead() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  QFETCH(QByteArray, format);
  QFETCH(bool, hasDirections);
  if (name.endsWith(QLatin1String(".hdr"))) write(QStringLiteral("a.img"), samples());
  const auto found = readImageFileHeaders(write(name, content));
  QVERIFY2(found.ok(), found.ok() ? "" : found.message().c_str());
  QCOMPARE(found->size(), std::size_t(1));
  const Series& series = (*found)[0];
  QCOMPARE(QByteArray::fromStdString(series.format), format);
  QCOMPARE(series.acquired.size, glm::ivec3(4, 3, 2));
  const glm::dvec3 spacing = series.acquired.spacing();
  for (int a = 0; a < 3; ++a) QVERIFY(std::abs(spacing[a] - (a + 1)) < 1e-5);
  const bool warned = std::ranges::any_of(
      series.warnings, [](const Warning& w) { return w.kind == WarningKind::noDirections; });
  QCOMPARE(warned, !hasDirections);
  const auto loaded = loadImageFile(series);
  QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
  for (std::size_t n = 0; n < 24; ++n) QCOMPARE(loaded->acquired->valueAt(n), float(n + 1));
}

void TestOtherFormats::bytesAreSignedOrNot_data() {
  QTest::addColumn<QByteArray>("content");
  QTest::addColumn<float>("value");  // value of the byte 0xf0
  const auto bytes = [](const Change& change) {
    QByteArray file = mrc(false, change).left(1024);
    put<std::int32_t>(file, 12, 0, false);
    return file + QByteArray(24, char(0xf0));
  };
  const auto imod = [&](std::int32_t flags) {
    return bytes([flags](QByteArray& h) {
      put<std::int32_t>(h, 152, 1146047817, false), put<std::int32_t>(h, 156, flags, false);
    });
  };
  const auto range = [&](float least, float most) {
    return bytes([least, most](QByteArray& h) { put(h, 76, least, false), put(h, 80, most, false); });
  };
  QTest::newRow("MRC2014") << bytes({}) << -16.f;
  QTest::newRow("IMOD says signed") << imod(1) << -16.f;
  QTest::newRow("IMOD says unsigned") << imod(0) << 240.f;
  QTest::newRow("0 to 255") << range(0, 255) << 240.f;
  QTest::newRow("0 to 100") << range(0, 100) << -16.f;
  QTest::newRow("-16 to 127") << range(-16, 127) << -16.f;
  QTest::newRow("a largest value of no byte") << range(0, 1000) << -16.f;
}

void TestOtherFormats::bytesAreSignedOrNot() {
  QFETCH(QByteArray, content);
  QFETCH(float, value);
  const auto loaded = load(QStringLiteral("a.mrc"), content);
  QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
  QCOMPARE(loaded->acquired->valueAt(0), value);
}

void TestOtherFormats::directionsOfMgh() {
  const auto loaded = load(QStringLiteral("a.mgh"), mgh());
  QVERIFY(loaded.ok());
  const VoxelGeometry& g = loaded->acquired->geometry();
  // From RAS to LPS, x and y change their signs.
  QCOMPARE(g.patientFromVoxelStep[0], glm::dvec3(1, 0, 0));
  QCOMPARE(g.patientFromVoxelStep[1], glm::dvec3(0, 0, -2));
  QCOMPARE(g.patientFromVoxelStep[2], glm::dvec3(0, -3, 0));
  // Voxel (2, 1.5, 1), half of each size, is at the centre (10, 20, 30) RAS.
  QCOMPARE(g.patientFromVoxel(glm::dvec3(2, 1.5, 1)), glm::dvec3(-10, -20, 30));
}

// The file has one section without a thickness.
void TestOtherFormats::aSectionWithoutThickness() {
  const QByteArray file = mrc(false, [](QByteArray& h) {
                            put<std::int32_t>(h, 8, 1, false), put(h, 48, 0.f, false);
                          }).left(1024 + 24);
  const auto loaded = load(QStringLiteral("a.mrc"), file);
  QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
  const VoxelGeometry& g = loaded->acquired->geometry();
  QCOMPARE(g.size, glm::ivec3(4, 3, 1));
  QVERIFY(g.calibrated);
  QVERIFY(std::abs(g.spacing().x - 1) < 1e-5 && std::abs(g.spacing().y - 2) < 1e-5);
  QVERIFY(std::ranges::any_of(loaded->warnings, [](const Warning& w) {
    return w.sentence.find("unknown thickness") != std::string::npos;
  }));
}

void TestOtherFormats::missingSpacingIsNotCalibrated_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("content");
  QTest::newRow("Analyze") << QStringLiteral("a.hdr")
                           << analyzeHeader([](QByteArray& h) { put(h, 84, 0.f); });
  QTest::newRow("MGH") << QStringLiteral("a.mgh") << mgh([](QByteArray& h) { put<std::int16_t>(h, 28, 0); });
  QTest::newRow("GIPL") << QStringLiteral("a.gipl") << gipl([](QByteArray& h) { put(h, 10, 0.f); });
  QTest::newRow("VTK") << QStringLiteral("a.vtk") << vtk("SPACING 1 2 3\n", "");
  QTest::newRow("MRC") << QStringLiteral("a.mrc")
                       << mrc(false, [](QByteArray& h) { put(h, 48, 0.f, false); });
}

void TestOtherFormats::missingSpacingIsNotCalibrated() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  const auto loaded = load(name, content);
  QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
  QVERIFY(!loaded->acquired->geometry().calibrated);
  QVERIFY(std::ranges::any_of(loaded->warnings,
                              [](const Warning& w) { return w.kind == WarningKind::notCalibrated; }));
}

void TestOtherFormats::furtherAxesAreVolumes_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("content");
  QTest::addColumn<QStringList>("names");  // timePoint|label
  const QStringList times{QStringLiteral("1|"), QStringLiteral("2|")};
  QTest::newRow("MGH") << QStringLiteral("a.mgh")
                       << mgh([](QByteArray& h) { put<std::int32_t>(h, 16, 2); }) + samples() << times;
  QTest::newRow("GIPL") << QStringLiteral("a.gipl")
                        << gipl([](QByteArray& h) { put<std::uint16_t>(h, 6, 2); }) + samples() << times;
  QTest::newRow("MRC, a stack of volumes")
      << QStringLiteral("a.mrc")
      << mrc(false,
             [](QByteArray& h) { put<std::int32_t>(h, 8, 4, false), put<std::int32_t>(h, 88, 401, false); }) +
             samples(false)
      << times;
  QTest::newRow("VTK vectors") << QStringLiteral("a.vtk")
                               << vtk("SCALARS s short 1\nLOOKUP_TABLE default", "VECTORS v short") +
                                      samples() + samples()
                               << QStringList{QStringLiteral("|component x"), QStringLiteral("|component y"),
                                              QStringLiteral("|component z")};
}

void TestOtherFormats::furtherAxesAreVolumes() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  QFETCH(QStringList, names);
  const auto found = readImageFileHeaders(write(name, content));
  QVERIFY2(found.ok(), found.ok() ? "" : found.message().c_str());
  QStringList all;
  for (const Series& s : *found) {
    all << QString::fromStdString(s.timePoint + "|" + s.label);
    QCOMPARE(s.acquired.size, glm::ivec3(4, 3, 2));
  }
  QCOMPARE(all, names);
  QVERIFY(loadImageFile(found->back()).ok());
}

void TestOtherFormats::isRefused_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("content");
  QTest::addColumn<QByteArray>("says");
  const auto row = [](const char* title, const char* name, const QByteArray& content, const char* says) {
    QTest::newRow(title) << QString::fromLatin1(name) << content << QByteArray(says);
  };
  row("Analyze in colour", "a.hdr", analyzeHeader([](QByteArray& h) { put<std::int16_t>(h, 70, 128); }),
      "colour");
  row("Analyze of bits", "a.hdr", analyzeHeader([](QByteArray& h) { put<std::int16_t>(h, 70, 1); }),
      "type 1");
  row("Analyze with more than its .img", "a.hdr",
      analyzeHeader([](QByteArray& h) { put<std::int16_t>(h, 46, 3); }), "48 bytes, but");
  row("Analyze without an axis", "a.hdr", analyzeHeader([](QByteArray& h) { put<std::int16_t>(h, 46, 0); }),
      "axis of 0");
  row("MGH of another version", "a.mgh", mgh([](QByteArray& h) { put<std::int32_t>(h, 0, 2); }), "version 1");
  row("MGH of 2^31 columns", "a.mgh", mgh([](QByteArray& h) { put<std::int32_t>(h, 4, 0x7fffffff); }), "MiB");
  row("MGH of a negative size", "a.mgh", mgh([](QByteArray& h) { put<std::int32_t>(h, 8, -3); }),
      "axis of -3");
  row("MGH of another type", "a.mgh", mgh([](QByteArray& h) { put<std::int32_t>(h, 20, 6); }), "type 6");
  row("MGH of a direction without end", "a.mgh",
      mgh([](QByteArray& h) { put(h, 42, std::numeric_limits<float>::infinity()); }), "spacing or direction");
  row("GIPL without its number", "a.gipl", gipl([](QByteArray& h) { put(h, 252, 7u); }), "GIPL's number");
  row("GIPL of bits", "a.gipl", gipl([](QByteArray& h) { put<std::uint16_t>(h, 8, 1); }), "type 1");
  row("GIPL of 65535^3", "a.gipl", gipl([](QByteArray& h) {
        for (int n = 0; n < 3; ++n) put<std::uint16_t>(h, 2 * n, 65535);
      }),
      "MiB");
  row("VTK of points that are not enough", "a.vtk", vtk("POINT_DATA 24", "POINT_DATA 23"), "23, but its");
  row("VTK of cells", "a.vtk", vtk("POINT_DATA", "CELL_DATA"), "CELL_DATA");
  row("VTK of another grid", "a.vtk", vtk("STRUCTURED_POINTS", "POLYDATA"), "POLYDATA");
  row("VTK in colour", "a.vtk", vtk("SCALARS s short 1", "COLOR_SCALARS s 3"), "colour");
  row("VTK of bits", "a.vtk", vtk("short", "bit"), "'bit'");
  row("VTK of other text", "a.vtk", vtk("BINARY", "PLAIN"), "ASCII or BINARY");
  row("VTK with a field twice", "a.vtk", vtk("ORIGIN 0 10 20\n", "ORIGIN 0 0 0\nORIGIN 0 0 0\n"), "twice");
  row("MRC before 2000", "a.mrc", mrc(false, [](QByteArray& h) { h.replace(208, 3, "abc"); }), "2000");
  row("MRC of complex numbers", "a.mrc",
      mrc(false, [](QByteArray& h) { put<std::int32_t>(h, 12, 4, false); }), "complex");
  row("MRC of a negative extended header", "a.mrc",
      mrc(false, [](QByteArray& h) { put<std::int32_t>(h, 92, -1024, false); }), "-1024 bytes");
  row("MRC with an axis twice", "a.mrc",
      mrc(false, [](QByteArray& h) { put<std::int32_t>(h, 68, 1, false); }), "two axes");
}

void TestOtherFormats::isRefused() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  QFETCH(QByteArray, says);
  const auto loaded = load(name, content);
  QVERIFY2(!loaded.ok(), "was loaded");
  QVERIFY2(loaded.message().find(says.toStdString()) != std::string::npos, loaded.message().c_str());
  QVERIFY(loaded.message().ends_with("."));
}

void TestOtherFormats::otherFormatsAreNamed_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("begins");
  QTest::addColumn<QByteArray>("says");
  const auto row = [](const char* name, const QByteArray& begins, const char* says) {
    QTest::newRow(says) << QString::fromLatin1(name) << begins << QByteArray(says);
  };
  row("a.h5", "\x89HDF\r\n\x1a\n", "HDF5");
  row("a.mnc", "\x89HDF\r\n\x1a\n", "MINC 2");
  row("b.mnc", QByteArray("CDF\x01"), "MINC or netCDF");
  row("a.tif", QByteArray("II*\0", 4), "TIFF");
  row("2dseq", "1234", "Bruker ParaVision");
  row("a.par", "# === DATA DESCRIPTION FILE ===", "Philips PAR/REC");
  row("a.isq", "CTDATA-HEADER_V1", "Scanco ISQ");
  row("a.vti", "<VTKFile type=\"ImageData\">", "VTK XML");
}

void TestOtherFormats::otherFormatsAreNamed() {
  QFETCH(QString, name);
  QFETCH(QByteArray, begins);
  QFETCH(QByteArray, says);
  const std::string path = write(name, begins + QByteArray(400, '\0'));
  QVERIFY(looksLikeImageFile(path));
  const auto found = readImageFileHeaders(path);
  QVERIFY(!found.ok());
  QVERIFY2(found.message().find(says.toStdString() + " file, which volumen does not read; convert it to") !=
               std::string::npos,
           found.message().c_str());
}

void TestOtherFormats::gzippedDicomIsNamed() {
  QByteArray dicom(128, '\0');
  put<std::int32_t>(dicom, 0, 348, false);  // Siemens' preamble begins like a NIfTI header
  const std::string path = write(QStringLiteral("a.dcm.gz"), gzipped(dicom + "DICM" + QByteArray(600, '\0')));
  QVERIFY(looksLikeImageFile(path));
  const auto found = readImageFileHeaders(path);
  QVERIFY(!found.ok());
  QVERIFY2(found.message().ends_with("is a gzipped DICOM file, which volumen does not read; unpack it."),
           found.message().c_str());
}

void TestOtherFormats::everyCutIsRefused_data() {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("content");
  QTest::newRow("Analyze") << QStringLiteral("a.hdr") << analyzeHeader();
  QTest::newRow("MGH") << QStringLiteral("a.mgh") << mgh();
  QTest::newRow("MGZ") << QStringLiteral("a.mgz") << gzipped(mgh());
  QTest::newRow("GIPL") << QStringLiteral("a.gipl") << gipl();
  QTest::newRow("VTK") << QStringLiteral("a.vtk") << vtk();
  QTest::newRow("MRC") << QStringLiteral("a.mrc") << mrc();
}

void TestOtherFormats::everyCutIsRefused() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  for (qsizetype length = 0; length < content.size(); ++length)
    QVERIFY2(!load(name, content.left(length)).ok(), std::to_string(length).c_str());
}

void TestOtherFormats::everyMutationEndsWell_data() { everyCutIsRefused_data(); }

// Changes one to four bytes of the header. The file must load as something or be refused in a sentence.
void TestOtherFormats::everyMutationEndsWell() {
  QFETCH(QString, name);
  QFETCH(QByteArray, content);
  std::mt19937 random(20261124);
  const auto below = [&](qsizetype n) { return qsizetype(random() % std::uint32_t(n)); };
  constexpr std::uint8_t telling[] = {0, 1, 0x7f, 0x80, 0xff};
  int refused = 0;
  for (int n = 0; n < 500; ++n) {
    QByteArray spoiled = content;
    for (qsizetype changes = 1 + below(4); changes > 0; --changes)
      spoiled[below(content.size())] = char(n % 2 ? telling[below(5)] : below(256));
    const auto loaded = load(name, spoiled);
    if (!loaded) {
      QVERIFY(loaded.message().ends_with("."));
      ++refused;
    }
  }
  QVERIFY(refused > 0);
}

VOLUMEN_TEST(TestOtherFormats);
#include "tst_other_formats.moc"
