// Guards design.md 7 and 10 (series by geometry, uneven slices, shear, single slice, uncalibrated pictures).
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>

#include "io/load.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestDicomSeries : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void slicesAreOrderedByPlaceNotByName();
  void regularGridOfUnevenSlices_data();
  void regularGridOfUnevenSlices();
  void jitterIsRegular_data();
  void jitterIsRegular();
  void largeGapsSplit_data();
  void largeGapsSplit();
  void shearIsKept();
  void copiesAreLeftOut();
  void otherValuesAreNoCopy();
  void echoTimesAreNumbers();
  void anEmptyElementInFrontIsPassedOver();
  void picturesOfOnePlaceAreSplit_data();
  void picturesOfOnePlaceAreSplit();
  void orientationsAreSplit();
  void withoutPlaceItIsNotCalibrated_data();
  void withoutPlaceItIsNotCalibrated();
  void singleSliceHasItsThickness_data();
  void singleSliceHasItsThickness();
};

void TestDicomSeries::slicesAreOrderedByPlaceNotByName() {
  const DicomFolder folder;
  folder.addStack({0, 2, 4, 6, 8});
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const Series& s = study.volumes[0];
  QCOMPARE(s.id, std::string("1.2.3.4.5"));
  QCOMPARE(s.acquired.size, glm::ivec3(4, 3, 5));
  QCOMPARE(s.acquired.spacing(), glm::dvec3(0.7, 0.5, 2));  // PixelSpacing names rows first
  QCOMPARE(s.acquired.origin, glm::dvec3(10, 20, 0));
  QVERIFY(!s.regular && s.warnings.empty());
  const auto loaded = loadSeries(s);
  QVERIFY(loaded.ok());
  QCOMPARE(firstOfEachSlice(*loaded->acquired), (std::vector<float>{0, 200, 400, 600, 800}));
  QVERIFY(loaded->drawn == loaded->acquired);
}

void TestDicomSeries::regularGridOfUnevenSlices_data() {
  QTest::addColumn<QList<double>>("z");
  QTest::addColumn<int>("slices");
  QTest::addColumn<int>("interpolated");
  QTest::addColumn<double>("step");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* name, QList<double> z, int slices, int interpolated, double step,
                      const char* says) {
    QTest::newRow(name) << z << slices << interpolated << step << QString::fromLatin1(says);
  };
  row("one slice missing", {0, 1, 2, 4, 5}, 6, 1, 1.0, "A slice is missing between ");
  row("two slices missing at two places", {0, 2, 6, 8, 12, 14, 16}, 9, 2, 2.0,
      "2 slices are missing, the most between ");
  row("two distances", {0, 1, 2, 3, 4.5, 6}, 7, 2, 1.0, "Uneven slice spacing (1 to 1.5 mm, ");
  row("a slice within 1 % is a copy", {0, 1, 2, 3.009, 4, 6}, 7, 1, 1.0,
      " (2 mm instead of 1); it was interpolated.");
  row("the end lies beyond the grid", {0, 1, 2, 3, 4.5}, 5, 1, 1.0,
      "): 1 of the 5 slices shown in 3D is interpolated. The last 0.5 mm are not shown in 3D.");
}

void TestDicomSeries::regularGridOfUnevenSlices() {
  QFETCH(QList<double>, z);
  QFETCH(int, slices);
  QFETCH(int, interpolated);
  QFETCH(double, step);
  QFETCH(QString, says);
  const DicomFolder folder;
  folder.addStack(std::vector<double>(z.begin(), z.end()));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const Series& s = study.volumes[0];
  QVERIFY(s.regular);
  QCOMPARE(s.regular->geometry.size.z, slices);
  QCOMPARE(s.regular->interpolatedSlices, interpolated);
  QVERIFY(std::abs(s.regular->geometry.spacing().z - step) < 1e-9);
  QVERIFY(std::abs(s.acquired.spacing().z - (z.back() - z.front()) / double(z.size() - 1)) < 1e-9);
  QVERIFY2(warns(s.warnings, says.toStdString()), s.warnings[0].sentence.c_str());
  QVERIFY(warns(s.warnings, "s10"));  // file names
  const auto loaded = loadSeries(s);
  QVERIFY(loaded.ok());
  QCOMPARE(loaded->acquired->size().z, int(z.size()));
  QCOMPARE(loaded->drawn->geometry(), s.regular->geometry);
  const std::vector<float> values = firstOfEachSlice(*loaded->drawn);
  // The value is 100 z, which linear interpolation preserves. A copied slice is up to 1 % of a step away.
  for (int k = 0; k < slices; ++k) QVERIFY(std::abs(values[std::size_t(k)] - 100 * step * k) <= 1.0);
  // Acquired slices on the grid are exact.
  for (double place : z)
    if (std::abs(place / step - std::round(place / step)) < 0.01 && place <= step * (slices - 1))
      QCOMPARE(values[std::size_t(std::lround(place / step))], float(int(100 * place)));
}

