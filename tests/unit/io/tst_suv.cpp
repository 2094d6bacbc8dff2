// Guards slices.md 4: the factor to SUVbw of real PET pictures, and what is said where it cannot
// be known.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <cmath>

#include "io/suv.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/io/frame_of.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

using Edit = std::function<void(DcmDataset&)>;
Q_DECLARE_METATYPE(Edit)

class TestSuv : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void realPictures_data();
  void realPictures();
  void seriesInSuvStaysAsItIs();
  void petAndCtShareTheirPlace();
  void factors_data();
  void factors();
  void whatIsMissingIsNamed_data();
  void whatIsMissingIsNamed();
};

namespace {

/// A PET of 80 kg, 100 MBq at 10:00, half-life 6000 s, series at 11:40: 6000 s later half of it is left.
void makePet(DcmDataset& data) {
  data.putAndInsertString(DCM_Modality, "PT");
  data.putAndInsertString(DCM_Units, "BQML");
  data.putAndInsertString(DCM_CorrectedImage, "NORM\\DECY\\ATTN");
  data.putAndInsertString(DCM_DecayCorrection, "START");
  data.putAndInsertString(DCM_PatientWeight, "80");
  data.putAndInsertString(DCM_SeriesDate, "20260228");
  data.putAndInsertString(DCM_SeriesTime, "114000");
  data.putAndInsertString(DCM_AcquisitionDate, "20260228");
  data.putAndInsertString(DCM_AcquisitionTime, "114000.0");
  DcmItem* dose = nullptr;
  data.findOrCreateSequenceItem(DCM_RadiopharmaceuticalInformationSequence, dose);
  dose->putAndInsertString(DCM_RadionuclideTotalDose, "100000000");
  dose->putAndInsertString(DCM_RadionuclideHalfLife, "6000");
  dose->putAndInsertString(DCM_RadiopharmaceuticalStartTime, "100000.000");
}

DcmItem& doseOf(DcmDataset& data) {
  DcmItem* dose = nullptr;
  data.findOrCreateSequenceItem(DCM_RadiopharmaceuticalInformationSequence, dose);
  return *dose;
}

Result<double> factorWith(const Edit& edit) {
  const DicomFolder folder;
  for (int n = 0; n < 2; ++n) {
    DicomPicture slice = sliceAt(3 * n, 100);
    slice.edit = [&](DcmDataset& data) {
      makePet(data);
      edit(data);
    };
    folder.add(numbered("s", n), slice);
  }
  const Study study = folder.open();
  return study.volumes.size() == 1 ? suvFactor(study.volumes[0]) : Error{"not one series"};
}

}  // namespace

void TestSuv::realPictures_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<double>("factor");
  QTest::addColumn<QPoint>("at");
  QTest::addColumn<double>("suv");
  const auto row = [](const char* file, double factor, QPoint at, double suv) {
    QTest::addRow("%s at %d,%d", file, at.x(), at.y()) << QString::fromLatin1(file) << factor << at << suv;
  };
  row("pet-bqml-fdg.dcm", 0.000446364074, {90, 101}, 6.45950);
  row("pet-bqml-fdg.dcm", 0.000446364074, {100, 100}, 1.98032);
  row("pet-bqml-fdg.dcm", 0.000446364074, {120, 105}, 0.47364);
  row("pet-bqml-flt028.dcm", 0.000473548915, {85, 90}, 6.15594);
  row("pet-bqml-flt028.dcm", 0.000473548915, {84, 84}, 1.16109);
  row("pet-bqml-flt028.dcm", 0.000473548915, {104, 89}, 0.70103);
}

void TestSuv::realPictures() {
  NEED_DATA(dataPath());
  QFETCH(QString, file);
  QFETCH(double, factor);
  QFETCH(QPoint, at);
  QFETCH(double, suv);
  const std::string path = dataPath("pet-ct/" + file.toStdString());
  const Result<Study> study = openStudy(path);
  QVERIFY(study.ok() && study->volumes.size() == 1);
  QCOMPARE(study->volumes[0].unit, std::string("Bq/ml"));
  const Result<double> found = suvFactor(study->volumes[0]);
  QVERIFY2(found.ok(), found.ok() ? "" : found.message().c_str());
  QVERIFY(std::abs(*found - factor) < 1e-12);  // the README gives nine digits
  const Result<Frame> frame = frameOf(path);
  QVERIFY(frame.ok());
  QVERIFY(std::abs(double(valueAt(*frame, at.x(), at.y())) * *found - suv) < 1e-5);
}

