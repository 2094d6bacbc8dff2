// Guards design.md 4 (convert to DICOM: values and geometry exact, no half-written study) and design.md 10
// (ct-head as the sample study).
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <glm/geometric.hpp>
#include <set>

#include "io/export/dicom_series.h"
#include "io/load.h"
#include "io/open.h"
#include "tests/fixtures/head_facts.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"
#include "viewer/phantoms/phantoms.h"

using namespace volumen;

class TestExportDicom : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void headReadsBackAsWritten();
  void geometryAndValuesSurvive_data();
  void geometryAndValuesSurvive();
  void whatDicomCannotKeepIsRefused_data();
  void whatDicomCannotKeepIsRefused();
  void sameContentsGiveTheSameFiles();
  void allSlicesSayWhoseTheyAreAlike();
  void cancelledWritingLeavesNothing();
};

namespace {

VolumePtr made(VolumeParts parts) {
  std::vector<std::string> warnings;
  return *Volume::make(std::move(parts), warnings);
}

// Returns a small volume of distinct values with the given voxel steps.
VolumeParts smallParts(const glm::dmat3& steps) {
  VolumeParts parts;
  parts.geometry = {.size = {7, 5, 4}, .patientFromVoxelStep = steps, .origin = {-12.25, 1.0 / 3, 1234.5}};
  std::vector<std::int16_t> values;
  for (int n = 0; n < 7 * 5 * 4; ++n) values.push_back(std::int16_t(n * 31 - 2000));
  parts.values = values;
  parts.attributes.name = "small";
  parts.attributes.modality = "CT";
  return parts;
}

Result<Loaded> readBack(const std::string& folder) {
  const Result<Study> study = openStudy(folder);
  if (!study) return study.error();
  if (study->volumes.size() != 1 || !study->refused.empty()) return Error{"not one series."};
  return loadSeries(study->volumes[0]);
}

double largestDistance(const VoxelGeometry& a, const VoxelGeometry& b) {
  double largest = 0;
  const std::vector<glm::dvec3> left = a.boxCorners(), right = b.boxCorners();
  for (std::size_t n = 0; n < left.size(); ++n) largest = std::max(largest, glm::length(left[n] - right[n]));
  return largest;
}

QByteArray contents(const QString& folder) {
  QByteArray all;
  for (const QString& name : QDir(folder).entryList(QDir::Files, QDir::Name)) {
    QFile file(QDir(folder).filePath(name));
    if (file.open(QIODevice::ReadOnly)) all += name.toUtf8() + file.readAll();
  }
  return all;
}

}  // namespace

void TestExportDicom::headReadsBackAsWritten() {
  QTemporaryDir scratch;
  const std::string folder = scratch.filePath(QStringLiteral("head/")).toStdString();
  const Result<Study> phantom = openStudy("phantom:ct-head:64");
  QVERIFY(phantom.ok());
  const VolumePtr volume = *makePhantom("ct-head:64");
  const auto written = writeDicomSeries(*volume, dicomTags(phantom->volumes[0]), folder);
  QVERIFY2(written.ok(), written.ok() ? "" : written.message().c_str());

  const Result<Study> study = openStudy(folder);
  QVERIFY(study.ok());
  QCOMPARE(study->volumes.size(), std::size_t(1));
  QVERIFY(study->refused.empty());
  const Series& series = study->volumes[0];
  QCOMPARE(series.format, std::string("DICOM"));
  QCOMPARE(series.modality, std::string("CT"));
  QCOMPARE(series.patientName, std::string("Volumen^Sample"));
  QVERIFY(series.description.find("synthetic") != std::string::npos);
  QVERIFY(series.studyDescription.find("Synthetic") != std::string::npos);
  QVERIFY2(series.warnings.empty(), series.warnings.empty() ? "" : series.warnings[0].sentence.c_str());

  const Result<Loaded> loaded = loadSeries(series);
  QVERIFY(loaded.ok());
  QVERIFY(loaded->drawn == loaded->acquired);
  QVERIFY(loaded->acquired->stored() == volume->stored());
  QCOMPARE(loaded->acquired->slope(), 1.0);
  QVERIFY(largestDistance(loaded->acquired->geometry(), volume->geometry()) < 1e-9);
  QVERIFY(loaded->acquired->attributes().windows == volume->attributes().windows);
  for (const tests::HeadFact& fact : tests::headFacts) {
    const double value = tests::valueNear(*loaded->acquired, fact.pPatient);
    QVERIFY2(value >= fact.low && value <= fact.high, fact.what);
  }
}