void TestDicomSeries::jitterIsRegular_data() {
  QTest::addColumn<double>("distance");
  QTest::addColumn<QList<double>>("off");  // offset of each slice, mm
  QTest::addColumn<int>("missing");
  QTest::addColumn<int>("interpolated");  // -1 if the slices are used as they are
  const auto pattern = [](double a) { return QList<double>{a, -a, -a, a, a, -a, -a, a}; };
  QList<double> first(20, 0.0), middle(20, 0.0), drift;
  first[0] = middle[9] = 0.08;
  for (int n = 0; n < 20; ++n) drift << (n < 10 ? 0 : 0.06 * (n - 10));
  QTest::newRow("0.06 mm in 7 mm") << 7.0 << pattern(0.06) << -1 << -1;
  QTest::newRow("below 0.1 mm in 7 mm") << 7.0 << pattern(0.099) << -1 << -1;
  QTest::newRow("0.1 mm in 7 mm") << 7.0 << pattern(0.1) << -1 << -1;
  QTest::newRow("above 0.1 mm in 7 mm") << 7.0 << pattern(0.102) << -1 << 4;
  QTest::newRow("below 2 % of 1 mm") << 1.0 << pattern(0.019) << -1 << -1;
  QTest::newRow("2 % of 1 mm") << 1.0 << pattern(0.02) << -1 << -1;
  QTest::newRow("above 2 % of 1 mm") << 1.0 << pattern(0.022) << -1 << 4;
  QTest::newRow("the first of 20 off") << 7.0 << first << -1 << -1;
  QTest::newRow("one in the middle off") << 7.0 << middle << -1 << -1;
  QTest::newRow("steps that differ by 0.06 mm but add up") << 7.0 << drift << -1 << 8;
  QTest::newRow("one slice missing") << 7.0 << pattern(0.06) << 3 << 1;
}

// Within both 2 % of the slice distance and 0.1 mm, slices count as regular.
void TestDicomSeries::jitterIsRegular() {
  QFETCH(double, distance);
  QFETCH(QList<double>, off);
  QFETCH(int, missing);
  QFETCH(int, interpolated);
  const DicomFolder folder;
  for (int n = 0; n < off.size(); ++n)
    if (n != missing)
      folder.add(tests::numbered("s", 100 + n), sliceAt(distance * (n + 1) + off[n], 10 * (n + 1)));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const Series& s = study.volumes[0];
  const QByteArray said =
      s.warnings.empty() ? QByteArray() : QByteArray::fromStdString(s.warnings[0].sentence);
  QVERIFY2(bool(s.regular) == (interpolated >= 0), said);
  QCOMPARE(s.warnings.empty(), interpolated < 0);
  if (!s.regular) return;
  QCOMPARE(s.regular->interpolatedSlices, interpolated);
  if (missing < 0) return;
  const auto loaded = loadSeries(s);
  QVERIFY(loaded.ok());
  // All present slices are exact. The missing one lies between its neighbours.
  for (int n = 0; n < off.size(); ++n)
    if (n != missing) QCOMPARE(loaded->drawn->value(0, 0, n), float(10 * (n + 1)));
  QVERIFY(std::abs(loaded->drawn->value(0, 0, missing) - 10 * (missing + 1)) < 0.5);
}

void TestDicomSeries::largeGapsSplit_data() {
  QTest::addColumn<QList<double>>("z");
  QTest::addColumn<int>("volumes");
  QTest::newRow("more than 4 usual distances") << QList<double>{0, 1, 2, 3, 7.5, 8.5, 9.5} << 2;
  QTest::newRow("not more than 4") << QList<double>{0, 1, 2, 3, 7, 8, 9} << 1;
  QTest::newRow("20 mm beyond the usual one") << QList<double>{0, 8, 16, 24, 53, 61} << 2;
  QTest::newRow("even slices 25 mm apart") << QList<double>{0, 25, 50, 75} << 1;
}

