// Guards export.md: `volumen export --as series` writes a new series in the study of its source. Its slices
// are those that `volumen slice` makes of a stack of planes, at their positions.
#include <QDir>
#include <QTemporaryDir>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "io/load.h"
#include "io/open.h"
#include "io/study/choose.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/app/export_case.h"
#include "tests/unit/app/series_case.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr const char* ctOfChest = "ct-chest-lidc0314-138";
const glm::dvec3 toLeft(1, 0, 0), toBack(0, 1, 0), toHead(0, 0, 1);

std::set<int> someOf(int count) { return {0, count / 3, count / 2, count - 1}; }

}  // namespace

class TestExportSeries : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void slicesAreThoseOfTheirPlanes_data() { stacks(); }
  void slicesAreThoseOfTheirPlanes();
  void theyAreValid_data() { stacks(); }
  void theyAreValid();
  void axialSlicesAreTheSource_data();
  void axialSlicesAreTheSource();
  void suvStays();
  void theSeriesIsNewInItsStudy();
  void slicesNameTheirSources_data();
  void slicesNameTheirSources();
  void wrongInputIsRefused_data();
  void wrongInputIsRefused();
  void foldersThatCannotBeUsedAreRefused();
  void randomStacks_data();
  void randomStacks();

 private:
  static void stacks();
  Outcome exported(const QString& source, const QStringList& options, const QString& folder) const {
    return runProgram(QStringList{QStringLiteral("export"), source, QStringLiteral("--as"),
                                  QStringLiteral("series"), QStringLiteral("-o"), folder} +
                      options);
  }
  QString ofRow() const { return folder_.filePath(QString::fromUtf8(QTest::currentDataTag())); }
  // Exports with the options of a row, once for all tests. Returns the folder of the series; empty if that
  // failed.
  QString seriesOfRow(const QStringList& options);

  QTemporaryDir folder_;
};

void TestExportSeries::stacks() {
  QTest::addColumn<QString>("source");
  QTest::addColumn<QString>("options");
  QTest::addColumn<glm::dvec3>("right");
  QTest::addColumn<glm::dvec3>("down");
  const auto row = [](const char* name, const char* source, const char* options, glm::dvec3 right,
                      glm::dvec3 down) {
    QTest::newRow(name) << QString::fromLatin1(source) << QString::fromLatin1(options) << right << down;
  };
  row("CT, coronal", "dicom-geometry/ct-head-slicer-93", "--plane coronal --spacing 8", toLeft, -toHead);
  row("CT, sagittal slabs", ctOfChest, "--plane sagittal --slab 20 --mm-per-pixel 2", toBack, -toHead);
  row("CT, thin slabs apart", ctOfChest,
      "--plane coronal --slab 5 --spacing 40 --mm-per-pixel 3 --slab-mode min", toLeft, -toHead);
  row("tilted CT, axial", "dicom-geometry/ct-ge-tilt-varspacing-28", "--spacing 6 --mm-per-pixel 1", toLeft,
      toBack);
  row("MR, coronal means", "mr-head-ge-mprage-130", "--plane coronal --slab 12 --slab-mode mean", toLeft,
      -toHead);
  row("MR with a gap, axial and cubic", "mr-head-siemens-gap-175",
      "--spacing 15 --mm-per-pixel 2 --interpolation cubic", toLeft, toBack);
  row("PET, sagittal", "pet-ct/sts019-pet", "--plane sagittal --spacing 30", toBack, -toHead);
  row("multi-frame MR, oblique", "dicom-geometry/mr-enh-siemens-xa10",
      "--series 1 --right 0.8,0.6,0 --down 0,0,-1 --spacing 10 --average --mm-per-pixel 4", {0.8, 0.6, 0},
      -toHead);
}

QString TestExportSeries::seriesOfRow(const QStringList& options) {
  QFETCH(QString, source);
  const QString folder = ofRow();
  if (QDir(folder).exists()) return folder;
  const Outcome a = exported(QString::fromStdString(dataPath(source.toStdString())), options, folder);
  if (a.status == 0) return folder;
  qWarning("%s", a.err.constData());
  return {};
}

