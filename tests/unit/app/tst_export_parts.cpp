// Guards `volumen export --as series --remove-table`, `--segments` and `--without-segments`: these parts
// alone become air, on the slices as they are and before they are resampled or fused, in a new valid series
// of the study.
#include <QDir>
#include <QTemporaryDir>
#include <algorithm>
#include <glm/geometric.hpp>
#include <set>

#include "io/files/write_volume.h"
#include "io/open.h"
#include "tests/fixtures/ct_with_table.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/app/export_case.h"
#include "tests/unit/app/series_case.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr const char* ctWithTable = "ct-chest-lidc0314-138";
constexpr const char* mrWithSegments = "mr-head-ge-mprage-130";
constexpr float brightFrom = 300;

float lowestOf(const Volume& volume) {
  float lowest = volume.valueAt(0);
  for (std::size_t n = 0; n < std::size_t(volume.geometry().voxelCount()); ++n)
    lowest = std::min(lowest, volume.valueAt(n));
  return lowest;
}

// The pictures in a folder, in order.
QList<QByteArray> coloursIn(const QString& folder) {
  QList<QByteArray> all;
  for (const QString& path : storedFilesIn(folder)) {
    StoredFile stored(path);
    const Uint8* rgb = nullptr;
    unsigned long size = 0;
    if (stored.file.getDataset()->findAndGetUint8Array(DCM_PixelData, rgb, &size).good())
      all << QByteArray(reinterpret_cast<const char*>(rgb), qsizetype(size));
  }
  return all;
}

// The largest difference of two lists of pictures; 255 if they have different sizes.
int largestDifference(const QList<QByteArray>& a, const QList<QByteArray>& b) {
  if (a.size() != b.size()) return 255;
  int largest = 0;
  for (qsizetype k = 0; k < a.size(); ++k) {
    if (a[k].size() != b[k].size()) return 255;
    for (qsizetype n = 0; n < a[k].size(); ++n)
      largest = std::max(largest, std::abs(int(std::uint8_t(a[k][n])) - int(std::uint8_t(b[k][n]))));
  }
  return largest;
}

}  // namespace

class TestExportParts : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theTableBecomesAir();
  void whatIsInSegmentsStaysOrGoes_data();
  void whatIsInSegmentsStaysOrGoes();
  void partsGoBeforeSlicesAreResampled();
  void partsGoBeforeTheOtherGrid();
  void partsGoBeforeTheOverlay();
  void theSeriesIsNewInItsStudy_data();
  void theSeriesIsNewInItsStudy();
  void othersAreRefused_data();
  void othersAreRefused();

 private:
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  Outcome exported(const QString& source, const QString& options, const QString& folder) const {
    return runProgram(QStringList{QStringLiteral("export"), source, QStringLiteral("--as"),
                                  QStringLiteral("series"), QStringLiteral("-o"), folder} +
                      options.split(QLatin1Char(' '), Qt::SkipEmptyParts));
  }
  // Returns a file with the bright voxels of the MR as a segment, made once. Empty if that failed.
  QString bright() const {
    const QString file = at("bright.seg.nrrd");
    if (QFile::exists(file)) return file;
    const Outcome a = runProgram(QStringLiteral("segment %1 --range %2: -o %3")
                                     .arg(QString::fromStdString(dataPath(mrWithSegments)))
                                     .arg(brightFrom)
                                     .arg(file));
    return a.status == 0 ? file : QString();
  }

  QTemporaryDir folder_;
};

// The fixture knows the same patient without the table.
void TestExportParts::theTableBecomesAir() {
  const QString with = at("with.nrrd");
  QVERIFY(writeVolume(*CtWithTable::volume(true), with.toStdString()));
  const Outcome a = exported(with, QStringLiteral("--remove-table"), at("alone"));
  QVERIFY2(a.status == 0, a.err);
  QVERIFY2(a.err.contains("Air is in place of the table"), a.err);
  const VolumePtr made = volumeAt(at("alone").toStdString()), wanted = CtWithTable::volume(false);
  QVERIFY(made->geometry() == wanted->geometry());
  for (std::size_t n = 0; n < std::size_t(wanted->geometry().voxelCount()); ++n)
    if (made->valueAt(n) != wanted->valueAt(n)) QCOMPARE(made->valueAt(n), wanted->valueAt(n));
  StoredFile first(storedFilesIn(at("alone"))[0]);
  QVERIFY(first.said(DCM_DerivationDescription).find("with air in place of the table") != std::string::npos);
}

void TestExportParts::whatIsInSegmentsStaysOrGoes_data() {
  QTest::addColumn<QString>("option");
  QTest::addColumn<bool>("isBrightKept");
  QTest::newRow("the segments alone") << QString() << true;
  QTest::newRow("all but the segments") << QStringLiteral("--without-segments") << false;
}

