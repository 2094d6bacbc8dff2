// Guards import.md: objects that refer to pictures are found with their labels and the pictures they name.
// Missing pictures are counted.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/io/dicom_objects.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestDerivedObjects : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void realObjectsAreListed_data();
  void realObjectsAreListed();
  void theyStayAmongTheOthers();
  void whatIsNotHereIsCounted();
  void proceduresAreNoPictures();
  void framesAreCountedFromZero();
  void orderIsThatOfSeries();
  void guessedLettersAreTold_data();
  void guessedLettersAreTold();
};

namespace {

const char* const ctSmall = "1.3.6.1.4.1.5962.1.1.1.1.1.20040119072730.12322";

/// Adds a reference to an instance to the item.
DcmItem& refer(DcmItem& item, const std::string& uid) {
  put(item, 0x0008, 0x1150, "1.2.840.10008.5.1.4.1.1.2");
  put(item, 0x0008, 0x1155, uid);
  return item;
}

}  // namespace

void TestDerivedObjects::realObjectsAreListed_data() {
  QTest::addColumn<QString>("file");
  QTest::addColumn<QString>("kind");
  QTest::addColumn<QString>("label");
  QTest::addColumn<QString>("text");
  QTest::addColumn<int>("pictures");
  QTest::addColumn<QString>("first");
  const auto row = [](const char* file, const char* kind, const char* label, const char* text, int pictures,
                      const char* first) {
    QTest::newRow(file) << QString::fromLatin1(file) << QString::fromLatin1(kind)
                        << QString::fromLatin1(label) << QString::fromLatin1(text) << pictures
                        << QString::fromLatin1(first);
  };
  row("dicom-2d/made-here/pr-on-CT_small.dcm", "presentation state", "TEST",
      "window, flip+rotate, shutter, annotations", 1, ctSmall);
  row("dicom-2d/made-here/ko-on-CT_small.dcm", "key objects", "Of Interest", "made for a test", 1, ctSmall);
  row("dicom-2d/pr-without-pixels/pr.dcm", "presentation state", "PRESENTATION", "hip", 1,
      "1.2.276.0.7230010.3.1.4.665618.6496.1546453790.314808");
  row("dicom-2d/sr-tid1500-on-CT_small.dcm", "report", "Imaging Measurement Report", "", 1, ctSmall);
  row("dicom-2d/sr-tid1500-groups-on-CT_small.dcm", "report", "Imaging Measurement Report", "", 1, ctSmall);
  row("dicom-2d/seg-on-CT_small.dcm", "segmentation", "ISO_IR 192", "", 1, ctSmall);
  row("dicom-2d/seg-overlap-on-CT2.dcm", "segmentation", "ISO_IR 192", "", 4,
      "1.3.6.1.4.1.5962.1.1.0.0.0.1196530851.28319.0.93");
  // The pictures are those of the series before it was cropped.
  row("pet-ct/sts019-rtstruct-ct.dcm", "contours", "RTstruct", "RTstruct_CT", 179, "");
}

void TestDerivedObjects::realObjectsAreListed() {
  NEED_DATA(dataPath());
  QFETCH(QString, file);
  QFETCH(QString, kind);
  QFETCH(QString, label);
  QFETCH(QString, text);
  QFETCH(int, pictures);
  QFETCH(QString, first);
  const Result<Study> study = openStudy(dataPath(file.toStdString()));
  QVERIFY(study.ok());
  QCOMPARE(study->derived.size(), std::size_t(1));
  const DerivedObject& object = study->derived[0];
  QCOMPARE(QString::fromLatin1(kindName(object.kind)), kind);
  QCOMPARE(QString::fromStdString(object.label), label);
  QCOMPARE(QString::fromStdString(object.text), text);
  QCOMPARE(int(object.pictures.size()), pictures);
  if (!first.isEmpty()) QCOMPARE(QString::fromStdString(object.pictures[0].sopInstanceUid), first);
  for (const ReferencedPicture& p : object.pictures) QVERIFY(!p.seriesUid.empty());
  QCOMPARE(object.notHere, object.pictures.size());  // the file alone holds no picture
  QVERIFY(!object.studyUid.empty() && !object.patientName.empty() && object.id == object.sopInstanceUid);
}

void TestDerivedObjects::theyStayAmongTheOthers() {
  NEED_DATA(dataPath());
  const Result<Study> study = openStudy(dataPath("dicom-2d/made-here"));
  QVERIFY(study.ok() && study->refused.empty());
  QCOMPARE(study->derived.size(), std::size_t(2));
  QCOMPARE(study->other.size(), std::size_t(2));
  const Result<Study> segmentation = openStudy(dataPath("dicom-2d/seg-on-CT_small.dcm"));
  QVERIFY(segmentation.ok() && segmentation->refused.empty() && segmentation->volumes.empty());
  QCOMPARE(segmentation->other.at(0).kind, std::string("DICOM segmentation"));
}

