// Guards import.md and slices.md on ../shared/data/field-cases (its CASES.tsv says why): volumes that must be
// recognised, with their positions, values and units.
#include <algorithm>
#include <cmath>

#include "io/contours.h"
#include "io/load.h"
#include "io/open.h"
#include "io/segmentation.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestFieldCases : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void volumesLieAndReadAsWritten_data();
  void volumesLieAndReadAsWritten();
  void valuesLieWhereTheyBelong_data();
  void valuesLieWhereTheyBelong();
  void phasesStayApart();
  void tinySlopesKeepTheirDigits();
  void objectsLieOnTheirPictures();
};

namespace {

Study studyOf(const char* name) {
  const Result<Study> study = openStudy(dataPath(std::string("field-cases/") + name));
  return study ? *study : Study{};
}

/// Returns the value of the voxel nearest to a patient position, mm.
float valueAt(const Volume& volume, glm::dvec3 p) {
  const glm::dvec3 x = volume.geometry().voxelFromPatient(p);
  return volume.value(int(std::lround(x.x)), int(std::lround(x.y)), int(std::lround(x.z)));
}

QList<float> firsts(const Volume& volume) {
  const std::vector<float> values = firstOfEachSlice(volume);
  return {values.begin(), values.end()};
}

void compareVectors(glm::dvec3 found, glm::dvec3 expected) {
  for (int a = 0; a < 3; ++a) QVERIFY(std::abs(found[a] - expected[a]) < 1e-6);
}

}  // namespace

void TestFieldCases::volumesLieAndReadAsWritten_data() {
  QTest::addColumn<glm::ivec3>("size");
  QTest::addColumn<glm::dvec3>("spacing");
  QTest::addColumn<glm::dvec3>("origin");
  QTest::addColumn<QList<float>>("values");
  QTest::addColumn<QString>("unit");
  QTest::addColumn<QByteArray>("warning");  // empty for none
  const auto row = [](const char* name, glm::ivec3 size, glm::dvec3 spacing, glm::dvec3 origin,
                      const QList<float>& values, const char* unit, const char* warning) {
    QTest::newRow(name) << size << spacing << origin << values << QString::fromLatin1(unit)
                        << QByteArray(warning);
  };
  row("c01-nm-recon-tomo", {16, 16, 10}, {4, 4, 4}, {-30, -30, 14},
      {1000, 900, 800, 700, 600, 500, 400, 300, 200, 100}, "", "");
  row("c02-enhanced-mr-shuffled", {10, 8, 12}, {1, 1, 3}, {0, 0, 0},
      {1, 11, 21, 31, 41, 51, 61, 71, 81, 91, 101, 111}, "", "");
  row("c06-dose-absolute-offsets", {8, 6, 4}, {2, 3, 2.5}, {10, 20, -40}, {1, 2, 3, 4}, "Gy", "");
  row("c40-enhanced-us-volume", {12, 10, 6}, {0.25, 0.3, 0.4}, {0, 0, 0}, {10, 40, 70, 100, 130, 160}, "",
      "space of its transducer");
}

void TestFieldCases::volumesLieAndReadAsWritten() {
  NEED_DATA(dataPath());
  QFETCH(glm::ivec3, size);
  QFETCH(glm::dvec3, spacing);
  QFETCH(glm::dvec3, origin);
  QFETCH(QList<float>, values);
  QFETCH(QString, unit);
  QFETCH(QByteArray, warning);
  const Study study = studyOf(QTest::currentDataTag());
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const Series& series = study.volumes[0];
  const auto loaded = loadSeries(series);
  QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
  const VoxelGeometry& geometry = loaded->acquired->geometry();
  QVERIFY(geometry.calibrated);
  QCOMPARE(geometry.size, size);
  compareVectors(geometry.spacing(), spacing);
  compareVectors(geometry.origin, origin);
  QCOMPARE(firsts(*loaded->acquired), values);
  QCOMPARE(QString::fromStdString(series.unit), unit);
  QCOMPARE(loaded->warnings.empty(), warning.isEmpty());
  if (!warning.isEmpty()) QVERIFY(warns(loaded->warnings, warning.toStdString()));
}

void TestFieldCases::valuesLieWhereTheyBelong_data() {
  QTest::addColumn<QString>("folder");
  QTest::addColumn<glm::dvec3>("place");
  QTest::addColumn<double>("value");
  QTest::addColumn<QString>("unit");
  const auto row = [](const char* name, const char* folder, glm::dvec3 place, double value,
                      const char* unit) {
    QTest::newRow(name) << QString::fromLatin1(folder) << place << value << QString::fromLatin1(unit);
  };
  row("the hot voxel of a SPECT", "c01-nm-recon-tomo", {-18, -22, 50}, 5000, "");
  row("its last frame", "c01-nm-recon-tomo", {-30, -30, 14}, 1000, "");
  row("a dose", "c06-dose-absolute-offsets", {12, 23, -35}, 3, "Gy");
  row("a diffusion coefficient", "c27-adc-unit", {0, 4, 2}, 0.001281, "mm2/s");
}

