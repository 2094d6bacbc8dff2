// Guards import.md about what certainly belongs together and what does not: missing frames of reference and
// issuers, one UID for two pictures, adjacent blocks, days.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>

#include "io/load.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestWhoseSlices : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void framesOfReferenceThatAreNotGiven_data();
  void framesOfReferenceThatAreNotGiven();
  void anIssuerThatIsNotGivenIsTold();
  void oneUidOfTwoPictures_data();
  void oneUidOfTwoPictures();
  void blocksAreCutAtTheJump_data();
  void blocksAreCutAtTheJump();
  void timesHaveDays_data();
  void timesHaveDays();
  void echoesOfOtherKindsAreCalledByThem_data();
  void echoesOfOtherKindsAreCalledByThem();
};

namespace {

using Numbers = QList<int>;

void text(DcmItem& d, const DcmTagKey& tag, const QByteArray& value) {
  d.putAndInsertString(tag, value.constData());
}

/// Returns the number of slices of each volume.
Numbers sizesOf(const Study& study) {
  Numbers sizes;
  for (const Series& s : study.volumes) sizes << s.acquired.size.z;
  return sizes;
}

}  // namespace

void TestWhoseSlices::framesOfReferenceThatAreNotGiven_data() {
  QTest::addColumn<QList<double>>("named");
  QTest::addColumn<QList<double>>("unnamed");
  QTest::addColumn<Numbers>("sizes");
  QTest::newRow("all are named") << QList<double>{0, 1, 2, 3} << QList<double>{} << Numbers{4};
  QTest::newRow("none is named") << QList<double>{} << QList<double>{0, 1, 2, 3} << Numbers{4};
  QTest::newRow("one stack in the other")
      << QList<double>{0, 1, 2, 3} << QList<double>{.5, 1.5, 2.5, 3.5} << Numbers{4, 4};
  QTest::newRow("at the same places") << QList<double>{0, 1, 2} << QList<double>{0, 1, 2} << Numbers{3, 3};
  QTest::newRow("one goes on with the other")
      << QList<double>{0, 1, 2} << QList<double>{3, 4, 5} << Numbers{6};
  QTest::newRow("some in between") << QList<double>{0, 2, 3, 5, 6, 7} << QList<double>{1, 4} << Numbers{8};
}

void TestWhoseSlices::framesOfReferenceThatAreNotGiven() {
  QFETCH(QList<double>, named);
  QFETCH(QList<double>, unnamed);
  QFETCH(Numbers, sizes);
  const DicomFolder folder;
  int n = 0;
  const auto add = [&](const QList<double>& places, const QByteArray& uid) {
    for (const double z : places) {
      DicomPicture p = sliceAt(z, ++n);
      p.edit = [&](DcmDataset& d) { text(d, DCM_FrameOfReferenceUID, uid); };
      folder.add(numbered("s", n), p);
    }
  };
  add(named, "1.2.3.9");
  add(unnamed, "");
  const Study study = folder.open();
  QCOMPARE(sizesOf(study), sizes);
  const bool some = !named.isEmpty() && !unnamed.isEmpty();
  for (const Series& s : study.volumes) {
    QCOMPARE(warns(s.warnings, "name no frame of reference"), some);
    const auto onPicture = shortWarnings(s.warnings);
    const bool stands = std::ranges::find(onPicture, "Slices may not belong together") != onPicture.end();
    QCOMPARE(stands, some && sizes.size() == 1);
  }
}

void TestWhoseSlices::anIssuerThatIsNotGivenIsTold() {
  const DicomFolder folder;
  for (int n = 0; n < 4; ++n) {
    DicomPicture p = sliceAt(n, n);
    p.edit = [n](DcmDataset& d) {
      text(d, DCM_PatientID, "P1");
      if (n % 2) text(d, DCM_IssuerOfPatientID, "OTHER HOSPITAL");
    };
    folder.add(numbered("s", n), p);
  }
  const Study study = folder.open();
  QCOMPARE(sizesOf(study), Numbers{4});
  QVERIFY(warns(study.volumes[0].warnings,
                "do not say who issued the ID of patient P1 (OTHER HOSPITAL in the others)"));
}