// MR has no value of air: the lowest stands for it.
void TestExportParts::whatIsInSegmentsStaysOrGoes() {
  QFETCH(QString, option);
  QFETCH(bool, isBrightKept);
  const std::string path = dataPath(mrWithSegments);
  NEED_DATA(path);
  QVERIFY(!bright().isEmpty());
  const QTemporaryDir folder;
  const QString out = folder.filePath(QStringLiteral("out"));
  const Outcome a =
      exported(QString::fromStdString(path), QStringLiteral("--segments %1 %2").arg(bright(), option), out);
  QVERIFY2(a.status == 0, a.err);
  const VolumePtr before = volumeAt(path), after = volumeAt(out.toStdString());
  QVERIFY(after->size() == before->size());
  for (const glm::ivec3 corner : {glm::ivec3(0), before->size() - 1})
    QVERIFY(glm::distance(after->geometry().patientFromVoxel(corner),
                          before->geometry().patientFromVoxel(corner)) < 1e-6);
  const float air = lowestOf(*before);
  int kept = 0, taken = 0;
  for (std::size_t n = 0; n < std::size_t(before->geometry().voxelCount()); ++n) {
    const bool isKept = (before->valueAt(n) >= brightFrom) == isBrightKept;
    const float wanted = isKept ? before->valueAt(n) : air;
    if (after->valueAt(n) != wanted) QCOMPARE(after->valueAt(n), wanted);
    ++(isKept ? kept : taken);
  }
  QVERIFY(kept > 1000 && taken > 1000);
}

// Slices of what is left are those that `volumen slice` makes of the series written without resampling.
void TestExportParts::partsGoBeforeSlicesAreResampled() {
  const std::string path = dataPath(mrWithSegments);
  NEED_DATA(path);
  QVERIFY(!bright().isEmpty());
  const QString from = QString::fromStdString(path),
                parts = QStringLiteral("--without-segments --segments ") + bright();
  const Outcome a = exported(from, parts, at("left"));
  QVERIFY2(a.status == 0, a.err);
  const Outcome b = exported(from, parts + QStringLiteral(" --plane coronal --spacing 40"), at("coronal"));
  QVERIFY2(b.status == 0, b.err);
  const VoxelGeometry geometry = volumeAt(path)->geometry();
  TwinPlane first = twinPlane(geometry, {1, 0, 0}, {0, 0, -1});
  first.size = twinSize(geometry, first);
  const TwinStack stack = stackAcross(geometry, first, 40);
  const QString fault = stackFaults(at("coronal"), at("left"), {}, stack, {stack.count / 2});
  QVERIFY2(fault.isEmpty(), qPrintable(fault));
}

void TestExportParts::partsGoBeforeTheOtherGrid() {
  const QString with = at("table.nrrd");
  QVERIFY(writeVolume(*CtWithTable::volume(true), with.toStdString()));
  const Outcome a = exported(with, QStringLiteral("--remove-table --onto ") + with, at("onto"));
  QVERIFY2(a.status == 0, a.err);
  const VolumePtr made = volumeAt(at("onto").toStdString()), wanted = CtWithTable::volume(false);
  QVERIFY(made->geometry() == wanted->geometry());
  for (std::size_t n = 0; n < std::size_t(wanted->geometry().voxelCount()); ++n)
    if (made->valueAt(n) != wanted->valueAt(n)) QCOMPARE(made->valueAt(n), wanted->valueAt(n));
}

// What is left is fused like a series of its own, whose places are rounded in its files. The overlay stays
// whole.
void TestExportParts::partsGoBeforeTheOverlay() {
  const std::string path = dataPath(mrWithSegments);
  NEED_DATA(path);
  QVERIFY(!bright().isEmpty());
  const QTemporaryDir folder;
  const auto in = [&](const char* name) { return folder.filePath(QString::fromLatin1(name)); };
  const QString from = QString::fromStdString(path),
                parts = QStringLiteral("--without-segments --segments ") + bright(),
                fused = QStringLiteral(" --plane coronal --spacing 60 --window 300,600 --overlay ") + from;
  for (const auto& [source, options, name] :
       {std::tuple(from, parts, "left"), {from, parts + fused, "fused"}, {from, fused, "whole"}}) {
    const Outcome a = exported(source, options, in(name));
    QVERIFY2(a.status == 0, a.err);
  }
  const Outcome twice = exported(in("left"), fused, in("twice"));
  QVERIFY2(twice.status == 0, twice.err);
  const QList<QByteArray> made = coloursIn(in("fused"));
  QVERIFY(made.size() > 1);
  QVERIFY(largestDifference(made, coloursIn(in("twice"))) <= 3);
  QVERIFY(largestDifference(made, coloursIn(in("whole"))) > 30);
  StoredFile first(storedFilesIn(in("fused"))[0]);
  QVERIFY(first.said(DCM_SeriesDescription).starts_with("Without Range 300:"));
  const std::string how = first.said(DCM_DerivationDescription);
  QVERIFY2(how.find("with air in place of the segments Range 300:") != std::string::npos, how.c_str());
}

