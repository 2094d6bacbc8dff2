// Guards import.md: SUV of enhanced and legacy converted PET and of real world value mappings, and the
// reasons if their units cannot be known.
#include <cmath>

#include "tests/unit/io/dicom_frames.h"
#include "tests/unit/io/pet_series.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

/// Wraps an Edit in a type that only this file registers with Qt.
struct EnhancedEdit {
  Edit run;
};
Q_DECLARE_METATYPE(EnhancedEdit)

class TestSuvEnhanced : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void factors_data();
  void factors();
  void whatIsMissingIsNamed_data();
  void whatIsMissingIsNamed();
  void capturesHaveNoUptake();
};

namespace {

constexpr double whole = 80000 / 100e6;  // g/Bq of makePet(), without decay

void addMapping(DcmItem& item, double slope, double intercept, const char* code) {
  DcmItem *mapping = nullptr, *unit = nullptr;
  item.findOrCreateSequenceItem(DCM_RealWorldValueMappingSequence, mapping, -2);
  mapping->putAndInsertFloat64(DCM_RealWorldValueSlope, slope);
  mapping->putAndInsertFloat64(DCM_RealWorldValueIntercept, intercept);
  mapping->findOrCreateSequenceItem(DCM_MeasurementUnitsCodeSequence, unit);
  unit->putAndInsertString(DCM_CodeValue, code);
  unit->putAndInsertString(DCM_CodingSchemeDesignator, "UCUM");
  unit->putAndInsertString(DCM_CodeMeaning, code);
}

void rescaleBy(DcmItem& item, const char* slope) {
  item.putAndInsertString(DCM_RescaleSlope, slope);
  item.putAndInsertString(DCM_RescaleIntercept, "0");
}

DcmItem& groupItem(DcmDataset& d, const DcmTagKey& sequence) { return group(d, -1, sequence); }

/// Returns the item of a sequence beside the shared functional groups.
DcmItem& unassigned(DcmDataset& d) { return group(d, -1, DcmTagKey(0x0020, 0x9170)); }

/// Makes a PET of two frames like makePet(), without attributes that enhanced PET lacks.
void makeEnhanced(DcmDataset& d) {
  makePet(d);
  makeFrames(d, 2);
  for (const DcmTagKey& tag :
       {DCM_Units, DCM_CorrectedImage, DCM_DecayCorrection, DCM_SeriesTime, DCM_SeriesDate,
        DCM_AcquisitionDate, DCM_AcquisitionTime, DCM_ImagePositionPatient})
    d.findAndDeleteElement(tag);
  d.putAndInsertString(DCM_AttenuationCorrected, "YES");
  d.putAndInsertString(DCM_DecayCorrected, "YES");
  d.putAndInsertString(DCM_DecayCorrectionDateTime, "20260228114000");
  doseOf(d).putAndInsertString(DCM_RadiopharmaceuticalStartDateTime, "20260228100000");
  groupItem(d, DCM_PlaneOrientationSequence)
      .putAndInsertString(DCM_ImageOrientationPatient, "1\\0\\0\\0\\1\\0");
  groupItem(d, DCM_PixelMeasuresSequence).putAndInsertString(DCM_PixelSpacing, "1\\1");
  for (int n = 0; n < 2; ++n)
    group(d, n, DCM_PlanePositionSequence)
        .putAndInsertString(DCM_ImagePositionPatient, n ? "0\\0\\3" : "0\\0\\0");
}

Series enhancedWith(const Edit& edit) {
  const DicomFolder folder;
  DicomPicture picture;
  picture.orientation = picture.spacing = "";
  picture.edit = [&](DcmDataset& d) {
    makeEnhanced(d);
    edit(d);
  };
  folder.add("a", picture);
  const Study study = folder.open();
  return study.volumes.size() == 1 ? study.volumes[0] : Series{};
}

void mapAll(DcmDataset& d, double slope, const char* code) {
  rescaleBy(groupItem(d, DCM_PixelValueTransformationSequence), "2");
  DcmItem* shared = nullptr;
  d.findOrCreateSequenceItem(DCM_SharedFunctionalGroupsSequence, shared);
  addMapping(*shared, slope, 0, code);
}

}  // namespace

