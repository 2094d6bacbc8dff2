// Guards export.md: `volumen export --as series --onto OTHER` writes the values of a series at the voxels of
// another one, in its frame of reference, as a new series in the study of the first.
#include <QDir>
#include <QTemporaryDir>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "io/files/write_volume.h"
#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/program.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/app/export_case.h"
#include "tests/unit/app/series_case.h"
#include "tests/unit/suite.h"
#include "ui/workspace/session_json.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// A value at voxel (i, j, k) that linear interpolation keeps between voxels.
double ramp(glm::dvec3 voxel) { return 100 + 3 * voxel.x + 5 * voxel.y + 7 * voxel.z; }

// A turn about an axis of no plane, and a shift (mm).
Rigid someMotion() {
  const glm::dvec3 x = glm::normalize(glm::dvec3(0.96, 0.2, -0.1)),
                   y = glm::normalize(glm::cross(glm::dvec3(0.1, 0.05, 1), x));
  return {{x, y, glm::cross(x, y)}, {4, -3, 2}};
}

}  // namespace

class TestExportOnto : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void itsOwnGridKeepsTheValues_data();
  void itsOwnGridKeepsTheValues();
  void aRampIsWhereTheOtherSeesIt_data();
  void aRampIsWhereTheOtherSeesIt();
  void theOtherGivesPlaceAlone_data();
  void theOtherGivesPlaceAlone();
  void registeredSeriesSayHow();
  void otherPatientsAreSaid();
  void wrongInputIsRefused_data();
  void wrongInputIsRefused();

 private:
  QString at(const QString& name) const { return folder_.filePath(name); }
  Outcome exported(const QString& source, const QString& options, const QString& folder) const {
    return runProgram(QStringList{QStringLiteral("export"), source, QStringLiteral("--as"),
                                  QStringLiteral("series"), QStringLiteral("-o"), folder} +
                      options.split(QLatin1Char(' '), Qt::SkipEmptyParts));
  }
  // Writes a volume as a DICOM series in a frame of reference of its own, and returns its folder.
  QString asDicom(const VolumePtr& volume, const QString& name) const;
  // Writes a session that links the frames of reference of two series.
  QString linked(const QString& from, const QString& to, const Rigid& toFromFrom, bool registered) const;

  QTemporaryDir folder_;
};

QString TestExportOnto::asDicom(const VolumePtr& volume, const QString& name) const {
  if (QDir(at(name)).exists()) return at(name);
  const QString file = at(name + QStringLiteral(".nrrd"));
  if (!writeVolume(*volume, file.toStdString())) return {};
  const Outcome a =
      runProgram({QStringLiteral("convert"), file, QStringLiteral("-o"), at(name) + QLatin1Char('/')});
  if (a.status != 0) qWarning("%s", a.err.constData());
  return at(name);
}

QString TestExportOnto::linked(const QString& from, const QString& to, const Rigid& toFromFrom,
                               bool registered) const {
  const auto frame = [](const QString& path) {
    return openStudy(path.toStdString())->volumes.at(0).frameOfReferenceUid;
  };
  Workspace workspace;
  workspace.frameLinks.push_back({frame(from), frame(to), toFromFrom, registered});
  const auto text = sessionToJson(workspace, folder_.path().toStdString());
  QFile file(at(QStringLiteral("linked.volumen")));
  if (!text || !file.open(QIODevice::WriteOnly) || file.write(QByteArray::fromStdString(*text)) < 0)
    return {};
  return file.fileName();
}

void TestExportOnto::itsOwnGridKeepsTheValues_data() {
  QTest::addColumn<QString>("source");
  QTest::addColumn<QString>("interpolation");
  const auto row = [](const char* name, const char* source, const char* interpolation) {
    QTest::newRow(name) << QString::fromLatin1(source) << QString::fromLatin1(interpolation);
  };
  row("CT, linear", "ct-chest-lidc0314-138", "linear");
  row("oblique MR, cubic", "mr-head-ge-mprage-130", "cubic");
  row("oblique MR, nearest", "mr-head-ge-mprage-130", "nearest");
  row("PET, a rescale each slice", "pet-ct/sts019-pet", "linear");
}

