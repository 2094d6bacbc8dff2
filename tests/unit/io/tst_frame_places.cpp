// Guards import.md: positions and pixel sizes of frames that do not state them individually: nuclear
// medicine, ultrasound volumes, doses.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <array>
#include <cmath>

#include "io/frames.h"
#include "io/load.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/io/dicom_frames.h"
#include "tests/unit/io/frame_of.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

using Edit = std::function<void(DcmDataset&)>;
Q_DECLARE_METATYPE(Edit)

class TestFramePlaces : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void nuclearSlicesAreStacked_data();
  void nuclearSlicesAreStacked();
  void gatedSlicesLieAtTheirPlaces();
  void projectionsAreNoVolume();
  void dosesLieByTheirOffsets_data();
  void dosesLieByTheirOffsets();
  void ultrasoundVolumesHaveNoPatient();
  void pixelMeasuresLieInThePatient_data();
  void pixelMeasuresLieInThePatient();
};

namespace {

void text(DcmItem& d, const DcmTagKey& tag, const char* value) { d.putAndInsertString(tag, value); }

void words(DcmItem& d, const DcmTagKey& tag, const std::vector<Uint16>& values) {
  d.putAndInsertUint16Array(tag, values.data(), values.size());
}

/// Returns frames of nuclear medicine. Frame n has value n, and the first slice is at 1, 2, 3.
DicomPicture nuclear(int frames, const char* distance, const Edit& edit) {
  DicomPicture p;
  p.orientation = "";
  p.spacing = "2\\2";
  p.edit = [=](DcmDataset& d) {
    makeFrames(d, frames);
    d.findAndDeleteElement(DCM_ImagePositionPatient);
    text(d, DCM_Modality, "NM");
    text(d, DCM_ImageType, "ORIGINAL\\PRIMARY\\RECON TOMO\\EMISSION");
    text(d, DCM_SliceThickness, "5");
    if (*distance) text(d, DCM_SpacingBetweenSlices, distance);
    DcmItem* detector = nullptr;
    d.findOrCreateSequenceItem(DCM_DetectorInformationSequence, detector);
    text(*detector, DCM_ImagePositionPatient, "1\\2\\3");
    text(*detector, DCM_ImageOrientationPatient, "1\\0\\0\\0\\1\\0");
    edit(d);
  };
  return p;
}

}  // namespace

void TestFramePlaces::nuclearSlicesAreStacked_data() {
  QTest::addColumn<QByteArray>("distance");
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<QList<float>>("values");
  QTest::addColumn<double>("first");    // z of the first slice; NaN if not calibrated
  QTest::addColumn<double>("spacing");  // along z
  QTest::addColumn<QByteArray>("warning");
  const auto row = [](const char* name, const char* distance, const Edit& edit, const QList<float>& values,
                      double first, double spacing, const char* warning) {
    QTest::newRow(name) << QByteArray(distance) << edit << values << first << spacing << QByteArray(warning);
  };
  const auto vector = [](std::vector<Uint16> numbers) {
    return [numbers](DcmDataset& d) { words(d, DCM_SliceVector, numbers); };
  };
  const QList<float> up{0, 1, 2, 3}, down{3, 2, 1, 0};
  row("upwards", "4", vector({1, 2, 3, 4}), up, 3, 4, "");
  row("downwards", "-4", vector({1, 2, 3, 4}), down, 3 - 12, 4, "");
  row("in any order", "4", vector({3, 1, 4, 2}), {1, 3, 0, 2}, 3, 4, "");
  row("backwards and downwards", "-4", vector({4, 3, 2, 1}), up, 3 - 12, 4, "");
  row(
      "without the vector, one frame a slice", "-4",
      [](DcmDataset& d) { d.putAndInsertUint16(DCM_NumberOfSlices, 4); }, down, 3 - 12, 4, "");
  row("without a distance: the thickness", "", vector({1, 2, 3, 4}), up, 3, 5,
      "SpacingBetweenSlices is missing");
  row(
      "directions of the data set itself", "4",
      [vector](DcmDataset& d) {
        vector({1, 2, 3, 4})(d);
        d.findAndDeleteElement(DCM_DetectorInformationSequence);
        text(d, DCM_ImagePositionPatient, "1\\2\\3");
        text(d, DCM_ImageOrientationPatient, "1\\0\\0\\0\\1\\0");
      },
      up, 3, 4, "");
  row(
      "without directions", "4",
      [vector](DcmDataset& d) {
        vector({1, 2, 4, 3})(d);
        d.findAndDeleteElement(DCM_DetectorInformationSequence);
      },
      {0, 1, 3, 2}, std::nan(""), 1, "stacked by their number");
}

