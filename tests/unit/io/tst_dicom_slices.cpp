// Guards design.md 7 and 10 (rescale, padding, frames of one file, slices that cannot be read).
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>

#include "io/load.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/io/dicom_frames.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestDicomSlices : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void differentRescaleBecomesFloat();
  void paddingAndWindowsAreKept();
  void windowsAreThoseOfTheMedianSlice_data();
  void windowsAreThoseOfTheMedianSlice();
  void framesOfAnEnhancedPictureAreSlices();
  void framesOfADoseAreSlices();
  void framesWithoutPlaceAreAnImage();
  void badSliceCostsOnlyItself_data();
  void badSliceCostsOnlyItself();
};
void TestDicomSlices::differentRescaleBecomesFloat() {
  const DicomFolder folder;
  const char* slopes[] = {"0.5", "0.25", "0.5"};
  for (int n = 0; n < 3; ++n) {
    DicomPicture p = sliceAt(n, 10 + n);
    p.edit = [&](DcmDataset& data) {
      data.putAndInsertString(DCM_RescaleSlope, slopes[n]);
      data.putAndInsertString(DCM_RescaleIntercept, "-3");
    };
    folder.add(numbered("s", n), p);
  }
  const Study study = folder.open();
  QCOMPARE(study.volumes[0].valueType, std::string("float32"));
  const auto loaded = loadSeries(study.volumes[0]);
  QVERIFY(loaded.ok());
  QCOMPARE(std::string(loaded->acquired->typeName()), std::string("float32"));
  QCOMPARE(firstOfEachSlice(*loaded->acquired), (std::vector<float>{2, -0.25, 3}));
}

void TestDicomSlices::paddingAndWindowsAreKept() {
  const DicomFolder folder;
  DicomPicture p = sliceAt(0, 10);
  p.isSigned = true;
  p.edit = [](DcmDataset& data) {
    data.putAndInsertSint16(DCM_PixelPaddingValue, -2000);
    data.putAndInsertString(DCM_RescaleSlope, "1");
    data.putAndInsertString(DCM_RescaleIntercept, "-1024");
    data.putAndInsertString(DCM_WindowCenter, "40\\300");
    data.putAndInsertString(DCM_WindowWidth, "400\\1500");
  };
  folder.add("only", p);
  const Study study = folder.open();
  const auto loaded = loadSeries(study.volumes.at(0));
  QVERIFY(loaded.ok());
  const VolumeAttributes& a = loaded->acquired->attributes();
  QVERIFY(a.padding == (ValueRange{-3024, -3024}));
  QVERIFY(a.windows == (std::vector<Window>{{40, 400}, {300, 1500}}));
  QCOMPARE(a.modality, std::string("CT"));
  QCOMPARE(loaded->acquired->value(0, 0, 0), -1014.f);
}

void TestDicomSlices::windowsAreThoseOfTheMedianSlice_data() {
  QTest::addColumn<QStringList>("windows");  // width and centre of each slice
  QTest::addColumn<double>("width");
  QTest::addColumn<double>("centre");
  const auto row = [](const char* name, const char* windows, double width, double centre) {
    QTest::newRow(name) << QString::fromLatin1(windows).split(QLatin1Char(' ')) << width << centre;
  };
  row("the middle one is odd", "307/153 307/153 6020/3010 307/153 307/153", 307, 153);
  row("each its own", "98/38 400/200 1164/588 300/150 200/90", 300, 150);
  row("one width", "400/40 400/60 400/50", 400, 50);
  row("the first ones have none", "- - 300/100", 300, 100);
  row("none has", "- - -", 0, 0);
}

void TestDicomSlices::windowsAreThoseOfTheMedianSlice() {
  QFETCH(QStringList, windows);
  QFETCH(double, width);
  QFETCH(double, centre);
  const DicomFolder folder;
  for (int n = 0; n < windows.size(); ++n) {
    DicomPicture p = sliceAt(n, 10);
    const QByteArray both = windows[n].toLatin1();
    p.isSigned = true;
    p.edit = [both](DcmDataset& data) {
      if (both == "-") return;
      data.putAndInsertString(DCM_WindowWidth, both.left(both.indexOf('/')).constData());
      data.putAndInsertString(DCM_WindowCenter, both.mid(both.indexOf('/') + 1).constData());
    };
    folder.add(numbered("s", n), p);
  }
  const auto loaded = loadSeries(folder.open().volumes.at(0));
  QVERIFY(loaded.ok());
  const std::vector<Window>& found = loaded->acquired->attributes().windows;
  QVERIFY(found == (width > 0 ? std::vector<Window>{{centre, width}} : std::vector<Window>{}));
}