void TestExportDicom::geometryAndValuesSurvive_data() {
  QTest::addColumn<int>("kind");
  QTest::newRow("anisotropic") << 0;
  QTest::newRow("sagittal slices") << 1;
  QTest::newRow("oblique") << 2;
  QTest::newRow("gantry tilt") << 3;
  QTest::newRow("uint8, no CT") << 4;
  QTest::newRow("uint16 with rescale") << 5;
  QTest::newRow("whole float32") << 6;
  QTest::newRow("MR") << 7;
}

void TestExportDicom::geometryAndValuesSurvive() {
  QFETCH(int, kind);
  const double c = std::cos(0.3), s = std::sin(0.3), third = 1.0 / 3;
  const glm::dmat3 anisotropic({0.7, 0, 0}, {0, third, 0}, {0, 0, 2.5});
  VolumeParts parts = smallParts(anisotropic);
  if (kind == 1) parts = smallParts(glm::dmat3({0, 0.7, 0}, {0, 0, -0.5}, {-1.1, 0, 0}));
  if (kind == 2)
    parts = smallParts(glm::dmat3({0.7 * c, 0.7 * s, 0}, {-s * c, c * c, -s}, {-s * s, c * s, c}));
  if (kind == 3) parts = smallParts(glm::dmat3({0.7, 0, 0}, {0, 0.7, 0}, {0, 0.5, 2}));
  if (kind == 4) {
    parts.values = std::vector<std::uint8_t>(140, 200);
    parts.attributes.modality = "";
  }
  if (kind == 5) {
    parts.values = std::vector<std::uint16_t>(140, 65535);
    parts.slope = 0.1;
    parts.intercept = -1024.5;
  }
  if (kind == 6) parts.values = std::vector<float>(140, -1234);
  if (kind == 7) parts.attributes.modality = "MR";
  const VolumePtr volume = made(parts);
  QTemporaryDir scratch;
  const std::string folder = scratch.filePath(QStringLiteral("series")).toStdString();
  const auto written = writeDicomSeries(*volume, {}, folder);
  QVERIFY2(written.ok(), written.ok() ? "" : written.message().c_str());
  const Result<Loaded> loaded = readBack(folder);
  QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
  const Volume& read = *loaded->acquired;
  QVERIFY(read.size() == volume->size());
  // Decimal strings of 16 characters hold 13 digits or more.
  QVERIFY(largestDistance(read.geometry(), volume->geometry()) < 1e-9);
  for (std::size_t n = 0; n < 140; ++n) QCOMPARE(read.valueAt(n), volume->valueAt(n));
}

void TestExportDicom::whatDicomCannotKeepIsRefused_data() {
  QTest::addColumn<QString>("what");
  QTest::addColumn<QString>("mustName");
  const auto row = [](const char* what, const char* mustName) {
    QTest::newRow(what) << QString::fromLatin1(what) << QString::fromLatin1(mustName);
  };
  row("sheared slices", "perpendicular");
  row("not calibrated", "calibrated");
  row("fractions", "whole");
  row("too large", "16 bits");
  row("folder in use", "not an empty folder");
  row("no parent", "Cannot make the folder");
}

void TestExportDicom::whatDicomCannotKeepIsRefused() {
  QFETCH(QString, what);
  QFETCH(QString, mustName);
  QTemporaryDir scratch;
  QString folder = scratch.filePath(QStringLiteral("series"));
  VolumeParts parts = smallParts(glm::dmat3(1));
  if (what == QLatin1String("sheared slices"))
    parts = smallParts(glm::dmat3({1, 0, 0}, {0.1, 1, 0}, {0, 0, 1}));
  if (what == QLatin1String("not calibrated")) parts.geometry.calibrated = false;
  if (what == QLatin1String("fractions")) parts.values = std::vector<float>(140, 0.5f);
  if (what == QLatin1String("too large")) parts.values = std::vector<float>(140, 40000);
  if (what == QLatin1String("folder in use")) QVERIFY(QDir().mkpath(folder + QStringLiteral("/old")));
  if (what == QLatin1String("no parent")) folder = scratch.filePath(QStringLiteral("no/such/series"));
  const QStringList before = QDir(scratch.path()).entryList(QDir::AllEntries | QDir::Hidden);
  const auto status = writeDicomSeries(*made(parts), {}, folder.toStdString());
  QVERIFY(!status.ok());
  QVERIFY2(status.message().find(mustName.toStdString()) != std::string::npos, status.message().c_str());
  QVERIFY(status.message().ends_with("."));
  QCOMPARE(QDir(scratch.path()).entryList(QDir::AllEntries | QDir::Hidden), before);
}

