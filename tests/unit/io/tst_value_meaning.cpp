// Guards slices.md 4 and import.md: the unit beside values, and values of a real world value mapping with
// their windows, in volumes and in frames.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <cmath>

#include "io/frames.h"
#include "io/load.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/io/dicom_frames.h"
#include "tests/unit/suite.h"
#include "viewer/slice/first_window.h"

using namespace volumen;
using namespace volumen::tests;

using Edit = std::function<void(DcmDataset&)>;
Q_DECLARE_METATYPE(Edit)

class TestValueMeaning : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void unitsStandBesideValues_data();
  void unitsStandBesideValues();
  void valuesWithoutRescaleAreTold_data();
  void valuesWithoutRescaleAreTold();
  void slicesOfSeveralUnitsHaveNone();
  void framesOfSeveralUnitsAreTold();
  void modalityLutsHaveTheirUnit();
  void windowsGoWithMappedValues_data();
  void windowsGoWithMappedValues();
  void mappedFramesSayWhatTheyShow();
};

namespace {

void text(DcmItem& d, const DcmTagKey& tag, const char* value) { d.putAndInsertString(tag, value); }

void rescale(DcmItem& d, const char* slope, const char* type) {
  text(d, DCM_RescaleSlope, slope);
  text(d, DCM_RescaleIntercept, "0");
  if (*type) text(d, DCM_RescaleType, type);
}

/// Adds a mapping by slope and intercept to a unit of a coding scheme.
void addMapping(DcmItem& d, double slope, double intercept, const char* code, const char* scheme = "UCUM",
                const char* meaning = "what it means") {
  DcmItem *mapping = nullptr, *unit = nullptr;
  d.findOrCreateSequenceItem(DCM_RealWorldValueMappingSequence, mapping);
  mapping->putAndInsertFloat64(DCM_RealWorldValueSlope, slope);
  mapping->putAndInsertFloat64(DCM_RealWorldValueIntercept, intercept);
  mapping->findOrCreateSequenceItem(DCM_MeasurementUnitsCodeSequence, unit);
  text(*unit, DCM_CodeValue, code);
  text(*unit, DCM_CodingSchemeDesignator, scheme);
  text(*unit, DCM_CodeMeaning, meaning);
}

Study studyWith(const DicomFolder& folder, const Edit& edit, DicomPicture picture = {}) {
  picture.edit = edit;
  folder.add("s", picture);
  return folder.open();
}

}  // namespace