void TestWhoseSlices::oneUidOfTwoPictures_data() {
  QTest::addColumn<bool>("otherNumber");
  QTest::addColumn<bool>("otherPixels");
  QTest::addColumn<bool>("isCopy");
  QTest::newRow("a copy") << false << false << true;
  QTest::newRow("another number") << true << false << false;
  QTest::newRow("other pixels") << false << true << false;
  QTest::newRow("both") << true << true << false;
}

void TestWhoseSlices::oneUidOfTwoPictures() {
  QFETCH(bool, otherNumber);
  QFETCH(bool, otherPixels);
  QFETCH(bool, isCopy);
  const DicomFolder folder;
  for (int n = 0; n < 6; ++n) {
    const int place = n / 2, second = n % 2;
    DicomPicture p = sliceAt(2 * place, 10 * place + (otherPixels ? second : 0));
    p.instance = 1 + place + (otherNumber ? 10 * second : 0);
    p.edit = [&](DcmDataset& d) { text(d, DCM_SOPInstanceUID, "1.2.3." + QByteArray::number(place)); };
    folder.add(numbered("s", n), p);
  }
  const Study study = folder.open();
  const auto told = [&](const char* words) {
    return std::ranges::all_of(study.volumes, [&](const Series& s) { return warns(s.warnings, words); });
  };
  if (isCopy) QCOMPARE(sizesOf(study), Numbers{3});
  if (!isCopy && otherNumber) QCOMPARE(sizesOf(study), (Numbers{3, 3}));
  if (!isCopy && !otherNumber) QCOMPARE(study.images.size(), std::size_t(6));  // nothing separates them
  if (study.volumes.empty()) return;
  QCOMPARE(told("s1 is a copy of s0 and is left out, and so are 2 other copies"), isCopy);
  QCOMPARE(told("s1 has the SOP Instance UID of s0, but is another picture, and so it is with 2 more"),
           !isCopy);
}

void TestWhoseSlices::blocksAreCutAtTheJump_data() {
  QTest::addColumn<QList<double>>("y");  // y of slices 1 mm apart
  QTest::addColumn<Numbers>("sizes");
  QTest::addColumn<QString>("told");
  const auto blocks = [](int count, int slices, double aside) {
    QList<double> y;
    for (int n = 0; n < count * slices; ++n) y << aside * (n / slices);
    return y;
  };
  for (const int slices : {5, 10, 40})
    for (const int aside : {2, 3, 10})
      QTest::addRow("%d slices, %d mm", slices, aside)
          << blocks(2, slices, aside) << Numbers{slices, slices}
          << QStringLiteral("lie along 2 lines, up to %1 mm beside each other").arg(aside);
  QTest::newRow("three blocks") << blocks(3, 6, 2) << Numbers{6, 6, 6}
                                << QStringLiteral("lie along 3 lines, up to 4 mm beside each other");
  QList<double> tilted = blocks(2, 12, 3), trembling, outlier(12, 0.0);
  for (int n = 0; n < tilted.size(); ++n) tilted[n] += 0.3 * n;
  for (int n = 0; n < 12; ++n) trembling << (n % 3 - 1) * 0.45;
  outlier[5] = 4;
  QTest::newRow("tilted blocks") << tilted << Numbers{12, 12}
                                 << QStringLiteral("lie along 2 lines, up to 3 mm beside each other");
  QTest::newRow("trembling") << trembling << Numbers{12} << QString();
  QTest::newRow("one beside the others")
      << outlier << Numbers{11, 1} << QStringLiteral("lie along 2 lines, up to 4 mm");
  QTest::newRow("a tilt") << QList<double>{0, 2, 4, 6, 8, 10} << Numbers{6} << QString();
}

void TestWhoseSlices::blocksAreCutAtTheJump() {
  QFETCH(QList<double>, y);
  QFETCH(Numbers, sizes);
  QFETCH(QString, told);
  const DicomFolder folder;
  for (int n = 0; n < y.size(); ++n) {
    DicomPicture p = sliceAt(n, n);
    p.position.y = y[n];
    folder.add(numbered("s", n), p);
  }
  const Study study = folder.open();
  QCOMPARE(sizesOf(study), sizes);
  QList<int> order;
  for (const Series& s : study.volumes) {
    QCOMPARE(warns(s.warnings, "beside each other"), !told.isEmpty());
    QVERIFY(warns(s.warnings, told.toStdString()) || told.isEmpty());
    for (const float v : firstOfEachSlice(*loadSeries(s)->acquired)) order << int(v);
  }
  if (sizes.contains(1)) return;
  QVERIFY(std::ranges::is_sorted(order));
}