namespace {

double optionOf(const QStringList& options, const char* name, double otherwise) {
  const qsizetype at = options.indexOf(QLatin1String(name));
  return at < 0 ? otherwise : options[at + 1].toDouble();
}

}  // namespace

void TestExportSeries::slicesAreThoseOfTheirPlanes() {
  QFETCH(QString, source);
  QFETCH(QString, options);
  QFETCH(glm::dvec3, right);
  QFETCH(glm::dvec3, down);
  const std::string path = dataPath(source.toStdString());
  NEED_DATA(path);
  const QStringList words = options.split(QLatin1Char(' '));
  const QString folder = seriesOfRow(words);
  QVERIFY(!folder.isEmpty());
  const QStringList ofSeries = words.contains(QStringLiteral("--series")) ? words.mid(0, 2) : QStringList();
  const auto study = openStudy(path);
  QVERIFY(study);
  const auto chosen = chooseSeries(*study, ofSeries.isEmpty() ? "" : ofSeries[1].toStdString());
  QVERIFY(chosen);
  const auto loaded = loadSeries(study->volumes[*chosen]);
  QVERIFY(loaded);
  const VoxelGeometry& geometry = loaded->drawn->geometry();

  TwinPlane first = twinPlane(geometry, right, down);
  first.slabMm = optionOf(words, "--slab", 0);
  first.slab = options.contains(QLatin1String("mean")) ? TwinSlab::mean
               : options.contains(QLatin1String("min ")) || options.endsWith(QLatin1String("min"))
                   ? TwinSlab::min
                   : TwinSlab::max;
  first.interpolation =
      options.contains(QLatin1String("cubic")) ? TwinInterpolation::cubic : TwinInterpolation::linear;
  first.average = options.contains(QLatin1String("--average"));
  first.mmPerPixel = optionOf(words, "--mm-per-pixel", first.mmPerPixel);
  first.size = twinSize(geometry, first);
  const double slab = first.slabMm;
  const double step = slab > 0 ? slab : twinStep(geometry, glm::cross(right, down));
  const TwinStack stack = stackAcross(geometry, first, optionOf(words, "--spacing", step));
  const QString fault =
      stackFaults(folder, QString::fromStdString(path), ofSeries, stack, someOf(stack.count));
  QVERIFY2(fault.isEmpty(), qPrintable(fault));
}

// dciodvfy finds no error that the source does not have. The tilted CT declares that it was de-identified,
// but gives no method.
void TestExportSeries::theyAreValid() {
  QFETCH(QString, source);
  QFETCH(QString, options);
  NEED_DATA(dataPath(source.toStdString()));
  NEED_DCIODVFY();
  const QString folder = seriesOfRow(options.split(QLatin1Char(' ')));
  QVERIFY(!folder.isEmpty());
  QCOMPARE(newErrorsInMiddle(folder, QString::fromStdString(dataPath(source.toStdString()))), QStringList());
}

void TestExportSeries::axialSlicesAreTheSource_data() {
  QTest::addColumn<QString>("source");
  QTest::addColumn<bool>("isSquare");  // true if the default pixel size is the in-plane spacing
  QTest::newRow("CT") << QString::fromLatin1(ctOfChest) << true;
  QTest::newRow("CT of a head") << QStringLiteral("dicom-geometry/ct-head-slicer-93") << false;
  QTest::newRow("PET") << QStringLiteral("pet-ct/sts019-pet") << false;
}