void TestSuvEnhanced::factors_data() {
  QTest::addColumn<bool>("enhanced");
  QTest::addColumn<EnhancedEdit>("edit");
  QTest::addColumn<double>("factor");
  QTest::addColumn<QString>("unit");
  const auto row = [](const char* name, bool enhanced, double factor, const char* unit, Edit edit) {
    QTest::newRow(name) << enhanced << EnhancedEdit{edit} << factor << QString::fromLatin1(unit);
  };
  row("enhanced, in Bq/ml", true, 2 * whole, "Bq/ml", [](DcmDataset& d) { mapAll(d, 2, "Bq/ml"); });
  row("enhanced, corrected to the injection", true, whole, "Bq/ml", [](DcmDataset& d) {
    mapAll(d, 2, "Bq/ml");
    d.putAndInsertString(DCM_DecayCorrectionDateTime, "20260228100000");
  });
  row("enhanced, time zones", true, 2 * whole, "Bq/ml", [](DcmDataset& d) {
    mapAll(d, 2, "Bq/ml");
    d.putAndInsertString(DCM_DecayCorrectionDateTime, "20260228104000+0000");
    doseOf(d).putAndInsertString(DCM_RadiopharmaceuticalStartDateTime, "20260228100000+0100");
  });
  row("enhanced, mapped to SUVbw without a rescale", true, 1, "SUV", [](DcmDataset& d) {
    DcmItem* shared = nullptr;
    d.findOrCreateSequenceItem(DCM_SharedFunctionalGroupsSequence, shared);
    addMapping(*shared, 0.001, 0, "{SUVbw}g/ml");
  });
  row("enhanced, Bq/ml and SUVbw, no dose", true, 0.25, "Bq/ml", [](DcmDataset& d) {
    mapAll(d, 2, "Bq/ml");
    mapAll(d, 0.5, "{SUVbw}g/ml");
    d.findAndDeleteElement(DCM_RadiopharmaceuticalInformationSequence);
  });
  row("legacy converted", true, 2 * whole, "Bq/ml", [](DcmDataset& d) {
    for (const DcmTagKey& tag : {DCM_AttenuationCorrected, DCM_DecayCorrected, DCM_DecayCorrectionDateTime})
      d.findAndDeleteElement(tag);
    DcmItem& shared = unassigned(d);
    shared.putAndInsertString(DCM_Units, "BQML");
    shared.putAndInsertString(DCM_CorrectedImage, "DECY\\ATTN");
    shared.putAndInsertString(DCM_DecayCorrection, "START");
    shared.putAndInsertString(DCM_SeriesDate, "20260228");
    shared.putAndInsertString(DCM_SeriesTime, "114000");
  });
  row("classic, mapped to SUVbw, no weight", false, 0.25, "Bq/ml", [](DcmDataset& d) {
    rescaleBy(d, "2");
    addMapping(d, 0.5, 0, "{SUVbw}g/ml");
    d.findAndDeleteElement(DCM_PatientWeight);
  });
  row("classic, dose and mapping: by the dose", false, 2 * whole, "Bq/ml", [](DcmDataset& d) {
    rescaleBy(d, "2");
    addMapping(d, 0.5, 0, "{SUVbw}g/ml");
  });
}

void TestSuvEnhanced::factors() {
  QFETCH(bool, enhanced);
  QFETCH(EnhancedEdit, edit);
  QFETCH(double, factor);
  QFETCH(QString, unit);
  const Series pet = enhanced ? enhancedWith(edit.run) : petWith(edit.run);
  QVERIFY2(pet.suv.bodyWeight, pet.suv.why.c_str());
  QVERIFY2(std::abs(*pet.suv.bodyWeight / factor - 1) < 1e-9,
           qPrintable(QString::number(*pet.suv.bodyWeight, 'g', 12)));
  QCOMPARE(QString::fromStdString(pet.unit), unit);
}

void TestSuvEnhanced::whatIsMissingIsNamed_data() {
  QTest::addColumn<bool>("enhanced");
  QTest::addColumn<EnhancedEdit>("edit");
  QTest::addColumn<QString>("why");
  const auto row = [](const char* why, bool enhanced, Edit edit) {
    QTest::newRow(why) << enhanced << EnhancedEdit{edit} << QString::fromLatin1(why);
  };
  row("no Real World Value Mapping gives the unit of its values", true, [](DcmDataset&) {});
  row("DecayCorrectionDateTime (0018,9701) is missing", true, [](DcmDataset& d) {
    mapAll(d, 2, "Bq/ml");
    d.findAndDeleteElement(DCM_DecayCorrectionDateTime);
  });
  row("DecayCorrectionDateTime (0018,9701) is noon", true, [](DcmDataset& d) {
    mapAll(d, 2, "Bq/ml");
    d.putAndInsertString(DCM_DecayCorrectionDateTime, "noon");
  });
  row("AttenuationCorrected (0018,9759) is not YES", true, [](DcmDataset& d) {
    mapAll(d, 2, "Bq/ml");
    d.putAndInsertString(DCM_AttenuationCorrected, "NO");
  });
  row("DecayCorrected (0018,9758) is not YES", true, [](DcmDataset& d) {
    mapAll(d, 2, "Bq/ml");
    d.findAndDeleteElement(DCM_DecayCorrected);
  });
  row("PatientWeight (0010,1030) is missing", false, [files = 0](DcmDataset& d) mutable {
    rescaleBy(d, "2");
    addMapping(d, files++ ? 0.5 : 0.6, 0, "{SUVbw}g/ml");  // two different factors: neither is the series'
    d.findAndDeleteElement(DCM_PatientWeight);
  });
}

void TestSuvEnhanced::whatIsMissingIsNamed() {
  QFETCH(bool, enhanced);
  QFETCH(EnhancedEdit, edit);
  QFETCH(QString, why);
  const Series pet = enhanced ? enhancedWith(edit.run) : petWith(edit.run);
  QVERIFY(!pet.suv.bodyWeight);
  QCOMPARE(QString::fromStdString(pet.suv.why), why);
}

// A screen capture of a PET station has no units, which is not reported as an error.
void TestSuvEnhanced::capturesHaveNoUptake() {
  const Series capture = petWith([](DcmDataset& d) {
    d.putAndInsertString(DCM_SOPClassUID, UID_SecondaryCaptureImageStorage);
    d.findAndDeleteElement(DCM_Units);
  });
  QCOMPARE(capture.files.size(), std::size_t(2));
  QVERIFY(capture.suv == SuvFactors{});
}

VOLUMEN_TEST(TestSuvEnhanced);
#include "tst_suv_enhanced.moc"