void TestWhoseSlices::timesHaveDays_data() {
  QTest::addColumn<QByteArray>("which");
  QTest::addColumn<QList<QByteArray>>("times");
  QTest::addColumn<QStringList>("words");
  const QList<QByteArray> night{"20200102 000010", "20200101 235950", "20200102 000030"},
      days{"20200103 101500", "20200101 101500", "20200102 101500"},
      oneDay{"20200101 101502", "20200101 101500", "20200101 101501"};
  const QStringList ofNight{QStringLiteral("2020-01-01 23:59:50"), QStringLiteral("2020-01-02 00:00:10"),
                            QStringLiteral("2020-01-02 00:00:30")},
      ofDays{QStringLiteral("2020-01-01 10:15:00"), QStringLiteral("2020-01-02 10:15:00"),
             QStringLiteral("2020-01-03 10:15:00")},
      clock{QStringLiteral("10:15:00"), QStringLiteral("10:15:01"), QStringLiteral("10:15:02")};
  for (const char* which : {"Acquisition", "Content"}) {
    QTest::addRow("%s, midnight", which) << QByteArray(which) << night << ofNight;
    QTest::addRow("%s, days", which) << QByteArray(which) << days << ofDays;
    QTest::addRow("%s, one day", which) << QByteArray(which) << oneDay << clock;
  }
}

void TestWhoseSlices::timesHaveDays() {
  QFETCH(QByteArray, which);
  QFETCH(QList<QByteArray>, times);
  QFETCH(QStringList, words);
  const bool acquired = which == "Acquisition";
  const DicomFolder folder;
  for (int n = 0; n < 9; ++n) {
    DicomPicture p = sliceAt(n / 3, n);
    p.instance = 1 + n / 3;
    p.edit = [&](DcmDataset& d) {
      const QList<QByteArray> time = times[n % 3].split(' ');
      text(d, acquired ? DCM_AcquisitionDate : DCM_ContentDate, time[0]);
      text(d, acquired ? DCM_AcquisitionTime : DCM_ContentTime, time[1]);
    };
    folder.add(numbered("s", n), p);
  }
  const Study study = folder.open();
  QStringList found;
  for (const Series& s : study.volumes) found << QString::fromStdString(s.label);
  QCOMPARE(found, words);
}

void TestWhoseSlices::echoesOfOtherKindsAreCalledByThem_data() {
  QTest::addColumn<QList<QByteArray>>("types");
  QTest::addColumn<QStringList>("labels");
  QTest::newRow("a map") << QList<QByteArray>{"ORIGINAL\\PRIMARY\\T1\\FIELD_MAP", "ORIGINAL\\PRIMARY\\T1\\M"}
                         << QStringList{QStringLiteral("FIELD_MAP"), QStringLiteral("M")};
  QTest::newRow("echoes") << QList<QByteArray>{"ORIGINAL\\PRIMARY\\M", "ORIGINAL\\PRIMARY\\M"}
                          << QStringList{QString(), QString()};
}

void TestWhoseSlices::echoesOfOtherKindsAreCalledByThem() {
  QFETCH(QList<QByteArray>, types);
  QFETCH(QStringList, labels);
  const DicomFolder folder;
  for (int n = 0; n < 6; ++n) {
    DicomPicture p = sliceAt(n / 2, n);
    p.edit = [&](DcmDataset& d) {
      text(d, DCM_EchoTime, n % 2 ? "1.52" : "0");
      text(d, DCM_ImageType, types[n % 2]);
    };
    folder.add(numbered("s", n), p);
  }
  const Study study = folder.open();
  QStringList found;
  for (const Series& s : study.volumes) found << QString::fromStdString(s.label);
  QCOMPARE(found, labels);
  QCOMPARE(study.volumes[0].echoTime, std::string("0"));
}

VOLUMEN_TEST(TestWhoseSlices);
#include "tst_whose_slices.moc"
