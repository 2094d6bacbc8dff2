// Guards slices.md 4: the factors to SUV of real PET pictures and of each rule, and the reasons if they
// cannot be known.
#include <cmath>

#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/frame_of.h"
#include "tests/unit/io/pet_series.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

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
  void leanMassAndSurface_data();
  void leanMassAndSurface();
  void numbersInTwoSpellingsAreOne_data();
  void numbersInTwoSpellingsAreOne();
  void whatIsMissingIsNamed_data();
  void whatIsMissingIsNamed();
};

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
  const std::optional<double> found = study->volumes[0].suv.bodyWeight;
  QVERIFY2(found, study->volumes[0].suv.why.c_str());
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
  QVERIFY2(pet.suv.bodyWeight, pet.suv.why.c_str());
  QCOMPARE(*pet.suv.bodyWeight, 1.0);
  QCOMPARE(pet.sopInstanceUids.size(), pet.files.size());
  // Each slice has its own slope.
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
  QVERIFY(ct->volumes[0].suv == SuvFactors{});
}

void TestSuv::factors_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<double>("factor");
  constexpr double whole = 80000 / 100e6;  // g/Bq, without decay
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
  row("series later, GE's own time of the scan counts, in any block", 2 * whole, [](DcmDataset& d) {
    d.putAndInsertString(DCM_SeriesTime, "180000");
    d.putAndInsertString(DCM_AcquisitionTime, "120000");
    d.putAndInsertString(DcmTag(0x0009, 0x0011, EVR_LO), "GEMS_PETD_01");
    d.putAndInsertString(DcmTag(0x0009, 0x110d, EVR_DT), "20260228114000.00");
  });
  row("series not later: GE's own time does not count", 2 * whole, [](DcmDataset& d) {
    d.putAndInsertString(DcmTag(0x0009, 0x0010, EVR_LO), "GEMS_PETD_01");
    d.putAndInsertString(DcmTag(0x0009, 0x100d, EVR_DT), "20260228120000.00");
  });
  row("counts with a factor to Bq/ml", 6 * whole, [](DcmDataset& d) {
    d.putAndInsertString(DCM_Units, "CNTS");
    d.putAndInsertString(DcmTag(0x7053, 0x0010, EVR_LO), "Philips PET Private Group");
    d.putAndInsertString(DcmTag(0x7053, 0x1000, EVR_DS), "0");
    d.putAndInsertString(DcmTag(0x7053, 0x1009, EVR_DS), "3");
  });
  row("time zones, that of the injection an hour east", 2 * whole, [](DcmDataset& d) {
    d.putAndInsertString(DCM_TimezoneOffsetFromUTC, "+0100");
    doseOf(d).putAndInsertString(DCM_RadiopharmaceuticalStartDateTime, "20260228110000+0200");
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
  const SuvFactors found = petWith(edit).suv;
  QVERIFY2(found.bodyWeight, found.why.c_str());
  QVERIFY2(std::abs(*found.bodyWeight / factor - 1) < 1e-12, qPrintable(QString::number(*found.bodyWeight)));
}

void TestSuv::leanMassAndSurface_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<double>("lean");     // factor to SUVlbm relative to that of SUVbw; 0 for none
  QTest::addColumn<double>("surface");  // factor to SUVbsa, likewise
  QTest::addColumn<QString>("why");
  const auto row = [](const char* name, const char* sex, const char* size, double lean, double surface,
                      const char* why) {
    const Edit edit = [sex, size](DcmDataset& d) {
      d.putAndInsertString(DCM_PatientSex, sex);
      d.putAndInsertString(DCM_PatientSize, size);
    };
    QTest::newRow(name) << edit << lean << surface << QString::fromLatin1(why);
  };
  // 80 kg, 1.8 m: James 1.10 80 - 128 (80 / 180)^2 = 62.716, 1.07 80 - 148 (80 / 180)^2 = 56.365 kg; Du Bois
  // 0.007184 80^0.425 180^0.725 = 1.99645 m^2, by common logarithms.
  const double surface =
      1e4 * 0.007184 * std::pow(10, 0.425 * std::log10(80) + 0.725 * std::log10(180)) / 8e4;
  row("man", "M", "1.8", 62.716049382716 / 80, surface, "");
  row("woman", "F", "1.8", 56.365432098765 / 80, surface, "");
  row("neither", "O", "1.8", 0, surface, "PatientSex (0010,0040) is O");
  row("not said", "", "1.8", 0, surface, "PatientSex (0010,0040) is missing");
  row("no size", "M", "", 0, 0, "PatientSize (0010,1020) is missing");
  row("in cm", "M", "180", 0, 0, "PatientSize (0010,1020) is 180 m");
}

void TestSuv::leanMassAndSurface() {
  QFETCH(Edit, edit);
  QFETCH(double, lean);
  QFETCH(double, surface);
  QFETCH(QString, why);
  const SuvFactors found = petWith(edit).suv;
  QVERIFY2(found.bodyWeight, found.why.c_str());
  QCOMPARE(found.leanBodyMass.has_value(), lean > 0);
  QCOMPARE(found.bodySurface.has_value(), surface > 0);
  if (lean > 0) QVERIFY(isNear(*found.leanBodyMass / *found.bodyWeight, lean));
  if (surface > 0) QVERIFY(isNear(*found.bodySurface / *found.bodyWeight, surface));
  QCOMPARE(QString::fromStdString(found.why), why);
}

