// Guards `volumen export --as series --deface`: real heads lose face and nose, their brain and all other
// voxels stay as they are, in a new valid series of the study that names its source images.
#include <QTemporaryDir>
#include <glm/geometric.hpp>
#include <set>

#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/unit/app/export_case.h"
#include "tests/unit/app/series_case.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr const char* mrOfHead = "mr-head-siemens-gap-175";

}  // namespace

class TestExportDefaced : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theFaceAloneIsAir_data() { heads(); }
  void theFaceAloneIsAir();
  void itIsValid_data() { heads(); }
  void itIsValid();
  void theSeriesIsNewInItsStudy();
  void othersAreRefused_data();
  void othersAreRefused();

 private:
  static void heads();
  Outcome exported(const QString& source, const QStringList& options, const QString& folder) const {
    return runProgram(QStringList{QStringLiteral("export"), source, QStringLiteral("-o"), folder} + options);
  }
  // Makes the series of a head once. Empty if that failed.
  QString defacedOf(const QString& source);

  QTemporaryDir folder_;
};

// Places in the patient were read off the slices.
void TestExportDefaced::heads() {
  QTest::addColumn<QString>("source");
  QTest::addColumn<glm::dvec3>("nose");   // its tip
  QTest::addColumn<glm::dvec3>("brain");  // a point amid it
  QTest::addColumn<double>("brainMm");    // radius of a ball of brain
  QTest::addColumn<float>("air");
  QTest::newRow("MR with a missing slice") << QString::fromLatin1(mrOfHead) << glm::dvec3(-7, -131, -30)
                                           << glm::dvec3(-4, -10, 45) << 55.0 << 0.0f;
  QTest::newRow("CT without the top of the head, without HU")
      << QStringLiteral("dicom-geometry/ct-head-slicer-93") << glm::dvec3(93, 19, 69)
      << glm::dvec3(99, 114, 130) << 50.0 << 0.0f;
  QTest::newRow("tilted CT without nose")
      << QStringLiteral("dicom-geometry/ct-ge-tilt-varspacing-28") << glm::dvec3(-19, -100, -2)
      << glm::dvec3(-4, 10, 60) << 50.0 << -1000.0f;
}

QString TestExportDefaced::defacedOf(const QString& source) {
  const QString folder = folder_.filePath(QFileInfo(source).fileName());
  if (QDir(folder).exists()) return folder;
  const Outcome a =
      exported(QString::fromStdString(dataPath(source.toStdString())),
               {QStringLiteral("--as"), QStringLiteral("series"), QStringLiteral("--deface")}, folder);
  if (a.status == 0) return folder;
  qWarning("%s", a.err.constData());
  return {};
}

void TestExportDefaced::theFaceAloneIsAir() {
  QFETCH(QString, source);
  QFETCH(glm::dvec3, nose);
  QFETCH(glm::dvec3, brain);
  QFETCH(double, brainMm);
  QFETCH(float, air);
  const std::string path = dataPath(source.toStdString());
  NEED_DATA(path);
  const QString folder = defacedOf(source);
  QVERIFY(!folder.isEmpty());
  const VolumePtr before = volumeAt(path), after = volumeAt(folder.toStdString());
  QVERIFY(after->size() == before->size());
  const VoxelGeometry& grid = before->geometry();
  for (const glm::ivec3 corner : {glm::ivec3(0), before->size() - 1})
    QVERIFY(glm::distance(after->geometry().patientFromVoxel(corner), grid.patientFromVoxel(corner)) < 1e-6);
  int changed = 0, ofNose = 0;
  std::size_t n = 0;
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i, ++n) {
        const glm::dvec3 p = grid.patientFromVoxel({i, j, k});
        const float value = after->valueAt(n);
        if (glm::distance(p, nose) < 12) {
          QCOMPARE(value, air);
          ++ofNose;
        }
        if (value == before->valueAt(n)) continue;
        ++changed;
        QCOMPARE(value, air);
        QVERIFY2(p.y < brain.y + 75, "behind the ears");
        QVERIFY2(glm::distance(p, brain) > brainMm, "in the brain");
      }
  QVERIFY(ofNose > 50);
  QVERIFY(changed > int(grid.voxelCount() / 50));
}