void TestFramePlaces::nuclearSlicesAreStacked() {
  QFETCH(QByteArray, distance);
  QFETCH(Edit, edit);
  QFETCH(QList<float>, values);
  QFETCH(double, first);
  QFETCH(double, spacing);
  QFETCH(QByteArray, warning);
  const DicomFolder folder;
  folder.add("nm", nuclear(4, distance.constData(), edit));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const Series& series = study.volumes[0];
  QCOMPARE(series.acquired.calibrated, !std::isnan(first));
  if (!std::isnan(first)) QCOMPARE(series.acquired.origin, glm::dvec3(1, 2, first));
  QCOMPARE(series.acquired.spacing().z, spacing);
  if (!warning.isEmpty()) QVERIFY(warns(series.warnings, warning.toStdString()));
  if (warning.isEmpty()) QVERIFY(series.warnings.empty());
  const auto loaded = loadSeries(series);
  QVERIFY(loaded.ok());
  const std::vector<float> found = firstOfEachSlice(*loaded->acquired);
  QCOMPARE(QList<float>(found.begin(), found.end()), values);
}

// Two time slots have three slices each, so that each position holds two frames.
void TestFramePlaces::gatedSlicesLieAtTheirPlaces() {
  const DicomFolder folder;
  folder.add("nm", nuclear(6, "-4", [](DcmDataset& d) {
               text(d, DCM_ImageType, "ORIGINAL\\PRIMARY\\RECON GATED TOMO\\EMISSION");
               words(d, DCM_RRIntervalVector, {1, 1, 1, 1, 1, 1});
               words(d, DCM_TimeSlotVector, {1, 1, 1, 2, 2, 2});
               words(d, DCM_SliceVector, {1, 2, 3, 1, 2, 3});
             }));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(2));
  for (std::size_t slot = 0; slot < 2; ++slot) {
    QCOMPARE(study.volumes[slot].acquired.origin, glm::dvec3(1, 2, -5));
    const auto loaded = loadSeries(study.volumes[slot]);
    QVERIFY(loaded.ok());
    const float last = slot ? 5 : 2;
    QCOMPARE(firstOfEachSlice(*loaded->acquired), (std::vector<float>{last, last - 1, last - 2}));
  }
}

void TestFramePlaces::projectionsAreNoVolume() {
  const DicomFolder folder;
  folder.add("nm", nuclear(4, "", [](DcmDataset& d) {
               text(d, DCM_ImageType, "ORIGINAL\\PRIMARY\\TOMO\\EMISSION");
               words(d, DCM_AngularViewVector, {1, 2, 3, 4});
             }));
  const Study study = folder.open();
  QVERIFY(study.volumes.empty());
  QCOMPARE(study.images.size(), std::size_t(1));
}

void TestFramePlaces::dosesLieByTheirOffsets_data() {
  QTest::addColumn<QByteArray>("offsets");
  QTest::addColumn<QByteArray>("orientation");
  QTest::addColumn<QByteArray>("position");
  QTest::addColumn<QList<float>>("values");  // along the slice axis; empty if not a volume
  QTest::addColumn<double>("z");             // z of the first slice
  const auto row = [](const char* name, const char* offsets, const char* orientation, const char* position,
                      const QList<float>& values, double z) {
    QTest::newRow(name) << QByteArray(offsets) << QByteArray(orientation) << QByteArray(position) << values
                        << z;
  };
  const char *axial = "1\\0\\0\\0\\1\\0", *below = "1\\0\\0\\0\\-1\\0", *coronal = "1\\0\\0\\0\\0\\-1";
  const QList<float> forward{0, 1, 2}, backward{2, 1, 0};
  row("relative", "0\\3\\6", axial, "1\\2\\-40", forward, -40);
  row("absolute", "-40\\-37\\-34", axial, "1\\2\\-40", forward, -40);
  row("absolute, downwards", "-34\\-37\\-40", axial, "1\\2\\-34", backward, -40);
  row("absolute, rows upside down", "-40\\-37\\-34", below, "1\\2\\-40", backward, -34);
  row("relative, z is 0", "0\\3\\6", axial, "1\\2\\0", forward, 0);
  row("relative, coronal", "0\\3\\6", coronal, "1\\2\\-40", forward, -40);
  row("absolute, but coronal", "-40\\-37\\-34", coronal, "1\\2\\-40", {}, 0);
  row("neither", "7\\10\\13", axial, "1\\2\\-40", {}, 0);
}