void TestSuv::numbersInTwoSpellingsAreOne_data() {
  QTest::addColumn<Edit>("edit");  // edit of the second file
  QTest::addColumn<bool>("same");
  QTest::newRow("weight") << Edit([](DcmDataset& d) { d.putAndInsertString(DCM_PatientWeight, "80.0"); })
                          << true;
  QTest::newRow("another weight") << Edit([](DcmDataset& d) {
    d.putAndInsertString(DCM_PatientWeight, "81");
  }) << false;
  QTest::newRow("dose") << Edit([](DcmDataset& d) {
    doseOf(d).putAndInsertString(DCM_RadionuclideTotalDose, "1e8");
  }) << true;
  QTest::newRow("time") << Edit([](DcmDataset& d) { d.putAndInsertString(DCM_SeriesTime, "114000.000"); })
                        << true;
  QTest::newRow("another time") << Edit([](DcmDataset& d) {
    d.putAndInsertString(DCM_SeriesTime, "114000.5");
  }) << false;
}

void TestSuv::numbersInTwoSpellingsAreOne() {
  QFETCH(Edit, edit);
  QFETCH(bool, same);
  int files = 0;
  const SuvFactors found = petWith([&](DcmDataset& d) {
                             if (files++ == 1) edit(d);
                           }).suv;
  QCOMPARE(found.bodyWeight.has_value(), same);
  QCOMPARE(found.why.find("its files differ") == std::string::npos, same);
}

void TestSuv::whatIsMissingIsNamed_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* says, Edit edit) {
    QTest::newRow(says) << edit << QString::fromLatin1(says);
  };
  row("no SUV: Units (0054,1001) is missing.", [](DcmDataset& d) { d.findAndDeleteElement(DCM_Units); });
  row("no SUV: Units (0054,1001) is CNTS.", [](DcmDataset& d) { d.putAndInsertString(DCM_Units, "CNTS"); });
  row("no SUVbw: SUVType (0054,1006) is LBM.", [](DcmDataset& d) {
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
  row("no SUV: PatientWeight (0010,1030) is 70000 kg.",
      [](DcmDataset& d) { d.putAndInsertString(DCM_PatientWeight, "70000"); });
  row("no SUV: PatientWeight (0010,1030) is -70 kg.",
      [](DcmDataset& d) { d.putAndInsertString(DCM_PatientWeight, "-70"); });
  row("no SUV: RadionuclideTotalDose (0018,1074) is 350 Bq.",
      [](DcmDataset& d) { doseOf(d).putAndInsertString(DCM_RadionuclideTotalDose, "350"); });
  row("no SUV: its scan begins 55 half-lives after the injection.",  // minutes instead of seconds
      [](DcmDataset& d) { doseOf(d).putAndInsertString(DCM_RadionuclideHalfLife, "110"); });
  row("no SUV: RadiopharmaceuticalStartTime (0018,1072) is noon.",
      [](DcmDataset& d) { doseOf(d).putAndInsertString(DCM_RadiopharmaceuticalStartTime, "noon"); });
  row("no SUV: RadiopharmaceuticalInformationSequence (0054,0016) is of 2 injections.", [](DcmDataset& d) {
    DcmItem* second = nullptr;
    d.findOrCreateSequenceItem(DCM_RadiopharmaceuticalInformationSequence, second, -2);
  });
  row("no SUV: SeriesDate (0008,0021) is missing.", [](DcmDataset& d) {
    d.findAndDeleteElement(DCM_SeriesDate);
    d.findAndDeleteElement(DCM_AcquisitionDate);
  });
  row("SUV: DecayCorrection (0054,1102) is NONE.", [](DcmDataset& d) {
    d.putAndInsertString(DCM_Units, "CNTS");
    d.putAndInsertString(DcmTag(0x7053, 0x0010, EVR_LO), "Philips PET Private Group");
    d.putAndInsertString(DcmTag(0x7053, 0x1000, EVR_DS), "0.25");
    d.putAndInsertString(DCM_DecayCorrection, "NONE");
  });
  int files = 0;
  row("no SUV: its files differ in units, weight, dose or times.",
      [files](DcmDataset& d) mutable { d.putAndInsertString(DCM_PatientWeight, files++ ? "80" : "60"); });
  row("has a time zone of its own.", [](DcmDataset& d) {
    doseOf(d).putAndInsertString(DCM_RadiopharmaceuticalStartDateTime, "20260228100000+0100");
  });
}

void TestSuv::whatIsMissingIsNamed() {
  QFETCH(Edit, edit);
  QFETCH(QString, says);
  const Series pet = petWith(edit);
  QVERIFY2(!pet.suv.bodyWeight, "a factor");
  const ValueScale scale = valueScale(pet, PetUnit::suvBodyWeight);
  QCOMPARE(scale.unit, pet.unit);
  QCOMPARE(scale.factor, 1.0);
  QVERIFY2(QString::fromStdString(scale.why + ".").endsWith(says), scale.why.c_str());
}

VOLUMEN_TEST(TestSuv);
#include "tst_suv.moc"