// dciodvfy finds no error that the source does not have. The tilted CT names its method of de-identification,
// but gives none.
void TestExportDefaced::itIsValid() {
  QFETCH(QString, source);
  NEED_DATA(dataPath(source.toStdString()));
  NEED_DCIODVFY();
  const QString folder = defacedOf(source);
  QVERIFY(!folder.isEmpty());
  QCOMPARE(newErrorsInMiddle(folder, QString::fromStdString(dataPath(source.toStdString()))), QStringList());
}

void TestExportDefaced::theSeriesIsNewInItsStudy() {
  const std::string path = dataPath(mrOfHead);
  NEED_DATA(path);
  const QString folder = defacedOf(QString::fromLatin1(mrOfHead));
  QVERIFY(!folder.isEmpty());
  const auto study = openStudy(path);
  QVERIFY(study);
  const Series& source = study->volumes[0];
  const std::set<std::string> known(source.sopInstanceUids.begin(), source.sopInstanceUids.end());
  std::set<std::string> instances, named;
  for (const QString& file : storedFilesIn(folder)) {
    StoredFile stored(file);
    QCOMPARE(stored.said(DCM_StudyInstanceUID), source.studyUid);
    QVERIFY(stored.said(DCM_SeriesInstanceUID) != source.seriesUid);
    QCOMPARE(stored.said(DCM_FrameOfReferenceUID), source.frameOfReferenceUid);
    QVERIFY(stored.said(DCM_ImageType).starts_with("DERIVED\\"));
    QCOMPARE(stored.said(DCM_RecognizableVisualFeatures), std::string("NO"));
    QCOMPARE(stored.said(DCM_SeriesDescription), "Without face: " + source.description);
    QVERIFY(stored.said(DCM_DerivationDescription).find("the face") != std::string::npos);
    instances.insert(stored.said(DCM_SOPInstanceUID));
    for (const std::string& uid : stored.sources()) named.insert(uid);
  }
  QCOMPARE(instances.size(), std::size_t(176));  // one of them interpolated
  for (const std::string& uid : instances) QVERIFY(!known.contains(uid));
  QCOMPARE(named, known);
}

void TestExportDefaced::othersAreRefused_data() {
  QTest::addColumn<QString>("source");
  QTest::addColumn<QString>("options");
  QTest::addColumn<int>("status");
  QTest::addColumn<QByteArray>("says");
  const auto row = [](const char* name, const QString& source, const char* options, int status,
                      const char* says) {
    QTest::newRow(name) << source << QString::fromLatin1(options) << status << QByteArray(says);
  };
  const auto data = [](const char* name) { return QString::fromStdString(dataPath(name)); };
  const QString head = QStringLiteral("phantom:ct-head:24");
  row("a chest", data("ct-chest-lidc0314-138"), "--as series --deface", 1,
      "shows no head with air around it");
  row("a phantom of a grid", data("mr-head-ge-mprage-130"), "--as series --deface", 1,
      "shows no head with air around it");
  row("PET", data("pet-ct/sts019-pet"), "--as series --deface", 1, "is neither CT nor MR");
  row("a thin slab", data("dicom-geometry/mr-enh-siemens-xa10"), "--as series --deface --series 1", 1,
      "is thinner than 30 mm");
  row("a plane", head, "--as series --deface --plane coronal", 2, "--deface");
  row("a spacing", head, "--as series --deface --spacing 2", 2, "--deface");
  row("another grid", head, "--as series --deface --onto phantom:ct-head:32", 2, "--deface");
  row("a size", head, "--as series --deface --size 64x64", 2, "--deface");
  row("a series without identity", head, "--as series --deface --deidentify", 2, "--deface goes with");
  row("nothing to write", head, "--deface", 2, "--as FORMAT");
  row("the same UIDs", head, "--deface --deidentify --keep uids", 2, "\"uids\"");
  row("another format", head, "--as seg --deface --segments a.nrrd", 2, "--deface goes with --as series");
}

void TestExportDefaced::othersAreRefused() {
  QFETCH(QString, source);
  QFETCH(QString, options);
  QFETCH(QByteArray, says);
  if (source.isEmpty()) QSKIP("the real test data (../shared/data or $VOLUMEN_DATA) are not here");
  const QTemporaryDir folder;
  const Outcome a = exported(source, options.split(QLatin1Char(' ')), folder.filePath(QStringLiteral("out")));
  QVERIFY2(a.err.contains(says), a.err);
  QTEST(a.status, "status");
  QVERIFY(QDir(folder.path()).isEmpty(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot));
}

VOLUMEN_TEST(TestExportDefaced);
#include "tst_export_defaced.moc"