void TestExportParts::theSeriesIsNewInItsStudy_data() {
  QTest::addColumn<QString>("source");
  QTest::addColumn<QString>("options");  // BRIGHT stands for the segments
  QTest::addColumn<QString>("title");
  QTest::addColumn<QString>("parts");
  QTest::newRow("CT without its table")
      << QString::fromLatin1(ctWithTable) << QStringLiteral("--remove-table")
      << QStringLiteral("Without table")
      << QStringLiteral("the table and everything else outside of the patient;");
  QTest::newRow("the segments alone")
      << QString::fromLatin1(mrWithSegments) << QStringLiteral("--segments BRIGHT")
      << QStringLiteral("Range 300: alone")
      << QStringLiteral("everything outside of the segments Range 300:;");
  QTest::newRow("without the segments")
      << QString::fromLatin1(mrWithSegments) << QStringLiteral("--segments BRIGHT --without-segments")
      << QStringLiteral("Without Range 300:") << QStringLiteral("the segments Range 300:;");
}

void TestExportParts::theSeriesIsNewInItsStudy() {
  QFETCH(QString, source);
  QFETCH(QString, options);
  QFETCH(QString, title);
  QFETCH(QString, parts);
  const std::string path = dataPath(source.toStdString());
  NEED_DATA(path);
  options.replace(QLatin1String("BRIGHT"), bright());
  const QTemporaryDir folder;
  const QString out = folder.filePath(QStringLiteral("out"));
  const Outcome a = exported(QString::fromStdString(path), options, out);
  QVERIFY2(a.status == 0, a.err);
  const auto study = openStudy(path);
  QVERIFY(study);
  const Series& from = study->volumes[0];
  const std::set<std::string> known(from.sopInstanceUids.begin(), from.sopInstanceUids.end());
  std::set<std::string> named;
  const QStringList files = storedFilesIn(out);
  QCOMPARE(files.size(), qsizetype(known.size()));
  for (const QString& file : files) {
    StoredFile stored(file);
    QCOMPARE(stored.said(DCM_StudyInstanceUID), from.studyUid);
    QVERIFY(stored.said(DCM_SeriesInstanceUID) != from.seriesUid);
    QVERIFY(!known.contains(stored.said(DCM_SOPInstanceUID)));
    QVERIFY(stored.said(DCM_ImageType).starts_with("DERIVED\\"));
    QVERIFY(stored.said(DCM_SeriesDescription).starts_with(title.toStdString()));
    const std::string how = stored.said(DCM_DerivationDescription);
    QVERIFY2(how.find("with air in place of " + parts.toStdString()) != std::string::npos, how.c_str());
    QCOMPARE(stored.sources().size(), std::size_t(1));
    named.insert(stored.sources()[0]);
  }
  QCOMPARE(named, known);
  NEED_DCIODVFY();
  const std::string first = storedFilesIn(QString::fromStdString(path)).constFirst().toStdString();
  QCOMPARE(newErrors(files[files.size() / 2], first), QStringList());
}

void TestExportParts::othersAreRefused_data() {
  QTest::addColumn<QString>("source");
  QTest::addColumn<QString>("options");
  QTest::addColumn<int>("status");
  QTest::addColumn<QByteArray>("says");
  const auto row = [](const char* name, const char* source, const char* options, int status,
                      const char* says) {
    QTest::newRow(name) << QString::fromLatin1(source) << QString::fromLatin1(options) << status
                        << QByteArray(says);
  };
  const char* head = "phantom:ct-head:24";
  row("the table of no CT", "phantom:sphere:16", "--remove-table", 1, "not Hounsfield units");
  row("no segments to leave out", head, "--without-segments", 2, "requires --segments");
  row("segments that are not there", head, "--segments none.seg.nrrd", 1, "none.seg.nrrd");
  row("a face, too", head, "--remove-table --deface", 2, "--deface does not go with parts");
  row("empty segments", head, "--segments EMPTY", 1, "no voxel of the series lies in its segments");
}

void TestExportParts::othersAreRefused() {
  QFETCH(QString, source);
  QFETCH(QString, options);
  QFETCH(QByteArray, says);
  const QTemporaryDir folder, segments;
  if (options.contains(QLatin1String("EMPTY"))) {
    const QString file = segments.filePath(QStringLiteral("empty.seg.nrrd"));
    const Outcome a = runProgram(QStringLiteral("segment %1 --range 99998:99999 -o %2").arg(source, file));
    QVERIFY2(a.status == 0, a.err);
    options.replace(QLatin1String("EMPTY"), file);
  }
  const Outcome a = exported(source, options, folder.filePath(QStringLiteral("out")));
  QVERIFY2(a.err.contains(says), a.err);
  QTEST(a.status, "status");
  QVERIFY(QDir(folder.path()).isEmpty(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot));
}

VOLUMEN_TEST(TestExportParts);
#include "tst_export_parts.moc"