void TestSuv::seriesInSuvStaysAsItIs() {
  NEED_DATA(dataPath());
  const Result<Study> study = openStudy(dataPath("pet-ct/sts019-pet"));
  QVERIFY(study.ok() && study->volumes.size() == 1);
  const Series& pet = study->volumes[0];
  const Result<double> factor = suvFactor(pet);
  QVERIFY2(factor.ok(), factor.ok() ? "" : factor.message().c_str());
  QCOMPARE(*factor, 1.0);
  QCOMPARE(pet.sopInstanceUids.size(), pet.files.size());
  // Each slice has a slope of its own.
  const std::tuple<int, int, int, double> voxels[] = {
      {16, 13, 28, 16.3277}, {14, 12, 24, 6.0041}, {20, 10, 30, 1.0796}};
  for (const auto& [x, y, slice, suv] : voxels) {
    const Result<Frame> frame = loadFrame(pet, slice);
    QVERIFY(frame.ok());
    QCOMPARE(frame->unit, std::string("SUV"));
    QVERIFY(std::abs(double(valueAt(*frame, x, y)) - suv) < 5e-5);
  }
  QVERIFY(!loadFrame(pet, int(pet.files.size())).ok());
}

void TestSuv::petAndCtShareTheirPlace() {
  NEED_DATA(dataPath());
  const Result<Study> pet = openStudy(dataPath("pet-ct/sts019-pet")),
                      ct = openStudy(dataPath("pet-ct/sts019-ct"));
  QVERIFY(pet.ok() && ct.ok());
  QVERIFY(!pet->volumes.at(0).frameOfReferenceUid.empty());
  QCOMPARE(pet->volumes[0].frameOfReferenceUid, ct->volumes.at(0).frameOfReferenceUid);
  QVERIFY(!suvFactor(ct->volumes[0]).ok());
}

void TestSuv::factors_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<double>("factor");
  constexpr double whole = 80000 / 100e6;  // g/Bq, nothing decayed
  const auto row = [](const char* name, double factor, Edit edit) { QTest::newRow(name) << edit << factor; };
  row("START: from injection to series", 2 * whole, [](DcmDataset&) {});
  row("times in the old form, hh:mm:ss", 2 * whole, [](DcmDataset& d) {
    d.putAndInsertString(DCM_SeriesTime, "11:40:00");
    d.putAndInsertString(DCM_AcquisitionTime, "11:40:00.0");
    doseOf(d).putAndInsertString(DCM_RadiopharmaceuticalStartTime, "10:00:00.000");
  });
  row("ADMIN: not decayed again", whole,
      [](DcmDataset& d) { d.putAndInsertString(DCM_DecayCorrection, "ADMIN"); });
  row("series later than its pictures: the first picture counts", 2 * whole,
      [](DcmDataset& d) { d.putAndInsertString(DCM_SeriesTime, "180000"); });
  row("pictures later than the series: the series counts", 2 * whole,
      [](DcmDataset& d) { d.putAndInsertString(DCM_AcquisitionTime, "120000"); });
  row("counts with their factor", 0.25, [](DcmDataset& d) {
    d.putAndInsertString(DCM_Units, "CNTS");
    d.putAndInsertString(DcmTag(0x7053, 0x0010, EVR_LO), "Philips PET Private Group");
    d.putAndInsertString(DcmTag(0x7053, 0x1000, EVR_DS), "0.25");
  });
  row("over midnight by date", 2 * whole, [](DcmDataset& d) {
    doseOf(d).putAndInsertString(DCM_RadiopharmaceuticalStartDateTime, "20260228233000");
    d.putAndInsertString(DCM_SeriesDate, "20260301");
    d.putAndInsertString(DCM_AcquisitionDate, "20260301");
    d.putAndInsertString(DCM_SeriesTime, "011000");
    d.putAndInsertString(DCM_AcquisitionTime, "011000");
  });
  row("over midnight without a date of the injection", 2 * whole, [](DcmDataset& d) {
    doseOf(d).putAndInsertString(DCM_RadiopharmaceuticalStartTime, "233000");
    d.putAndInsertString(DCM_SeriesTime, "011000");
    d.putAndInsertString(DCM_AcquisitionTime, "011000");
  });
  row("days later", whole * std::exp2((6000 + 86400) / 6000.0), [](DcmDataset& d) {
    doseOf(d).putAndInsertString(DCM_RadiopharmaceuticalStartDateTime, "20260227100000");
  });
}