void TestExportDicom::sameContentsGiveTheSameFiles() {
  QTemporaryDir scratch;
  const QString a = scratch.filePath(QStringLiteral("slice.dcm")),
                b = scratch.filePath(QStringLiteral("b"));  // a folder called like a file is in nobody's way
  const VolumePtr volume = made(smallParts(glm::dmat3(1)));
  QVERIFY(writeDicomSeries(*volume, {}, a.toStdString()).ok());
  QVERIFY(QDir().mkpath(b));  // an empty folder is accepted
  QVERIFY(writeDicomSeries(*volume, {}, b.toStdString()).ok());
  QVERIFY(!contents(a).isEmpty());
  QVERIFY(contents(a) == contents(b));

  // Another volume is another series.
  VolumeParts other = smallParts(glm::dmat3(1));
  other.geometry.origin.x += 1;
  const QString c = scratch.filePath(QStringLiteral("c"));
  QVERIFY(writeDicomSeries(*made(other), {}, c.toStdString()).ok());
  std::set<std::string> uids;
  for (const QString& folder : {a, c}) uids.insert(openStudy(folder.toStdString())->volumes[0].seriesUid);
  QCOMPARE(uids.size(), std::size_t(2));
}

// Every slice has the patient and study of Series, even if a source file spells them differently or lacks
// them.
void TestExportDicom::allSlicesSayWhoseTheyAreAlike() {
  const tests::DicomFolder source;
  for (int n = 0; n < 3; ++n) {
    tests::DicomPicture picture = tests::sliceAt(n, 100 * n);
    picture.edit = [n](DcmDataset& d) {
      d.putAndInsertString(DCM_PatientName, n == 1 ? "DOE^JANE" : "Doe^Jane");
      d.putAndInsertString(DCM_PatientID, "A111");
      d.putAndInsertString(DCM_PatientBirthDate, "19450508");
      if (n != 1) d.putAndInsertString(DCM_AccessionNumber, "4711");
    };
    source.add(tests::numbered("s", n), picture);
  }
  const Study opened = source.open();
  QCOMPARE(opened.volumes.size(), std::size_t(1));
  const Result<Loaded> loaded = loadSeries(opened.volumes[0]);
  QVERIFY(loaded.ok());
  const auto tags = readDicomTags(opened.volumes[0], *loaded);
  QVERIFY(tags.ok());
  QTemporaryDir scratch;
  const QString copy = scratch.filePath(QStringLiteral("copy"));
  QVERIFY(writeDicomSeries(*loaded->drawn, *tags, copy.toStdString()).ok());
  const QStringList names = QDir(copy).entryList(QDir::Files, QDir::Name);
  QCOMPARE(names.size(), qsizetype(3));
  for (const QString& name : names) {
    DcmFileFormat file;
    QVERIFY(file.loadFile(OFFilename(QDir(copy).filePath(name).toUtf8().constData())).good());
    const std::pair<DcmTagKey, const char*> expected[] = {
        {DCM_PatientName, "Doe^Jane"}, {DCM_PatientBirthDate, "19450508"}, {DCM_AccessionNumber, "4711"}};
    for (const auto& [tag, value] : expected) {
      OFString written;
      QVERIFY(file.getDataset()->findAndGetOFString(tag, written).good());
      QCOMPARE(QByteArray(written.c_str()), QByteArray(value));
    }
  }
}

void TestExportDicom::cancelledWritingLeavesNothing() {
  QTemporaryDir scratch;
  const CancelToken cancel;
  const Progress stopAtTheThird = [&](const char*, std::size_t done, std::size_t) {
    if (done == 2) cancel.cancel();
  };
  const auto status =
      writeDicomSeries(*made(smallParts(glm::dmat3(1))), {},
                       scratch.filePath(QStringLiteral("s")).toStdString(), stopAtTheThird, cancel);
  QVERIFY(!status.ok());
  QVERIFY(QDir(scratch.path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot).isEmpty());
}

VOLUMEN_TEST(TestExportDicom);
#include "tst_export_dicom.moc"