void TestDicomSlices::framesOfAnEnhancedPictureAreSlices() {
  const DicomFolder folder;
  DicomPicture p;
  p.orientation = p.spacing = "";
  p.edit = [](DcmDataset& data) {
    makeFrames(data, 6);
    data.findAndDeleteElement(DCM_ImagePositionPatient);
    group(data, -1, DCM_PlaneOrientationSequence)
        .putAndInsertString(DCM_ImageOrientationPatient, "1\\0\\0\\0\\1\\0");
    group(data, -1, DCM_PixelMeasuresSequence).putAndInsertString(DCM_PixelSpacing, "0.5\\0.7");
    // Three positions from top to bottom hold two time points each.
    for (int n = 0; n < 6; ++n) {
      const QByteArray place = QByteArray("0\\0\\") + QByteArray::number(4 - 2 * (n / 2));
      group(data, n, DCM_PlanePositionSequence)
          .putAndInsertString(DCM_ImagePositionPatient, place.constData());
      group(data, n, DCM_FrameContentSequence)
          .putAndInsertUint32(DCM_TemporalPositionIndex, Uint32(1 + n % 2));
      DcmItem& rescale = group(data, n, DCM_PixelValueTransformationSequence);
      rescale.putAndInsertString(DCM_RescaleSlope, n % 2 ? "10" : "1");
      rescale.putAndInsertString(DCM_RescaleIntercept, "0");
    }
  };
  folder.add("enhanced", p);
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(2));
  const std::vector<float> expected[] = {{4, 2, 0}, {50, 30, 10}};
  for (std::size_t t = 0; t < 2; ++t) {
    QCOMPARE(study.volumes[t].acquired.spacing(), glm::dvec3(0.7, 0.5, 2));
    QCOMPARE(study.volumes[t].acquired.origin, glm::dvec3(0));
    const auto loaded = loadSeries(study.volumes[t]);
    QVERIFY(loaded.ok());
    QCOMPARE(firstOfEachSlice(*loaded->acquired), expected[t]);
  }
}

void TestDicomSlices::framesOfADoseAreSlices() {
  const DicomFolder folder;
  DicomPicture p = sliceAt(5, 0);
  p.edit = [](DcmDataset& data) {
    makeFrames(data, 3);
    data.putAndInsertString(DCM_GridFrameOffsetVector, "0\\3\\6");
    data.putAndInsertString(DCM_DoseGridScaling, "0.25");
  };
  folder.add("dose", p);
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(1));
  QCOMPARE(study.volumes[0].acquired.origin, glm::dvec3(10, 20, 5));
  QCOMPARE(study.volumes[0].acquired.spacing().z, 3.0);
  const auto loaded = loadSeries(study.volumes[0]);
  QVERIFY(loaded.ok());
  QCOMPARE(firstOfEachSlice(*loaded->acquired), (std::vector<float>{0, 0.25, 0.5}));
}

void TestDicomSlices::framesWithoutPlaceAreAnImage() {
  const DicomFolder folder;
  DicomPicture p = sliceAt(5, 0);
  p.edit = [](DcmDataset& data) { makeFrames(data, 3); };
  folder.add("cine", p);
  const Study study = folder.open();
  QVERIFY(study.volumes.empty());
  QVERIFY(study.refused.empty());
  QCOMPARE(study.images.at(0).notVolume,
           std::string("several frames without a position each: cannot be shown in 3D."));
  QCOMPARE(study.images[0].frames, 3);
}

void TestDicomSlices::badSliceCostsOnlyItself_data() {
  QTest::addColumn<QString>("damage");
  QTest::addColumn<bool>("seenAtOpening");
  QTest::newRow("native data cut off") << QStringLiteral("native") << true;
  QTest::newRow("fragment cut off") << QStringLiteral("fragment") << true;
  QTest::newRow("code stream damaged") << QStringLiteral("stream") << false;
}

void TestDicomSlices::badSliceCostsOnlyItself() {
  QFETCH(QString, damage);
  QFETCH(bool, seenAtOpening);
  const char* syntax = damage == QLatin1String("native") ? "1.2.840.10008.1.2.1" : "1.2.840.10008.1.2.4.70";
  const DicomFolder folder;
  for (int n = 0; n < 5; ++n) folder.add(numbered("s", n), sliceAt(n, 100 * n), syntax);
  std::vector<std::uint8_t> bytes = readAll(folder.path("s2"));
  if (damage == QLatin1String("stream")) {
    const std::vector<std::uint8_t> soi{0xff, 0xd8, 0xff};
    *(std::search(bytes.begin(), bytes.end(), soi.begin(), soi.end()) + 1) = 0;
  } else {
    bytes.resize(bytes.size() - 12);
  }
  writeAll(folder.path("s2"), bytes);
  const Study study = folder.open();
  QCOMPARE(study.refused.size(), std::size_t(seenAtOpening ? 1 : 0));
  QCOMPARE(study.volumes.size(), std::size_t(1));
  const auto loaded = loadSeries(study.volumes[0]);
  QVERIFY(loaded.ok());
  QCOMPARE(firstOfEachSlice(*loaded->acquired), (std::vector<float>{0, 100, 300, 400}));
  QCOMPARE(firstOfEachSlice(*loaded->drawn), (std::vector<float>{0, 100, 200, 300, 400}));
  QVERIFY(warns(loaded->warnings, "Slice s2 could not be read and was interpolated: "));
  QVERIFY(!warns(loaded->warnings, "missing"));
  QCOMPARE(loaded->unread.size(), std::size_t(1));
  QCOMPARE(loaded->unread[0].path, folder.path("s2"));
  QCOMPARE(loaded->interpolatedSlices(), 1);
}

VOLUMEN_TEST(TestDicomSlices);
#include "tst_dicom_slices.moc"