void TestFieldCases::valuesLieWhereTheyBelong() {
  NEED_DATA(dataPath());
  QFETCH(QString, folder);
  QFETCH(glm::dvec3, place);
  QFETCH(double, value);
  QFETCH(QString, unit);
  const Study study = studyOf(folder.toLatin1().constData());
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const auto loaded = loadSeries(study.volumes[0]);
  QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
  QCOMPARE(valueAt(*loaded->acquired, place), float(value));
  QCOMPARE(QString::fromStdString(study.volumes[0].unit), unit);
}

// The n-th trigger time at each position is the n-th phase, whatever its milliseconds (c09).
void TestFieldCases::phasesStayApart() {
  NEED_DATA(dataPath());
  const Study study = studyOf("c09-cine-trigger-times");
  QCOMPARE(study.volumes.size(), std::size_t(4));
  for (int phase = 0; phase < 4; ++phase) {
    const auto loaded = loadSeries(study.volumes[std::size_t(phase)]);
    QVERIFY(loaded.ok());
    compareVectors(loaded->acquired->geometry().spacing(), {1, 1, 8});
    const float first = 100 * float(phase);
    QCOMPARE(firsts(*loaded->acquired), (QList<float>{first, first + 1, first + 2}));
  }
}

void TestFieldCases::tinySlopesKeepTheirDigits() {
  NEED_DATA(dataPath());
  const Study study = studyOf("c41-tiny-slopes");
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const auto loaded = loadSeries(study.volumes[0]);
  QVERIFY(loaded.ok());
  const Volume& volume = *loaded->acquired;
  QCOMPARE(volume.size(), glm::ivec3(8, 8, 4));
  compareVectors(volume.geometry().spacing(), {1, 1, 3});
  double most = 0;
  for (std::size_t n = 0; n < 256; ++n) most = std::max(most, double(volume.valueAt(n)));
  QVERIFY2(std::abs(most / 3.346245e-4 - 1) < 1e-6, qPrintable(QString::number(most, 'g', 9)));
}

// c70 has a segment with shuffled frames and reversed rows and columns. Contours lie 0.004 mm beside their
// slices, or in another frame of reference.
void TestFieldCases::objectsLieOnTheirPictures() {
  NEED_DATA(dataPath());
  const std::string folder = dataPath("field-cases/c70-objects");
  const Study study = studyOf("c70-objects");
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(study.volumes[0].acquired.size, glm::ivec3(64, 64, 8));
  const auto segmentation = loadSegmentation(folder + "/seg.dcm");
  QVERIFY2(segmentation.ok(), segmentation.ok() ? "" : segmentation.message().c_str());
  const LabelMap none(study.volumes[0].acquired);
  const DenseLabels block = withLabel(none, 1, maskOf(*segmentation, 0, none.geometry())).dense();
  QCOMPARE(std::ranges::count(block.labels, std::uint8_t(1)), 600);
  const auto box = maskOf(LabelMap(block), 1).box();
  QVERIFY(box.has_value());
  compareVectors(block.geometry.patientFromVoxel(glm::dvec3(box->low)), {8, -22, 6});
  compareVectors(block.geometry.patientFromVoxel(glm::dvec3(box->high)), {22, -13, 15});
  const auto ct = loadSeries(study.volumes[0]);
  QVERIFY(ct.ok());
  for (std::size_t n = 0; n < block.labels.size(); ++n)
    QVERIFY(!block.labels[n] || ct->acquired->valueAt(n) == 300);
  const auto ring = loadContours(folder + "/rt.dcm"), foreign = loadContours(folder + "/rt2.dcm");
  QVERIFY(ring.ok() && foreign.ok());
  std::vector<double> areas;
  for (const RegionOfInterest& region : ring->regions)
    for (const Contour& contour : region.contours) areas.push_back(areaOf(contour));
  std::ranges::sort(areas);
  QCOMPARE(areas.size(), std::size_t(8));
  for (std::size_t n = 0; n < 8; ++n) QVERIFY(std::abs(areas[n] - (n < 4 ? 64 : 400)) < 1e-6);
  QCOMPARE(ring->regions[0].frameOfReferenceUid, study.volumes[0].frameOfReferenceUid);
  QVERIFY(foreign->regions[0].frameOfReferenceUid != study.volumes[0].frameOfReferenceUid);
}

VOLUMEN_TEST(TestFieldCases);
#include "tst_field_cases.moc"