void TestFramePlaces::dosesLieByTheirOffsets() {
  QFETCH(QByteArray, offsets);
  QFETCH(QByteArray, orientation);
  QFETCH(QByteArray, position);
  QFETCH(QList<float>, values);
  QFETCH(double, z);
  const DicomFolder folder;
  DicomPicture p;
  p.orientation = orientation.toStdString();
  p.edit = [&](DcmDataset& d) {
    makeFrames(d, 3);
    text(d, DCM_Modality, "RTDOSE");
    text(d, DCM_ImagePositionPatient, position.constData());
    text(d, DCM_GridFrameOffsetVector, offsets.constData());
  };
  folder.add("dose", p);
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(values.isEmpty() ? 0 : 1));
  if (values.isEmpty()) return;
  const auto loaded = loadSeries(study.volumes[0]);
  QVERIFY(loaded.ok());
  QCOMPARE(loaded->acquired->geometry().origin.z, z);
  QCOMPARE(loaded->acquired->geometry().spacing().z, 3.0);
  const std::vector<float> found = firstOfEachSlice(*loaded->acquired);
  QCOMPARE(QList<float>(found.begin(), found.end()), values);
}

// The geometry is in mm, but not in patient space.
void TestFramePlaces::ultrasoundVolumesHaveNoPatient() {
  const DicomFolder folder;
  DicomPicture p;
  p.orientation = p.spacing = "";
  p.edit = [](DcmDataset& d) {
    makeFrames(d, 3);
    d.findAndDeleteElement(DCM_ImagePositionPatient);
    text(d, DCM_Modality, "US");
    const std::array<Float64, 6> directions{1, 0, 0, 0, 1, 0};
    group(d, -1, DCM_PlaneOrientationVolumeSequence)
        .putAndInsertFloat64Array(DCM_ImageOrientationVolume, directions.data(), 6);
    text(group(d, -1, DCM_PixelMeasuresSequence), DCM_PixelSpacing, "0.3\\0.25");
    for (int n = 0; n < 3; ++n) {
      const std::array<Float64, 3> place{0, 0, 2.0 - n};
      group(d, n, DCM_PlanePositionVolumeSequence)
          .putAndInsertFloat64Array(DCM_ImagePositionVolume, place.data(), 3);
    }
  };
  folder.add("us", p);
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const Series& series = study.volumes[0];
  QCOMPARE(series.acquired.spacing(), glm::dvec3(0.25, 0.3, 1));
  QVERIFY(std::ranges::any_of(series.warnings,
                              [](const Warning& w) { return w.kind == WarningKind::noDirections; }));
  const auto frame = loadFrame(series, 0);
  QVERIFY(frame.ok());
  QVERIFY(!frame->place);
  QCOMPARE(frame->pixel, (PixelSize{{0.25, 0.3}, PixelSizeKind::patient}));
}

void TestFramePlaces::pixelMeasuresLieInThePatient_data() {
  QTest::addColumn<bool>("inGroup");
  QTest::addColumn<QByteArray>("factor");
  QTest::addColumn<int>("kind");
  QTest::addColumn<double>("mm");
  QTest::newRow("tomosynthesis") << true << QByteArray() << int(PixelSizeKind::patient) << 0.1;
  QTest::newRow("with a factor") << true << QByteArray("1.06") << int(PixelSizeKind::patient) << 0.1;
  QTest::newRow("a projection") << false << QByteArray() << int(PixelSizeKind::atDetector) << 0.1;
  QTest::newRow("a projection with a factor")
      << false << QByteArray("1.25") << int(PixelSizeKind::magnified) << 0.08;
}

void TestFramePlaces::pixelMeasuresLieInThePatient() {
  QFETCH(bool, inGroup);
  QFETCH(QByteArray, factor);
  QFETCH(int, kind);
  QFETCH(double, mm);
  const DicomFolder folder;
  DicomPicture p;
  p.spacing = inGroup ? "" : "0.1\\0.1";
  p.edit = [&](DcmDataset& d) {
    text(d, DCM_Modality, "MG");
    if (!factor.isEmpty()) text(d, DCM_EstimatedRadiographicMagnificationFactor, factor.constData());
    if (inGroup) text(group(d, -1, DCM_PixelMeasuresSequence), DCM_PixelSpacing, "0.1\\0.1");
  };
  folder.add("mg", p);
  const auto frame = frameOf(folder.path("mg"));
  QVERIFY2(frame.ok(), frame.ok() ? "" : frame.message().c_str());
  QCOMPARE(int(frame->pixel.kind), kind);
  QVERIFY(std::abs(frame->pixel.mm.x - mm) < 1e-12);
}

VOLUMEN_TEST(TestFramePlaces);
#include "tst_frame_places.moc"
