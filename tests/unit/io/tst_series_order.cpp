// Guards design.md 7: volumes of one series that several attributes separate are listed in acquisition order.
// If numbers do not show that order, values decide.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <filesystem>

#include "io/load.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSeriesOrder : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void volumesAreListedInOrder_data();
  void volumesAreListedInOrder();
  void signedPicturesAreNoCopiesOfUnsignedOnes();
  void foldersTellCopiesApart();
  void seriesOfOneNumberGoByTheirUids();
};

void TestSeriesOrder::volumesAreListedInOrder_data() {
  QTest::addColumn<QByteArrayList>("first");  // values of each volume, in the expected order
  QTest::addColumn<QByteArrayList>("second");
  QTest::addColumn<QStringList>("keywords");
  QTest::addColumn<bool>("isNumbered");
  const auto row = [](const char* name, const char* first, const char* second, const char* keywords,
                      bool isNumbered) {
    QTest::newRow(name) << QByteArray(first).split(' ') << QByteArray(second).split(' ')
                        << QString::fromLatin1(keywords).split(QLatin1Char(' ')) << isNumbered;
  };
  row("repetition and inversion times", "500 500 900 900", "100 300 100 300", "RepetitionTime InversionTime",
      true);
  row("the same without an order of numbers", "500 500 900 900", "100 300 100 300",
      "RepetitionTime InversionTime", false);
  row("gates of time frames", "1000 1000 61000 61000", "0 400 0 400", "FrameReferenceTime TriggerTime", true);
  row("the same without an order of numbers", "1000 1000 61000 61000", "0 400 0 400",
      "FrameReferenceTime TriggerTime", false);
  row("time frames of gates", "1000 61000 1000 61000", "0 0 400 400", "FrameReferenceTime TriggerTime", true);
  row("phases of time frames", "1000 1000 61000 61000", "25 75 25 75",
      "FrameReferenceTime NominalPercentageOfCardiacPhase", true);
  row("frames of several lengths", "10000 60000 10000 60000", "100000 100010 100110 100120",
      "ActualFrameDuration AcquisitionTime", true);
  row("echoes of flip angles", "3 3 15 15", "2 4 2 4", "FlipAngle EchoTime", true);
  row("sequences whose names count", "50 100 150 1000", "ir50 ir100 ir150 ir1000",
      "InversionTime SequenceName", false);
  row("sequence names alone", "A A A A", "ir_9 ir_10 ir_100 ir_1000", "ConvolutionKernel SequenceName",
      false);
  row("descriptions of phases", "A A A A", "5% 15% 50% 100%", "ConvolutionKernel SeriesDescription", false);
  row("weights in turn", "0 500 1000 500", "100000 100100 100200 100300", "DiffusionBValue AcquisitionTime",
      true);
}

// Volume n has value n. Without an order by numbers, each position counts differently.
void TestSeriesOrder::volumesAreListedInOrder() {
  QFETCH(QByteArrayList, first);
  QFETCH(QByteArrayList, second);
  QFETCH(QStringList, keywords);
  QFETCH(bool, isNumbered);
  const DicomFolder folder;
  constexpr int numbers[] = {3, 0, 2, 1};
  for (int n = 0; n < 4; ++n)
    for (int z = 0; z < 3; ++z) {
      DicomPicture p = sliceAt(2 * z, n);
      p.instance = isNumbered ? 10 * n + z : 4 * z + numbers[n];
      p.edit = [&](DcmDataset& data) {
        const auto write = [&](const QString& keyword, const QByteArray& value) {
          DcmTag tag;
          QVERIFY(DcmTag::findTagFromName(qPrintable(keyword), tag).good());
          if (tag.getEVR() == EVR_FD)
            data.putAndInsertFloat64(tag, value.toDouble());
          else if (tag.getEVR() == EVR_FL)
            data.putAndInsertFloat32(tag, value.toFloat());
          else
            data.putAndInsertString(tag, value.constData());
        };
        write(keywords[0], first[n]);
        write(keywords[1], second[n]);
      };
      folder.add(numbered("f", 10 * ((n + 2) % 4) + z), p);
    }
  const Study study = folder.open();
  QList<float> found;
  for (const Series& s : study.volumes) {
    const auto loaded = loadSeries(s);
    QVERIFY(loaded.ok());
    const std::vector<float> values = firstOfEachSlice(*loaded->acquired);
    QCOMPARE(std::ranges::count(values, values[0]), std::ptrdiff_t(3));
    found << values[0];
  }
  QCOMPARE(found, (QList<float>{0, 1, 2, 3}));
}

void TestSeriesOrder::signedPicturesAreNoCopiesOfUnsignedOnes() {
  const DicomFolder folder;
  for (const bool isSigned : {false, true}) {
    DicomPicture picture = sliceAt(0, 0xff00);
    picture.isSigned = isSigned;
    picture.edit = [](DcmDataset& data) { data.putAndInsertString(DCM_SOPInstanceUID, "1.2.3.4"); };
    picture.instance = 1;
    folder.add(isSigned ? "signed" : "unsigned", picture);
  }
  const Study study = folder.open();
  std::size_t pictures = 0;
  for (const Series& s : study.volumes) {
    QVERIFY(!warns(s.warnings, "is a copy"));
    pictures += s.files.size();
  }
  QCOMPARE(pictures + study.images.size(), std::size_t(2));
}

// Two exports of one series have new UIDs. Nothing in the files separates them.
void TestSeriesOrder::foldersTellCopiesApart() {
  const DicomFolder folder;
  for (const char* name : {"a", "b"}) {
    std::filesystem::create_directory(folder.path(name));
    for (int z = 0; z < 3; ++z) {
      DicomPicture p = sliceAt(2 * z, 100 * (name[0] == 'b') + z);
      p.instance = z + 1;
      folder.add(std::string(name) + "/" + numbered("f", z), p);
    }
  }
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(2));
  for (std::size_t n = 0; n < 2; ++n) {
    const auto loaded = loadSeries(study.volumes[n]);
    QVERIFY(loaded.ok());
    const float first = 100.f * float(n);
    QCOMPARE(firstOfEachSlice(*loaded->acquired), (std::vector<float>{first, first + 1, first + 2}));
    QVERIFY(warns(study.volumes[n].warnings, "by their folders"));
  }
}

// Some dynamic studies make a series of each time frame.
void TestSeriesOrder::seriesOfOneNumberGoByTheirUids() {
  const DicomFolder folder;
  const char* uids[] = {"1.2.9", "1.2.10", "1.2.10.5", "1.2.11", "1.2.100"};
  for (int n = 4; n >= 0; --n) {
    DicomPicture p = sliceAt(0, n);
    p.seriesUid = uids[n];
    folder.add(numbered("f", n), p);
  }
  const Study study = folder.open();
  QCOMPARE(study.volumes.size(), std::size_t(5));
  for (std::size_t n = 0; n < 5; ++n) QCOMPARE(study.volumes[n].seriesUid, std::string(uids[n]));
}

VOLUMEN_TEST(TestSeriesOrder);
#include "tst_series_order.moc"