void TestExportOnto::itsOwnGridKeepsTheValues() {
  QFETCH(QString, source);
  QFETCH(QString, interpolation);
  const std::string path = dataPath(source.toStdString());
  NEED_DATA(path);
  const QTemporaryDir folder;
  const QString out = folder.filePath(QStringLiteral("out")), from = QString::fromStdString(path);
  const Outcome a =
      exported(from, QStringLiteral("--onto %1 --interpolation %2").arg(from, interpolation), out);
  QVERIFY2(a.status == 0, a.err);
  QVERIFY2(!a.err.contains("rounded") && !a.err.contains("outside"), a.err);
  const VolumePtr before = volumeAt(path), after = volumeAt(out.toStdString());
  QVERIFY(after->size() == before->size());
  for (const glm::ivec3 corner : {glm::ivec3(0), before->size() - 1})
    QVERIFY(glm::distance(after->geometry().patientFromVoxel(corner),
                          before->geometry().patientFromVoxel(corner)) < 1e-6);
  const std::size_t voxels = std::size_t(before->geometry().voxelCount());
  for (std::size_t n = 0; n < voxels; ++n)
    if (before->valueAt(n) != after->valueAt(n)) QCOMPARE(after->valueAt(n), before->valueAt(n));
  StoredFile made(storedFilesIn(out)[0]);
  const auto study = openStudy(path);
  QVERIFY(study && study->volumes.size() == 1);
  QCOMPARE(made.said(DCM_FrameOfReferenceUID), study->volumes[0].frameOfReferenceUid);
  QVERIFY(made.said(DCM_SeriesInstanceUID) != study->volumes[0].seriesUid);
}

void TestExportOnto::aRampIsWhereTheOtherSeesIt_data() {
  QTest::addColumn<bool>("byHand");
  QTest::addColumn<bool>("isBackwards");  // the session links them the other way round
  QTest::addColumn<QByteArray>("says");
  QTest::newRow("registered") << false << false << QByteArray("placed by a registration");
  QTest::newRow("by hand, linked backwards") << true << true << QByteArray("placed by hand");
}

// Both grids are oblique, that of the other has pixels that are not square, and a slice outside of the ramp.
void TestExportOnto::aRampIsWhereTheOtherSeesIt() {
  QFETCH(bool, byHand);
  QFETCH(bool, isBackwards);
  QFETCH(QByteArray, says);
  const VolumePtr source =
      volumeOf<std::int16_t>({24, 20, 16}, {1.6, 1.2, 0, -0.96, 1.28, 1.2, 1.44, -1.92, 3.2}, ramp);
  const VolumePtr other =
      volumeOf<std::int16_t>({19, 17, 30}, {1.5, 0, 0, 0, 2.5, 0, 0, 0, 4}, [](glm::dvec3) { return 0; });
  const QString ofSource = asDicom(source, QStringLiteral("source") + QString::number(byHand)),
                ofOther = asDicom(other, QStringLiteral("other") + QString::number(byHand));
  const Rigid motion = someMotion();
  const QString session = isBackwards ? linked(ofSource, ofOther, motion.inverse(), !byHand)
                                      : linked(ofOther, ofSource, motion, !byHand);
  const QString out = at(QStringLiteral("ramp") + QString::number(byHand));
  const Outcome a =
      exported(ofSource, QStringLiteral("--onto %1 --registration %2").arg(ofOther, session), out);
  QVERIFY2(a.status == 0, a.err);
  QVERIFY2(a.err.contains("Pixels outside of the volume have the lowest value"), a.err);
  const QStringList files = storedFilesIn(out);
  QCOMPARE(files.size(), 30);
  StoredFile ofOtherFile(storedFilesIn(ofOther)[0]), middle(files[15]);
  QCOMPARE(middle.said(DCM_FrameOfReferenceUID), ofOtherFile.said(DCM_FrameOfReferenceUID));
  QVERIFY(QByteArray::fromStdString(middle.said(DCM_DerivationDescription)).contains(says));

  const double off = 0.51 * middle.number(DCM_RescaleSlope, 1) + 1e-4;
  const glm::dvec3 last = glm::dvec3(source->size()) - 1.0;
  int inside = 0, outside = 0;
  for (int k = 0; k < 30; ++k) {
    const std::vector<double> values = StoredFile(files[k]).values();
    for (int j = 0; j < 17; ++j)
      for (int i = 0; i < 19; ++i) {
        const glm::dvec3 voxel =
            source->geometry().voxelFromPatient(motion(other->geometry().patientFromVoxel({i, j, k})));
        const double value = values[std::size_t(j) * 19 + std::size_t(i)];
        const glm::dvec3 nearest = glm::clamp(voxel, glm::dvec3(0), last);
        if (nearest == voxel) {
          ++inside;
          if (std::abs(value - ramp(voxel)) > off) QCOMPARE(value, ramp(voxel));
        }
        if (glm::any(glm::greaterThan(glm::abs(nearest - voxel), glm::dvec3(0.51)))) {
          ++outside;
          QVERIFY2(value >= 100 - off && value < ramp(last), qPrintable(QString::number(value)));
        }
      }
  }
  QVERIFY(inside > 500 && outside > 500);
}