void TestDicomSeries::largeGapsSplit() {
  QFETCH(QList<double>, z);
  QFETCH(int, volumes);
  const DicomFolder folder;
  folder.addStack(std::vector<double>(z.begin(), z.end()));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(volumes));
  if (volumes == 1) return;
  QCOMPARE(study.volumes[0].id, std::string("1.2.3.4.5#1"));
  QCOMPARE(study.volumes[1].id, std::string("1.2.3.4.5#2"));
  for (const Series& s : study.volumes) QVERIFY(warns(s.warnings, "Gap of "));
}

void TestDicomSeries::shearIsKept() {
  const DicomFolder folder;
  for (int n = 0; n < 4; ++n) {
    DicomPicture p = sliceAt(2.0 * n, n);
    p.position.y += 0.5 * n;
    folder.add(numbered("s", n), p);
  }
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const Series& s = study.volumes[0];
  QVERIFY(glm::length(s.acquired.patientFromVoxelStep[2] - glm::dvec3(0, 0.5, 2)) < 1e-12);
  QVERIFY(warns(s.warnings, "Gantry tilt of 14.0 degrees, corrected in 3D."));  // atan(0.5 / 2)
  QVERIFY(!s.regular);
}

void TestDicomSeries::copiesAreLeftOut() {
  const DicomFolder folder;
  folder.addStack({0, 1, 2});
  std::filesystem::create_directory(folder.path("deeper"));
  std::filesystem::copy_file(folder.path("s100"), folder.path("deeper/copy"));
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(study.volumes[0].acquired.size.z, 3);
  QVERIFY(warns(study.volumes[0].warnings, "copy"));
}

// One of them was rescaled by another program.
void TestDicomSeries::otherValuesAreNoCopy() {
  const DicomFolder folder;
  for (const char* slope : {"1", "2"}) {
    DicomPicture picture = sliceAt(0, 7);
    picture.edit = [slope](DcmDataset& data) {
      data.putAndInsertString(DCM_SOPInstanceUID, "1.2.3.4");
      data.putAndInsertString(DCM_RescaleSlope, slope);
      data.putAndInsertString(DCM_RescaleIntercept, "0");
    };
    folder.add(std::string("slope") + slope, picture);
  }
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(2));
  for (const Series& series : study.volumes) QVERIFY(!warns(series.warnings, "copy"));
}

// The same number with other digits is the same echo.
void TestDicomSeries::echoTimesAreNumbers() {
  const DicomFolder folder;
  const char* times[] = {"22", "22.0000", "22.0", "+22"};
  for (int n = 0; n < 4; ++n) {
    DicomPicture picture = sliceAt(n, n);
    picture.edit = [&](DcmDataset& data) { data.putAndInsertString(DCM_EchoTime, times[n]); };
    folder.add(numbered("s", n), picture);
  }
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(study.volumes[0].acquired.size.z, 4);
  QCOMPARE(study.volumes[0].echoTime, std::string("22"));
}

// pydicom writes such a file if zeros followed the last element of the original.
void TestDicomSeries::anEmptyElementInFrontIsPassedOver() {
  const DicomFolder folder;
  folder.add("a", sliceAt(0, 7));
  std::vector<std::uint8_t> bytes = readAll(folder.path("a"));
  const std::size_t meta = bytes[140] + 256u * bytes[141];  // (0002,0000), the length of all after it
  bytes.insert(bytes.begin() + std::ptrdiff_t(144 + meta), 8, 0);
  writeAll(folder.path("a"), bytes);
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(firstOfEachSlice(*loadSeries(study.volumes[0])->acquired), (std::vector<float>{7}));
}

void TestDicomSeries::picturesOfOnePlaceAreSplit_data() {
  QTest::addColumn<QString>("by");
  for (const char* by : {"instance", "time point", "echo", "image type"})
    QTest::newRow(by) << QString::fromLatin1(by);
}