void TestValueMeaning::unitsStandBesideValues_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<QString>("unit");
  const auto row = [](const char* name, const char* unit, const Edit& edit) {
    QTest::newRow(name) << edit << QString::fromUtf8(unit);
  };
  const auto ofType = [](const char* modality, const char* type) {
    return [=](DcmDataset& d) { text(d, DCM_Modality, modality), rescale(d, "2", type); };
  };
  row("CT", "HU", ofType("CT", ""));
  row("CT in HU", "HU", ofType("CT", "HU"));
  row("CT of iodine", "mg/ml", ofType("CT", "MGML"));
  row("CT, unspecified", "", ofType("CT", "US"));
  row("MR without a type", "", ofType("MR", ""));
  row("MR, unspecified", "", ofType("MR", "US"));
  row("MR of Philips", "", ofType("MR", "normalized"));
  row("diffusion", "mm2/s", ofType("MR", "mm2/s"));
  row("a T1 map", "ms", ofType("MR", "ms"));
  row("a percentage", "%", ofType("MR", "PCT"));
  row("in a functional group", "ms", [](DcmDataset& d) {
    text(d, DCM_Modality, "MR");
    rescale(group(d, -1, DCM_PixelValueTransformationSequence), "2", "ms");
  });
  const auto pet = [](const char* units) {
    return [=](DcmDataset& d) { text(d, DCM_Modality, "PT"), text(d, DCM_Units, units); };
  };
  row("PET", "Bq/ml", pet("BQML"));
  row("PET in SUV", "SUV", pet("GML"));
  row("PET of flow", "ml/min/g", pet("MLMING"));
  row("PET in counts", "", pet("CNTS"));
  const auto dose = [](const char* units, bool scaled) {
    return [=](DcmDataset& d) {
      text(d, DCM_Modality, "RTDOSE");
      if (units) text(d, DCM_DoseUnits, units);
      if (scaled) text(d, DCM_DoseGridScaling, "0.001");
    };
  };
  row("a dose", "Gy", dose("GY", true));
  row("a relative dose", "relative", dose("RELATIVE", true));
  row("a dose without its scaling", "", dose("GY", false));
  const auto mapped = [](const char* code, const char* scheme) {
    return [=](DcmDataset& d) { text(d, DCM_Modality, "MR"), addMapping(d, 2, 3, code, scheme); };
  };
  row("mapped, as UCUM has it", "um2/s", mapped("um2/s", "UCUM"));
  row("mapped to HU", "HU", mapped("[hnsf'U]", "UCUM"));
  row("mapped to Bq/ml", "Bq/ml", mapped("Bq/ml", "UCUM"));
  row("mapped to SUV", "SUV", mapped("{SUVbw}g/ml", "UCUM"));
  row("mapped to SUV by surface", "SUV", mapped("cm2/ml{SUVbsa}", "UCUM"));
  row("mapped to a number", "", mapped("1", "UCUM"));
  row("mapped to a ratio", "", mapped("{ratio}", "UCUM"));
  row("mapped, of another scheme", "what it means", mapped("12345", "99VOLUMEN"));
  row("mapped as it is rescaled", "ms",
      [](DcmDataset& d) { text(d, DCM_Modality, "MR"), rescale(d, "2", "US"), addMapping(d, 2, 0, "ms"); });
  row("mapped otherwise than it is rescaled", "",
      [](DcmDataset& d) { text(d, DCM_Modality, "MR"), rescale(d, "2", "US"), addMapping(d, 3, 0, "ms"); });
  row("a CT that is mapped to nothing known", "", [](DcmDataset& d) { addMapping(d, 3, 0, "1"); });
}

void TestValueMeaning::unitsStandBesideValues() {
  QFETCH(Edit, edit);
  QFETCH(QString, unit);
  const DicomFolder folder;
  const Study study = studyWith(folder, edit);
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const Series& series = study.volumes[0];
  QCOMPARE(QString::fromStdString(series.unit), unit);
  QCOMPARE(warns(series.warnings, "relative to a value"), unit == QStringLiteral("relative"));
  const auto frame = loadFrame(series, 0);
  QVERIFY(frame.ok());
  QCOMPARE(QString::fromStdString(frame->unit), unit);
}

void TestValueMeaning::valuesWithoutRescaleAreTold_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<bool>("isRescaled");
  QTest::addColumn<QString>("unit");
  QTest::addColumn<QByteArray>("says");  // empty for nothing
  const QByteArray stored("its values are the stored ones, without unit"), taken("1 and 0 are taken");
  const auto row = [](const char* name, const char* unit, const QByteArray& says, const Edit& edit,
                      bool isRescaled = false) {
    QTest::newRow(name) << edit << isRescaled << QString::fromLatin1(unit) << says;
  };
  const auto of = [](const char* modality, const DcmTagKey& tag = DCM_Modality, const char* value = "") {
    return [=](DcmDataset& d) {
      if (*value) text(d, tag, value);
      text(d, DCM_Modality, modality);
    };
  };
  row("CT", "", stored, of("CT"));
  row("CT of slope 1", "HU", "", of("CT"), true);
  row("CT of intercept -1024 alone", "HU", "0 is taken",
      [](DcmDataset& d) { text(d, DCM_RescaleSlope, "2"); });
  row("CT that says HU", "HU", taken, of("CT", DCM_RescaleType, "HU"));
  row("CT that is unspecified", "", stored, of("CT", DCM_RescaleType, "US"));
  row("MR", "", "", of("MR"));
  row("MR in ms", "ms", taken, of("MR", DCM_RescaleType, "ms"));
  row("PET", "Bq/ml", taken, of("PT", DCM_Units, "BQML"));
  row("mapped CT", "HU", "", [](DcmDataset& d) { addMapping(d, 1, 0, "[hnsf'U]"); });
}