void TestDerivedObjects::whatIsNotHereIsCounted() {
  const DicomFolder folder;
  DicomPicture slice = sliceAt(0, 1);
  slice.edit = [](DcmDataset& data) { put(data, 0x0008, 0x0018, "1.2.3.99"); };
  folder.add("slice", slice);
  writeObject(folder.path("pr"), presentationClass, [](DcmItem& data) {
    DcmItem& series = addItem(data, 0x0008, 0x1115);
    put(series, 0x0020, 0x000e, "1.2.3.4.5");
    for (const char* uid : {"1.2.3.99", "1.2.3.100", "1.2.3.99", "1.2.3.101"})
      refer(addItem(series, 0x0008, 0x1140), uid);
  });
  const Study study = folder.open();
  QCOMPARE(study.derived.size(), std::size_t(1));
  QCOMPARE(study.derived[0].pictures.size(), std::size_t(3));  // each once
  QCOMPARE(study.derived[0].notHere, std::size_t(2));
  QCOMPARE(study.derived[0].pictures[2].seriesUid, std::string("1.2.3.4.5"));
}

void TestDerivedObjects::proceduresAreNoPictures() {
  const DicomFolder folder;
  writeObject(folder.path("sr"), reportClass, [](DcmItem& data) {
    DcmItem& step = addItem(data, 0x0008, 0x1111);
    put(step, 0x0008, 0x1150, "1.2.840.10008.3.1.2.3.3");
    put(step, 0x0008, 0x1155, "1.2.3.7");
  });
  const Study study = folder.open();
  QCOMPARE(study.derived.size(), std::size_t(1));
  QVERIFY(study.derived[0].pictures.empty());
}

void TestDerivedObjects::framesAreCountedFromZero() {
  const DicomFolder folder;
  writeObject(folder.path("ko"), keyObjectClass, [](DcmItem& data) {
    DcmItem& item = addItem(data, 0x0040, 0xa730);
    put(refer(addItem(item, 0x0008, 0x1199), "1.2.3.99"), 0x0008, 0x1160, "7\\1\\7");
    put(refer(addItem(item, 0x0008, 0x1199), "1.2.3.99"), 0x0008, 0x1160, "3\\0\\-4");
    put(refer(addItem(item, 0x0008, 0x1199), "1.2.3.100"), 0x0008, 0x1160, "2");
    refer(addItem(item, 0x0008, 0x1199), "1.2.3.100");
  });
  const Study study = folder.open();
  QCOMPARE(study.derived.size(), std::size_t(1));
  const auto& pictures = study.derived[0].pictures;
  QCOMPARE(pictures.size(), std::size_t(2));
  QCOMPARE(pictures[0].frames, (std::vector<int>{0, 2, 6}));
  QVERIFY(pictures[1].frames.empty());  // a reference without frames means the whole picture
}

void TestDerivedObjects::orderIsThatOfSeries() {
  const DicomFolder folder;
  for (const char* number : {"10", "9", "11"})
    writeObject(folder.path(number), reportClass, [&](DcmItem& data) { put(data, 0x0020, 0x0011, number); });
  const Study study = folder.open();
  QCOMPARE(study.derived.size(), std::size_t(3));
  for (int n = 0; n < 3; ++n) QCOMPARE(study.derived[std::size_t(n)].seriesNumber, std::to_string(9 + n));
}

void TestDerivedObjects::guessedLettersAreTold_data() {
  QTest::addColumn<QByteArray>("sopClass");
  QTest::addColumn<QByteArray>("letters");
  QTest::addColumn<QByteArray>("says");  // empty for nothing
  QTest::newRow("name of a segment") << QByteArray(segmentationClass) << QByteArray("M\xe4hne")
                                     << QByteArray("which is a guess.");
  QTest::newRow("name of a segment in UTF-8")
      << QByteArray(segmentationClass) << QByteArray("M\xc3\xa4hne") << QByteArray("read as UTF-8.");
  QTest::newRow("name of a segment in ASCII")
      << QByteArray(segmentationClass) << QByteArray("Liver") << QByteArray();
  QTest::newRow("name of a region") << QByteArray(structureSetClass) << QByteArray("M\xe4hne")
                                    << QByteArray("which is a guess.");
  QTest::newRow("name of the patient of a report")
      << QByteArray(reportClass) << QByteArray("M\xe4hne") << QByteArray("which is a guess.");
}

void TestDerivedObjects::guessedLettersAreTold() {
  QFETCH(QByteArray, sopClass);
  QFETCH(QByteArray, letters);
  QFETCH(QByteArray, says);
  const DicomFolder folder;
  writeObject(folder.path("a"), sopClass.constData(), [&](DcmItem& data) {
    const std::string name = letters.toStdString();
    if (sopClass == reportClass) put(data, 0x0010, 0x0010, name);
    if (sopClass == segmentationClass) put(addItem(data, 0x0062, 0x0002), 0x0062, 0x0005, name);
    if (sopClass == structureSetClass) put(addItem(data, 0x3006, 0x0020), 0x3006, 0x0026, name);
  });
  const Study study = folder.open();
  QCOMPARE(study.derived.size(), std::size_t(1));
  const std::vector<std::string>& warnings = study.derived[0].warnings;
  QCOMPARE(warnings.size(), std::size_t(says.isEmpty() ? 0 : 1));
  if (!says.isEmpty()) QVERIFY2(QByteArray::fromStdString(warnings[0]).endsWith(says), warnings[0].c_str());
}

VOLUMEN_TEST(TestDerivedObjects);
#include "tst_derived_objects.moc"