void TestExportSeries::axialSlicesAreTheSource() {
  QFETCH(QString, source);
  QFETCH(bool, isSquare);
  const std::string path = dataPath(source.toStdString());
  NEED_DATA(path);
  const VolumePtr before = volumeAt(path);
  const QStringList options{QStringLiteral("--mm-per-pixel"), exactText(before->geometry().spacing().x)};
  const QString folder = ofRow();
  const Outcome a = exported(QString::fromStdString(path), isSquare ? QStringList() : options, folder);
  QVERIFY2(a.status == 0, a.err);
  QVERIFY2(!a.err.contains("rounded") && !a.err.contains("outside"), a.err);
  const VolumePtr after = volumeAt(folder.toStdString());
  QVERIFY(after->size() == before->size());
  for (const glm::ivec3 corner : {glm::ivec3(0), before->size() - 1})
    QVERIFY(glm::distance(after->geometry().patientFromVoxel(corner),
                          before->geometry().patientFromVoxel(corner)) < 1e-6);
  const std::size_t voxels = std::size_t(before->geometry().voxelCount());
  for (std::size_t n = 0; n < voxels; ++n)
    if (before->valueAt(n) != after->valueAt(n)) QCOMPARE(after->valueAt(n), before->valueAt(n));
}

void TestExportSeries::suvStays() {
  const std::string path = dataPath("pet-ct/sts019-pet");
  NEED_DATA(path);
  const QString folder = ofRow() + QStringLiteral("suv");
  const Outcome a = exported(QString::fromStdString(path),
                             {QStringLiteral("--plane"), QStringLiteral("coronal"),
                              QStringLiteral("--spacing"), QStringLiteral("20")},
                             folder);
  QVERIFY2(a.status == 0, a.err);
  const auto was = openStudy(path), is = openStudy(folder.toStdString());
  QVERIFY(was && is && is->volumes.size() == 1);
  QVERIFY(was->volumes[0].suv.bodyWeight);
  QVERIFY2(is->volumes[0].suv == was->volumes[0].suv, is->volumes[0].suv.why.c_str());
  QCOMPARE(is->volumes[0].unit, was->volumes[0].unit);
}

void TestExportSeries::theSeriesIsNewInItsStudy() {
  const std::string path = dataPath("pet-ct/sts019-ct");
  NEED_DATA(path);
  const QStringList options{QStringLiteral("--plane"),        QStringLiteral("coronal"),
                            QStringLiteral("--slab"),         QStringLiteral("50"),
                            QStringLiteral("--mm-per-pixel"), QStringLiteral("4")};
  StoredFile source(storedFilesIn(QString::fromStdString(path))[0]);
  std::set<std::string> instances, series;
  const QString first = folder_.filePath(QStringLiteral("new 1")),
                second = folder_.filePath(QStringLiteral("new 2"));
  std::size_t count = 0;
  for (const QString& folder : {first, second}) {
    const Outcome a = exported(QString::fromStdString(path), options, folder);
    QVERIFY2(a.status == 0, a.err);
    for (const QString& file : storedFilesIn(folder)) {
      StoredFile made(file);
      ++count;
      instances.insert(made.said(DCM_SOPInstanceUID));
      series.insert(made.said(DCM_SeriesInstanceUID));
      for (const DcmTagKey& tag : {DCM_PatientName, DCM_PatientID, DCM_StudyInstanceUID, DCM_StudyDate,
                                   DCM_AccessionNumber, DCM_FrameOfReferenceUID, DCM_SOPClassUID, DCM_KVP})
        QCOMPARE(made.said(tag), source.said(tag));
      QCOMPARE(made.said(DCM_SeriesDescription), std::string("Coronal, slabs of 50 mm (max)"));
      QCOMPARE(made.number(DCM_SeriesNumber, 0), source.number(DCM_SeriesNumber, 0) + 1);
      QCOMPARE(made.number(DCM_SliceThickness, 0), 50.0);
      const std::string type = made.said(DCM_ImageType), how = made.said(DCM_DerivationDescription);
      QVERIFY2(type.starts_with("DERIVED\\SECONDARY\\AXIAL") && type.ends_with("\\MAXIMUM"), type.c_str());
      QVERIFY2(how.starts_with("Coronal, slabs of 50 mm (max), resampled with linear interpolation"),
               how.c_str());
      QVERIFY(!made.file.getDataset()->tagExists(DCM_GantryDetectorTilt));
    }
  }
  QVERIFY(count > 4);
  QCOMPARE(instances.size(), count);
  QCOMPARE(series.size(), std::size_t(2));
  for (const std::set<std::string>* uids : {&instances, &series})
    for (const std::string& uid : *uids) QVERIFY(uid.starts_with("2.25."));
}