void TestDicomSeries::picturesOfOnePlaceAreSplit() {
  QFETCH(QString, by);
  const DicomFolder folder;
  for (int z = 0; z < 3; ++z) {
    for (int t = 0; t < 2; ++t) {
      DicomPicture p = sliceAt(z, 10 * t + z);
      // By instance, all of the first volume precedes the second. Otherwise the attribute must win over the
      // numbers.
      p.instance = by == QLatin1String("instance") ? 10 * t + z : 10 * z + (z == 1 ? 1 - t : t);
      p.edit = [by, t](DcmDataset& data) {
        if (by == QLatin1String("time point"))
          data.putAndInsertString(DCM_TemporalPositionIdentifier, t ? "2" : "1");
        if (by == QLatin1String("echo")) data.putAndInsertString(DCM_EchoTime, t ? "40" : "20");
        if (by == QLatin1String("image type"))
          data.putAndInsertString(DCM_ImageType, t ? "ORIGINAL\\PRIMARY\\P" : "ORIGINAL\\PRIMARY\\M");
      };
      folder.add(numbered("s", 10 * z + t), p);
    }
  }
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(2));
  for (std::size_t t = 0; t < 2; ++t) {
    QCOMPARE(study.volumes[t].id, numbered("1.2.3.4.5#", int(t) + 1));
    const auto loaded = loadSeries(study.volumes[t]);
    QVERIFY(loaded.ok());
    const float first = 10 * float(t);
    QCOMPARE(firstOfEachSlice(*loaded->acquired), (std::vector<float>{first, first + 1, first + 2}));
  }
}

void TestDicomSeries::orientationsAreSplit() {
  const DicomFolder folder;
  for (int n = 0; n < 3; ++n) {
    folder.add(numbered("a", n), sliceAt(n, n));
    DicomPicture sagittal = sliceAt(0, n);
    sagittal.position = {double(n), 0, 0};
    sagittal.orientation = "0\\1\\0\\0\\0\\-1";
    folder.add(numbered("b", n), sagittal);
  }
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(2));
  for (const Series& s : study.volumes) {
    QCOMPARE(s.acquired.size.z, 3);
    QVERIFY(s.acquired.voxelVolume() > 0 && glm::determinant(s.acquired.patientFromVoxelStep) > 0);
  }
}

void TestDicomSeries::withoutPlaceItIsNotCalibrated_data() {
  QTest::addColumn<QString>("orientation");
  QTest::addColumn<QString>("spacing");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* name, const char* orientation, const char* spacing, const char* says) {
    QTest::newRow(name) << QString::fromLatin1(orientation) << QString::fromLatin1(spacing)
                        << QString::fromLatin1(says);
  };
  row("no spacing", "1\\0\\0\\0\\1\\0", "", "PixelSpacing");
  row("negative spacing", "1\\0\\0\\0\\1\\0", "1\\-1", "PixelSpacing");
  row("no orientation", "", "1\\1", "ImageOrientationPatient");
  row("orientation at no right angle", "1\\0\\0\\0.6\\0.8\\0", "1\\1", "ImageOrientationPatient");
  row("orientation NaN", "1\\0\\0\\0\\nan\\0", "1\\1", "ImageOrientationPatient");
}

void TestDicomSeries::withoutPlaceItIsNotCalibrated() {
  QFETCH(QString, orientation);
  QFETCH(QString, spacing);
  QFETCH(QString, says);
  const DicomFolder folder;
  for (int n = 0; n < 3; ++n) {
    DicomPicture p = sliceAt(n, 500 - n);
    p.instance = n;
    p.orientation = orientation.toStdString();
    p.spacing = spacing.toStdString();
    folder.add(numbered("s", 2 - n), p);
  }
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const Series& s = study.volumes[0];
  QVERIFY(!s.acquired.calibrated);
  QCOMPARE(s.acquired.patientFromVoxelStep, glm::dmat3(1));
  QVERIFY2(warns(s.warnings, "has no valid " + says.toStdString()), s.warnings[0].sentence.c_str());
  const auto loaded = loadSeries(s);
  QVERIFY(loaded.ok());
  QCOMPARE(firstOfEachSlice(*loaded->acquired), (std::vector<float>{500, 499, 498}));  // by InstanceNumber
}

void TestDicomSeries::singleSliceHasItsThickness_data() {
  QTest::addColumn<QString>("thickness");
  QTest::addColumn<double>("mm");
  QTest::newRow("given") << QStringLiteral("3.5") << 3.5;
  QTest::newRow("missing") << QString() << 1.0;
  QTest::newRow("zero") << QStringLiteral("0") << 1.0;
}

void TestDicomSeries::singleSliceHasItsThickness() {
  QFETCH(QString, thickness);
  QFETCH(double, mm);
  const DicomFolder folder;
  DicomPicture p = sliceAt(5, 7);
  p.edit = [&](DcmDataset& data) {
    data.putAndInsertString(DCM_SliceThickness, thickness.toLatin1().constData());
  };
  folder.add("only", p);
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(study.volumes[0].acquired.spacing().z, mm);
  QCOMPARE(warns(study.volumes[0].warnings, "1 mm thick"), mm == 1.0);
}

VOLUMEN_TEST(TestDicomSeries);
#include "tst_dicom_series.moc"