void TestExportOnto::theOtherGivesPlaceAlone_data() {
  QTest::addColumn<QString>("source");
  QTest::addColumn<QString>("other");
  QTest::newRow("PET on CT") << QStringLiteral("pet-ct/sts019-pet") << QStringLiteral("pet-ct/sts019-ct");
  QTest::newRow("CT on PET") << QStringLiteral("pet-ct/sts019-ct") << QStringLiteral("pet-ct/sts019-pet");
}

void TestExportOnto::theOtherGivesPlaceAlone() {
  QFETCH(QString, source);
  QFETCH(QString, other);
  const std::string from = dataPath(source.toStdString()), to = dataPath(other.toStdString());
  NEED_DATA(from);
  const QTemporaryDir folder;
  const QString out = folder.filePath(QStringLiteral("out"));
  const Outcome a =
      exported(QString::fromStdString(from), QStringLiteral("--onto ") + QString::fromStdString(to), out);
  QVERIFY2(a.status == 0, a.err);
  const VolumePtr grid = volumeAt(to), made = volumeAt(out.toStdString());
  QVERIFY(made->size() == grid->size());
  for (const glm::ivec3 corner : {glm::ivec3(0), grid->size() - 1})
    QVERIFY(glm::distance(made->geometry().patientFromVoxel(corner),
                          grid->geometry().patientFromVoxel(corner)) < 1e-6);
  const QStringList files = storedFilesIn(out);
  const QString firstFile = storedFilesIn(QString::fromStdString(from))[0];
  StoredFile middle(files[files.size() / 2]), first(firstFile),
      placed(storedFilesIn(QString::fromStdString(to))[0]);
  for (const DcmTagKey& tag :
       {DCM_PatientName, DCM_PatientID, DCM_StudyInstanceUID, DCM_Modality, DCM_SOPClassUID, DCM_Units})
    QCOMPARE(middle.said(tag), first.said(tag));
  for (const DcmTagKey& tag : {DCM_FrameOfReferenceUID, DCM_Rows, DCM_Columns})
    QCOMPARE(middle.said(tag), placed.said(tag));
  const std::string type = middle.said(DCM_ImageType);
  QVERIFY2(type.starts_with("DERIVED\\") && type.ends_with("RESAMPLED"), type.c_str());
  QVERIFY(middle.said(DCM_DerivationDescription).starts_with("On the grid of "));
  QCOMPARE(middle.number(DCM_SliceThickness, 0), glm::length(grid->geometry().patientFromVoxelStep[2]));
  const auto study = openStudy(from);
  QVERIFY(study);
  const std::vector<std::string>& known = study->volumes.at(0).sopInstanceUids;
  const std::vector<std::string> named = middle.sources();
  QVERIFY(!named.empty() && named.size() <= 2);
  for (const std::string& uid : named) QVERIFY(std::ranges::find(known, uid) != known.end());
  NEED_DCIODVFY();
  QCOMPARE(newErrors(files[files.size() / 2], firstFile.toStdString()), QStringList());
}