void TestExportSeries::slicesNameTheirSources_data() {
  QTest::addColumn<QString>("options");
  QTest::addColumn<int>("sources");  // number of source images of each slice
  QTest::newRow("a slice of the source") << QStringLiteral("--index 70") << 1;
  QTest::newRow("a slab of three") << QStringLiteral("--index 70 --slab 4.5") << 3;
  QTest::newRow("across all") << QStringLiteral("--plane sagittal --at 0") << 138;
}

// Slices of the chest are 2 mm apart. The samples of the slab reach 1.8 mm to either side, so they lie among
// three slices.
void TestExportSeries::slicesNameTheirSources() {
  QFETCH(QString, options);
  QFETCH(int, sources);
  const std::string path = dataPath(ctOfChest);
  NEED_DATA(path);
  const Outcome a = exported(QString::fromStdString(path), options.split(QLatin1Char(' ')), ofRow());
  QVERIFY2(a.status == 0, a.err);
  const QStringList files = storedFilesIn(ofRow());
  QCOMPARE(files.size(), 1);
  const std::vector<std::string> named = StoredFile(files[0]).sources();
  QCOMPARE(int(named.size()), sources);
  QCOMPARE(std::set<std::string>(named.begin(), named.end()).size(), named.size());
  const auto study = openStudy(path);
  QVERIFY(study);
  const std::vector<std::string>& known = study->volumes[0].sopInstanceUids;
  for (const std::string& uid : named) QVERIFY(std::ranges::find(known, uid) != known.end());
  if (sources < 138) QVERIFY(std::ranges::find(named, known[70]) != named.end());
}

void TestExportSeries::wrongInputIsRefused_data() {
  QTest::addColumn<QString>("source");
  QTest::addColumn<QString>("options");
  QTest::addColumn<int>("status");
  QTest::addColumn<QByteArray>("says");
  const QString head = QStringLiteral("phantom:ct-head:24");
  const auto row = [](const char* name, const QString& source, const char* options, int status,
                      const char* says) {
    QTest::newRow(name) << source << QString::fromLatin1(options) << status << QByteArray(says);
  };
  row("no spacing", head, "--spacing 0", 2, "--spacing");
  row("an unknown plane", head, "--plane diagonal", 2, "--plane");
  row("a place twice", head, "--at 1 --index 2", 2, "--at");
  row("one direction", head, "--right 1,0,0", 2, "--down");
  row("directions askew", head, "--right 1,0,0 --down 1,1,0", 2, "not at a right angle");
  row("half a place", head, "--centre 1,2", 2, "--centre: \"1,2\" is not 3 numbers");
  row("a mode without a slab", head, "--slab-mode min", 2, "--slab");
  row("a plane outside", head, "--plane coronal --at 9999", 1, "outside of the volume");
  row("an index across slices", head, "--plane coronal --index 3", 1, "not parallel to the slices");
  row("too many slices", head, "--spacing 0.001", 1, "more than 65535 slices");
  row("too many pixels", head, "--mm-per-pixel 0.001", 1, "cannot be drawn");
  row("too much memory", head, "--size 16000x16000 --spacing 0.1", 1, "memory");
  row("no mm", QStringLiteral("VOXELS"), "--plane coronal", 1, "is not calibrated");
  row("colour", QString::fromStdString(dataPath(clip)), "--plane coronal", 1, "volume");
}