void TestValueMeaning::valuesWithoutRescaleAreTold() {
  QFETCH(Edit, edit);
  QFETCH(bool, isRescaled);
  QFETCH(QString, unit);
  QFETCH(QByteArray, says);
  const DicomFolder folder;
  DicomPicture picture;
  picture.isRescaled = isRescaled;
  const Study study = studyWith(folder, edit, picture);
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const Series& series = study.volumes[0];
  QCOMPARE(QString::fromStdString(series.unit), unit);
  for (const char* words : {"stored ones", "taken"})
    QCOMPARE(warns(series.warnings, words), !says.isEmpty() && says.contains(words));
  if (!says.isEmpty()) QVERIFY(warns(series.warnings, says.toStdString()));
  const auto frame = loadFrame(series, 0);
  QVERIFY(frame.ok());
  QCOMPARE(QString::fromStdString(frame->unit), unit);
}

void TestValueMeaning::slicesOfSeveralUnitsHaveNone() {
  const DicomFolder folder;
  for (int n = 0; n < 4; ++n) {
    DicomPicture slice = sliceAt(n, n);
    slice.isRescaled = n != 1;
    folder.add(numbered("s", n), slice);
  }
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(study.volumes[0].unit, std::string());
  QVERIFY(warns(study.volumes[0].warnings, "s1: it gives no rescale"));
}

void TestValueMeaning::framesOfSeveralUnitsAreTold() {
  const DicomFolder folder;
  DicomPicture picture;
  picture.orientation = picture.spacing = "";
  const Study study = studyWith(
      folder,
      [](DcmDataset& d) {
        makeFrames(d, 2);
        text(d, DCM_Modality, "MR");
        text(group(d, -1, DCM_PlaneOrientationSequence), DCM_ImageOrientationPatient, "1\\0\\0\\0\\1\\0");
        text(group(d, -1, DCM_PixelMeasuresSequence), DCM_PixelSpacing, "1\\1");
        for (int n = 0; n < 2; ++n) {
          text(group(d, n, DCM_PlanePositionSequence), DCM_ImagePositionPatient, n ? "0\\0\\1" : "0\\0\\0");
          rescale(group(d, n, DCM_PixelValueTransformationSequence), "2", n ? "ms" : "mm2/s");
        }
      },
      picture);
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(study.volumes[0].unit, std::string());
  QVERIFY(warns(study.volumes[0].warnings, "different units"));
  const auto second = loadFrame(study.volumes[0], 1);
  QVERIFY(second.ok());
  QCOMPARE(second->unit, std::string("ms"));
}

// A modality LUT is applied to frames, but not to volumes.
void TestValueMeaning::modalityLutsHaveTheirUnit() {
  const DicomFolder folder;
  const Study study = studyWith(folder, [](DcmDataset& d) {
    DcmItem* item = nullptr;
    d.findOrCreateSequenceItem(DCM_ModalityLUTSequence, item);
    const Uint16 descriptor[] = {2, 0, 16}, entries[] = {7, 9};
    item->putAndInsertUint16Array(DcmTag(DCM_LUTDescriptor, EVR_US), descriptor, 3);
    item->putAndInsertUint16Array(DcmTag(DCM_LUTData, EVR_OW), entries, 2);
    text(*item, DCM_ModalityLUTType, "MGML");
  });
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(study.volumes[0].unit, std::string());
  const auto frame = loadFrame(study.volumes[0], 0);
  QVERIFY(frame.ok());
  QCOMPARE(frame->unit, std::string("mg/ml"));
}

void TestValueMeaning::windowsGoWithMappedValues_data() {
  QTest::addColumn<double>("slope");
  QTest::addColumn<double>("intercept");
  QTest::addColumn<QByteArray>("function");
  for (const double slope : {2.08, 1.0, 1e-6, 37.0, -2.0})
    for (const char* function : {"LINEAR", "LINEAR_EXACT", "SIGMOID"})
      QTest::addRow("%g, %s", slope, function) << slope << 3 * slope << QByteArray(function);
}