// A head and a copy of it lie on each other, within a fifth of a voxel (5 mm).
void TestExportOnto::registeredSeriesSayHow() {
  const QString head = QStringLiteral("phantom:ct-head:48"), copy = at(QStringLiteral("head")),
                out = at(QStringLiteral("registered"));
  const Outcome converted =
      runProgram({QStringLiteral("convert"), head, QStringLiteral("-o"), copy + QLatin1Char('/')});
  QVERIFY2(converted.status == 0, converted.err);
  const Outcome a = exported(head, QStringLiteral("--register --onto ") + copy, out);
  QVERIFY2(a.status == 0, a.err);
  StoredFile made(storedFilesIn(out)[0]), other(storedFilesIn(copy)[0]);
  QCOMPARE(made.said(DCM_FrameOfReferenceUID), other.said(DCM_FrameOfReferenceUID));
  const QString how = QString::fromStdString(made.said(DCM_DerivationDescription));
  const QString before =
      QStringLiteral("registered rigidly by mutual information (from mm of the slices to mm of the series put on them: ");
  const qsizetype begin = how.indexOf(before);
  QVERIFY2(begin > 0, qPrintable(how));
  const QStringList matrix =
      how.mid(begin + before.size()).section(QLatin1Char(')'), 0, 0).split(QLatin1Char(' '));
  QCOMPARE(matrix.size(), 12);
  for (int n = 0; n < 12; ++n) {
    const double wanted = n % 5 == 0 && n < 11 ? 1 : 0;
    QVERIFY2(std::abs(matrix[n].toDouble() - wanted) < (n % 4 == 3 ? 1 : 0.01), qPrintable(matrix[n]));
  }
}

void TestExportOnto::otherPatientsAreSaid() {
  const QString from = QString::fromStdString(dataPath("pet-ct/sts019-pet")),
                to = QString::fromStdString(dataPath("mr-head-siemens-gap-175"));
  NEED_DATA(from.toStdString());
  const auto centre = [](const QString& path) { return volumeAt(path.toStdString())->geometry().centre(); };
  const QString session = linked(to, from, {glm::dmat3(1), centre(from) - centre(to)}, false);
  const Outcome a = exported(from, QStringLiteral("--onto %1 --registration %2").arg(to, session),
                             at(QStringLiteral("patients")));
  QVERIFY2(a.status == 0, a.err);
  QVERIFY2(a.err.contains("are of different patients ("), a.err);
}

void TestExportOnto::wrongInputIsRefused_data() {
  QTest::addColumn<QString>("options");
  QTest::addColumn<int>("status");
  QTest::addColumn<QByteArray>("says");
  const auto row = [](const char* name, const char* options, int status, const char* says) {
    QTest::newRow(name) << QString::fromLatin1(options) << status << QByteArray(says);
  };
  row("two frames of reference", "--onto OTHER", 1, "are in different frames of reference");
  row("a session that does not link them", "--onto OTHER --registration EMPTY", 1,
      "does not link the frames");
  row("no session", "--onto OTHER --registration OTHER", 1, "other");
  row("a missing path", "--onto nowhere", 1, "nowhere");
  row("a missing series", "--onto-series 7", 1, "7");
  row("a plane", "--onto OTHER --plane coronal", 2, "--plane does not go with --onto");
  row("a distance", "--onto OTHER --spacing 3", 2, "--spacing does not go with --onto");
  row("registered with nothing", "--register", 2, "--register goes with --onto");
  row("two registrations", "--onto OTHER --register --registration EMPTY", 2, "--register");
}

void TestExportOnto::wrongInputIsRefused() {
  QFETCH(QString, options);
  QFETCH(QByteArray, says);
  const auto box = [](double mm) { return volumeOf<std::int16_t>({8, 8, 8}, glm::dmat3(mm), ramp); };
  const QString source = asDicom(box(1), QStringLiteral("box")),
                other = asDicom(box(2), QStringLiteral("other"));
  const QString empty = at(QStringLiteral("empty.volumen"));
  QFile file(empty);
  const auto text = sessionToJson({}, folder_.path().toStdString());
  QVERIFY(text && file.open(QIODevice::WriteOnly) && file.write(QByteArray::fromStdString(*text)) > 0);
  file.close();
  options.replace(QLatin1String("OTHER"), other).replace(QLatin1String("EMPTY"), empty);
  const QTemporaryDir folder;
  const Outcome a = exported(source, options, folder.filePath(QStringLiteral("out")));
  QVERIFY2(a.err.contains(says), a.err);
  QTEST(a.status, "status");
  QVERIFY(QDir(folder.path()).isEmpty(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot));
}

VOLUMEN_TEST(TestExportOnto);
#include "tst_export_onto.moc"