void TestExportSeries::wrongInputIsRefused() {
  QFETCH(QString, source);
  QFETCH(QString, options);
  QFETCH(QByteArray, says);
  if (source.isEmpty()) QSKIP("the real test data (../shared/data or $VOLUMEN_DATA) are not here");
  const QTemporaryDir folder, voxels;
  if (source == QLatin1String("VOXELS")) {
    source = voxels.filePath(QStringLiteral("a.nrrd"));
    QFile file(source);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n\n" + QByteArray(64, 'a'));
  }
  const Outcome a = exported(source, options.split(QLatin1Char(' ')), folder.filePath(QStringLiteral("out")));
  QVERIFY2(a.err.contains(says), a.err);
  QTEST(a.status, "status");
  QVERIFY(QDir(folder.path()).isEmpty(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot));
}

// Root can write into read-only folders, but not below /proc.
void TestExportSeries::foldersThatCannotBeUsedAreRefused() {
  const QTemporaryDir folder;
  QFile file(folder.filePath(QStringLiteral("notes.txt")));
  QVERIFY(file.open(QIODevice::WriteOnly) && file.write("mine") == 4);
  file.close();
  const QString head = QStringLiteral("phantom:ct-head:24");
  const Outcome used = exported(head, {}, folder.path());
  QCOMPARE(used.status, 1);
  QVERIFY2(used.err.contains("is not an empty folder"), used.err);
  QCOMPARE(QDir(folder.path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot),
           QStringList{QStringLiteral("notes.txt")});
  const Outcome locked = exported(head, {}, QStringLiteral("/proc/coronal"));
  QCOMPARE(locked.status, 1);
  QVERIFY2(locked.err.contains("Cannot make the folder /proc/coronal"), locked.err);
}

void TestExportSeries::randomStacks_data() {
  QTest::addColumn<int>("seed");
  const Seeds seeds = seedsOf(6, 300);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed)
    QTest::newRow(qPrintable(QStringLiteral("seed %1").arg(seed))) << seed;
}

void TestExportSeries::randomStacks() {
  QFETCH(int, seed);
  Chance chance{std::uint64_t(seed)};
  const QString source = QStringLiteral("phantom:ct-head:32");
  const VolumePtr volume = volumeAt(source.toStdString());
  const glm::dvec3 right = glm::normalize(chance.vector() + 1e-3);
  const glm::dvec3 down = glm::normalize(glm::cross(glm::normalize(chance.vector() + 2e-3), right));
  TwinPlane first = twinPlane(volume->geometry(), right, down);
  first.mmPerPixel = chance.between(4, 12);
  first.size = twinSize(volume->geometry(), first);
  if (chance.oneIn(2)) first.slabMm = chance.between(1, 30);
  first.slab = TwinSlab(chance.below(3));
  first.interpolation = chance.oneIn(2) ? TwinInterpolation::linear : TwinInterpolation::cubic;
  const double distance = chance.between(15, 60);
  const TwinStack stack = stackAcross(volume->geometry(), first, distance);
  const auto vector = [](glm::dvec3 v) {
    return QStringLiteral("%1,%2,%3").arg(exactText(v.x), exactText(v.y), exactText(v.z));
  };
  const QTemporaryDir folder;
  const QString out = folder.filePath(QStringLiteral("out"));
  const Outcome a = exported(
      source,
      samplingOptions(stack.first) +
          QStringList{QStringLiteral("--right"), vector(right), QStringLiteral("--down"), vector(down),
                      QStringLiteral("--mm-per-pixel"), exactText(stack.first.mmPerPixel),
                      QStringLiteral("--spacing"), exactText(distance)},
      out);
  QVERIFY2(a.status == 0, a.err);
  QVERIFY2(a.err.contains("Pixels outside of the volume have"), a.err);
  std::set<int> all;
  for (int n = 0; n < stack.count; ++n) all.insert(n);
  const QString fault = stackFaults(out, source, {}, stack, all);
  QVERIFY2(fault.isEmpty(), qPrintable(fault));
}

VOLUMEN_TEST(TestExportSeries);
#include "tst_export_series.moc"