// The picture is that of the stored values under the file's window, whatever they are mapped to.
void TestValueMeaning::windowsGoWithMappedValues() {
  QFETCH(double, slope);
  QFETCH(double, intercept);
  QFETCH(QByteArray, function);
  DicomPicture picture;
  picture.columns = 32;
  picture.rows = 32;
  for (int n = 0; n < 1024; ++n) picture.pixels.push_back(std::uint16_t(n + 300));
  const DicomFolder plain, mapped;
  const auto windowed = [&](DcmDataset& d) {
    text(d, DCM_Modality, "MR");
    text(d, DCM_WindowCenter, "892");
    text(d, DCM_WindowWidth, "513");
    text(d, DCM_VOILUTFunction, function.constData());
  };
  const Study before = studyWith(plain, windowed, picture);
  const Study after = studyWith(
      mapped, [&](DcmDataset& d) { windowed(d), addMapping(d, slope, intercept, "ms"); }, picture);
  const auto stored = loadFrame(before.volumes.at(0), 0), values = loadFrame(after.volumes.at(0), 0);
  QVERIFY(stored.ok() && values.ok());
  const auto bytes = stored->values.greyBytes(stored->greys[0].mapping);
  const auto mappedBytes = values->values.greyBytes(values->greys[0].mapping);
  const auto near = [&](const std::vector<std::uint8_t>& found) {
    for (std::size_t n = 0; n < bytes.size(); ++n)
      if (std::abs(int(found[n]) - int(bytes[n])) > 1) return false;  // values are rounded to float32
    return true;
  };
  QVERIFY(near(mappedBytes));
  QCOMPARE(values->values[5], float(slope * 305 + intercept));
  const auto loaded = loadSeries(after.volumes[0]);
  QVERIFY(loaded.ok());
  QVERIFY(warns(loaded->warnings, "values are those of its Real World Value Mapping"));
  if (slope < 0 || function == "SIGMOID") return;  // volumes support neither
  std::vector<float> voxels(1024);
  for (std::size_t n = 0; n < voxels.size(); ++n) voxels[n] = loaded->acquired->valueAt(n);
  QCOMPARE(voxels, values->values.floats());
  const Window window = firstWindow(*loaded->acquired, after.volumes[0].unit);
  QVERIFY(function != "LINEAR_EXACT" || std::abs(window.width - 513 * slope) < 1e-9);
  if (function == "LINEAR" || slope != 1)
    QVERIFY(near(greyBytes(voxels, windowGrey(*loaded->acquired, true, window))));
}

void TestValueMeaning::mappedFramesSayWhatTheyShow() {
  const DicomFolder folder;
  const Study study = studyWith(folder, [](DcmDataset& d) {
    addMapping(d, 2.5, 0, "ms");
    DcmItem* item = nullptr;
    d.findOrCreateSequenceItem(DCM_VOILUTSequence, item);
    const Uint16 descriptor[] = {2, 0, 16}, entries[] = {0, 65535};
    item->putAndInsertUint16Array(DcmTag(DCM_LUTDescriptor, EVR_US), descriptor, 3);
    item->putAndInsertUint16Array(DcmTag(DCM_LUTData, EVR_OW), entries, 2);
  });
  const auto frame = loadFrame(study.volumes.at(0), 0);
  QVERIFY(frame.ok());
  QCOMPARE(frame->greys.size(), std::size_t(1));
  QVERIFY(frame->greys[0].ofValues);
  QStringList said;
  for (const std::string& sentence : frame->warnings) said << QString::fromStdString(sentence);
  QCOMPARE(said.filter(QStringLiteral("Real World Value Mapping")).size(), 1);
  QCOMPARE(said.filter(QStringLiteral("VOI LUTs are left out")).size(), 1);
}

VOLUMEN_TEST(TestValueMeaning);
#include "tst_value_meaning.moc"