void TestSuv::factors() {
  QFETCH(Edit, edit);
  QFETCH(double, factor);
  const Result<double> found = factorWith(edit);
  QVERIFY2(found.ok(), found.ok() ? "" : found.message().c_str());
  QVERIFY2(std::abs(*found / factor - 1) < 1e-12, qPrintable(QString::number(*found)));
}

void TestSuv::whatIsMissingIsNamed_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* says, Edit edit) {
    QTest::newRow(says) << edit << QString::fromLatin1(says);
  };
  row("no SUV: Units (0054,1001) is missing.", [](DcmDataset& d) { d.findAndDeleteElement(DCM_Units); });
  row("no SUV: Units (0054,1001) is CNTS.", [](DcmDataset& d) { d.putAndInsertString(DCM_Units, "CNTS"); });
  row("no SUV: SUVType (0054,1006) is LBM.", [](DcmDataset& d) {
    d.putAndInsertString(DCM_Units, "GML");
    d.putAndInsertString(DCM_SUVType, "LBM");
  });
  row("no SUV: CorrectedImage (0028,0051) does not name ATTN.",
      [](DcmDataset& d) { d.putAndInsertString(DCM_CorrectedImage, "DECY"); });
  row("no SUV: CorrectedImage (0028,0051) does not name DECY.",
      [](DcmDataset& d) { d.putAndInsertString(DCM_CorrectedImage, "ATTN\\NORM"); });
  row("no SUV: DecayCorrection (0054,1102) is NONE.",
      [](DcmDataset& d) { d.putAndInsertString(DCM_DecayCorrection, "NONE"); });
  row("no SUV: DecayCorrection (0054,1102) is missing.",
      [](DcmDataset& d) { d.findAndDeleteElement(DCM_DecayCorrection); });
  row("no SUV: PatientWeight (0010,1030) is missing.",
      [](DcmDataset& d) { d.putAndInsertString(DCM_PatientWeight, "0"); });
  row("no SUV: RadiopharmaceuticalInformationSequence (0054,0016) is missing.",
      [](DcmDataset& d) { d.findAndDeleteElement(DCM_RadiopharmaceuticalInformationSequence); });
  row("no SUV: RadionuclideTotalDose (0018,1074) is missing.",
      [](DcmDataset& d) { doseOf(d).findAndDeleteElement(DCM_RadionuclideTotalDose); });
  row("no SUV: RadionuclideHalfLife (0018,1075) is missing.",
      [](DcmDataset& d) { doseOf(d).findAndDeleteElement(DCM_RadionuclideHalfLife); });
  row("no SUV: RadiopharmaceuticalStartTime (0018,1072) is missing.",
      [](DcmDataset& d) { doseOf(d).findAndDeleteElement(DCM_RadiopharmaceuticalStartTime); });
  row("no SUV: SeriesTime (0008,0031) is missing.", [](DcmDataset& d) {
    d.findAndDeleteElement(DCM_SeriesTime);
    d.findAndDeleteElement(DCM_AcquisitionDate);
  });
  row("no SUV: its scan begins before the injection.", [](DcmDataset& d) {
    doseOf(d).putAndInsertString(DCM_RadiopharmaceuticalStartDateTime, "20260228120000");
  });
  row("has a time zone of its own.", [](DcmDataset& d) {
    doseOf(d).putAndInsertString(DCM_RadiopharmaceuticalStartDateTime, "20260228100000+0100");
  });
}

void TestSuv::whatIsMissingIsNamed() {
  QFETCH(Edit, edit);
  QFETCH(QString, says);
  const Result<double> factor = factorWith(edit);
  QVERIFY2(!factor.ok(), "a factor");
  QVERIFY2(QString::fromStdString(factor.message()).endsWith(says), factor.message().c_str());
}

VOLUMEN_TEST(TestSuv);
#include "tst_suv.moc"
