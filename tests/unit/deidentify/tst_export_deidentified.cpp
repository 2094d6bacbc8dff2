// Guards PS3.15 E as `volumen export --deidentify` does it, on files made for it: encodings, places where
// identity hides, options, wrong input. Files are read with DCMTK.
#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>

#include "tests/unit/deidentify/exported.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

using Edit = void (*)(DcmDataset&);

constexpr const char* patient = "Quillfeather^Ada";
const DcmTagKey privateCreator(0x0019, 0x0010), bValue(0x0019, 0x100c), otherPrivate(0x0019, 0x1042);

void addPatient(DcmDataset& data) {
  data.putAndInsertString(DCM_SpecificCharacterSet, "ISO_IR 192");
  data.putAndInsertString(DCM_PatientName, patient);
  data.putAndInsertString(DCM_PatientID, "ID-778899");
  data.putAndInsertString(DCM_PatientBirthDate, "19610203");
  data.putAndInsertString(DCM_PatientSex, "F");
  data.putAndInsertString(DCM_PatientWeight, "61.5");
  data.putAndInsertString(DCM_StudyInstanceUID, "1.2.3.77");
  data.putAndInsertString(DCM_StudyDate, "20240228");
  data.putAndInsertString(DCM_StudyTime, "101112");
  data.putAndInsertString(DCM_SeriesDescription, "MR Brain Quillfeather");
  data.putAndInsertString(DCM_InstitutionName, "St Elsewhere");
  data.putAndInsertString(DCM_Modality, "MR");
}

DcmItem* itemOf(DcmItem& data, const DcmTagKey& sequence) {
  DcmItem* item = nullptr;
  data.findOrCreateSequenceItem(sequence, item, -2);
  return item;
}

}  // namespace

Q_DECLARE_METATYPE(Edit)

class TestExportDeidentified : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyEncodingKeepsItsPixels_data();
  void everyEncodingKeepsItsPixels();
  void identityHidesNowhere_data();
  void identityHidesNowhere();
  void whatIsAskedForStays_data();
  void whatIsAskedForStays();
  void referencesResolve();
  void datesMoveAlike_data();
  void datesMoveAlike();
  void whatWasDoneIsWritten();
  void runsAgree();
  void filesThatAreThereStay();
  void whatCannotBeCleanedIsLeftOut_data();
  void whatCannotBeCleanedIsLeftOut();
  void wrongWordsAreUsage_data();
  void wrongWordsAreUsage();

 private:
  QString write(const Edit& edit, const char* syntax = UID_LittleEndianExplicitTransferSyntax);
  Exported exported_;
};

QString TestExportDeidentified::write(const Edit& edit, const char* syntax) {
  DicomPicture picture;
  picture.edit = [&](DcmDataset& data) {
    addPatient(data);
    if (edit) edit(data);
  };
  const QString path = exported_.pathOf("in.dcm");
  writeDicom(path.toStdString(), picture, syntax);
  return path;
}

void TestExportDeidentified::everyEncodingKeepsItsPixels_data() {
  QTest::addColumn<QByteArray>("syntax");
  for (const char* syntax :
       {UID_LittleEndianExplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax,
        UID_BigEndianExplicitTransferSyntax, UID_DeflatedExplicitVRLittleEndianTransferSyntax,
        UID_RLELosslessTransferSyntax, UID_JPEGLSLosslessTransferSyntax, UID_JPEGProcess14SV1TransferSyntax})
    QTest::newRow(dcmFindNameOfUID(syntax)) << QByteArray(syntax);
}

void TestExportDeidentified::everyEncodingKeepsItsPixels() {
  QFETCH(QByteArray, syntax);
  const QString path = write(
      [](DcmDataset& data) {
        itemOf(*itemOf(data, DCM_RequestAttributesSequence), DCM_ScheduledProtocolCodeSequence)
            ->putAndInsertString(DCM_CodeMeaning, "for Quillfeather");
        itemOf(*itemOf(data, DCM_AnatomicRegionSequence), DCM_AnatomicRegionModifierSequence)
            ->putAndInsertString(DCM_CodeMeaning, "Left");
      },
      syntax.constData());
  const Outcome outcome = exported_.run(path);
  QCOMPARE(outcome.status, 0);
  const auto before = readWithDcmtk(path), after = exported_.only();
  QVERIFY(before && after);
  DcmElement *pixels = nullptr, *same = nullptr;
  QVERIFY(before->getDataset()->findAndGetElement(DCM_PixelData, pixels).good());
  QVERIFY(after->getDataset()->findAndGetElement(DCM_PixelData, same).good());
  QCOMPARE(pixels->compare(*same), 0);
  QVERIFY(!contentsOf(copiesIn(exported_.folder()).front()).contains("Quillfeather"));
  DcmItem* item = nullptr;
  QVERIFY(after->getDataset()->findAndGetSequenceItem(DCM_AnatomicRegionSequence, item).good());
  QVERIFY(item->findAndGetSequenceItem(DCM_AnatomicRegionModifierSequence, item).good());
  QCOMPARE(textOf(*item, DCM_CodeMeaning), std::string("Left"));
}

void TestExportDeidentified::identityHidesNowhere_data() {
  QTest::addColumn<Edit>("edit");
  const auto row = [](const char* name, Edit edit) { QTest::newRow(name) << edit; };
  row("in the attributes of the patient", nullptr);
  row("in an attribute that stays", [](DcmDataset& d) {
    d.putAndInsertString(DCM_ContrastFlowRate, "1");
    d.putAndInsertString(DCM_SoftwareVersions, "made for QUILLFEATHER");
  });
  row("in a private attribute", [](DcmDataset& d) {
    d.putAndInsertString(DcmTag(privateCreator, EVR_LO), "ACME 1.1");
    d.putAndInsertString(DcmTag(otherPrivate, EVR_LO), patient);
  });
  row("in a private attribute of an item", [](DcmDataset& d) {
    DcmItem* const item = itemOf(d, DCM_AnatomicRegionSequence);
    item->putAndInsertString(DcmTag(privateCreator, EVR_LO), "ACME 1.1");
    item->putAndInsertString(DcmTag(otherPrivate, EVR_LO), patient);
  });
  row("in an item three sequences deep", [](DcmDataset& d) {
    itemOf(*itemOf(*itemOf(d, DCM_AnatomicRegionSequence), DCM_AnatomicRegionModifierSequence),
           DCM_ReferencedPatientAliasSequence)
        ->putAndInsertString(DCM_PatientName, patient);
  });
  row("in a text of a report", [](DcmDataset& d) {
    DcmItem* const item = itemOf(d, DCM_ContentSequence);
    item->putAndInsertString(DCM_ValueType, "TEXT");
    item->putAndInsertString(DCM_TextValue, "Seen with Mrs Q. by ID-778899");
  });
  row("in a person's name of a report",
      [](DcmDataset& d) { itemOf(d, DCM_ContentSequence)->putAndInsertString(DCM_PersonName, patient); });
  row("in a code of a person", [](DcmDataset& d) {
    itemOf(d, DCM_PersonIdentificationCodeSequence)->putAndInsertString(DCM_CodeValue, "ID-778899");
  });
  row("in a comment", [](DcmDataset& d) { d.putAndInsertString(DCM_ImageComments, "patient Quillfeather"); });
  row("in an attribute that nobody knows",
      [](DcmDataset& d) { d.putAndInsertString(DcmTag(0x0010, 0x9998, EVR_LO), "Quill-feather ID-778899"); });
  row("in a sequence of VR UN", [](DcmDataset& d) {
    const std::string inside = std::string("\x10\0\x10\0", 4) + std::string("\x10\0\0\0", 4) + patient;
    const std::string item = std::string("\xfe\xff\0\xe0", 4) + std::string("\x18\0\0\0", 4) + inside;
    d.putAndInsertUint8Array(DcmTag(DCM_RequestAttributesSequence, EVR_UN),
                             reinterpret_cast<const Uint8*>(item.data()), item.size());
  });
  row("in a known attribute of VR UN", [](DcmDataset& d) {
    d.putAndInsertUint8Array(DcmTag(DCM_SoftwareVersions, EVR_UN),
                             reinterpret_cast<const Uint8*>("Quillfeather"), 12);
  });
  row("in padding after the pixels", [](DcmDataset& d) {
    d.putAndInsertUint8Array(DcmTag(DCM_DataSetTrailingPadding, EVR_OB),
                             reinterpret_cast<const Uint8*>("Quillfeather"), 12);
  });
  row("in pixels of an overlay", [](DcmDataset& d) {
    d.putAndInsertUint16(DcmTag(0x6000, 0x0010, EVR_US), 8);
    d.putAndInsertUint8Array(DcmTag(0x6000, 0x3000, EVR_OB), reinterpret_cast<const Uint8*>("Quillfeather"),
                             12);
  });
  row("in names of other scripts", [](DcmDataset& d) {
    d.putAndInsertString(DCM_PatientName, "Quillfeather^Ada=\xe6\x9d\xb1");
    d.putAndInsertString(DCM_OtherPatientNames, patient);
  });
}

void TestExportDeidentified::identityHidesNowhere() {
  QFETCH(Edit, edit);
  QCOMPARE(exported_.run(write(edit)).status, 0);
  const auto after = exported_.only();
  QVERIFY(after);
  const QByteArray bytes = contentsOf(copiesIn(exported_.folder()).front()).toLower();
  for (const char* original : {"quillfeather", "quill-feather", "id-778899", "19610203", "20240228",
                               "1.2.3.77", "elsewhere", "mrs q."})
    QVERIFY2(!bytes.contains(original), original);
  QVERIFY(!after->getDataset()->tagExists(DCM_PatientWeight));
  QVERIFY(!textOf(*after->getDataset(), DCM_PatientName).empty());
  QCOMPARE(textOf(*after->getDataset(), DCM_PatientName), textOf(*after->getDataset(), DCM_PatientID));
}

void TestExportDeidentified::whatIsAskedForStays_data() {
  QTest::addColumn<QString>("option");
  QTest::addColumn<quint32>("tag");
  QTest::addColumn<QByteArray>("value");
  const auto row = [](const char* option, const DcmTagKey& tag, const char* value) {
    QTest::addRow("%s: %s", option, DcmTag(tag).getTagName())
        << QString::fromLatin1(option) << (quint32(tag.getGroup()) << 16 | tag.getElement())
        << QByteArray(value);
  };
  row("uids", DCM_StudyInstanceUID, "1.2.3.77");
  row("dates", DCM_StudyDate, "20240228");
  row("patient", DCM_PatientWeight, "61.5");
  row("patient", DCM_PatientSex, "F");
  row("institution", DCM_InstitutionName, "St Elsewhere");
  row("device", DCM_DeviceSerialNumber, "SN-4711");
  row("descriptors", DCM_SeriesDescription, "MR Brain");
  row("private", bValue, "800");
}

void TestExportDeidentified::whatIsAskedForStays() {
  QFETCH(QString, option);
  QFETCH(quint32, tag);
  QFETCH(QByteArray, value);
  const QString path = write([](DcmDataset& d) {
    d.putAndInsertString(DCM_DeviceSerialNumber, "SN-4711");
    d.putAndInsertString(DcmTag(privateCreator, EVR_LO), "SIEMENS MR HEADER");
    d.putAndInsertString(DcmTag(bValue, EVR_IS), "800");
    d.putAndInsertString(DcmTag(otherPrivate, EVR_LO), patient);
  });
  const DcmTagKey key(Uint16(tag >> 16), Uint16(tag & 0xffff));
  for (const bool isKept : {false, true}) {
    QCOMPARE(
        exported_.run(path, isKept ? QStringList{QStringLiteral("--keep"), option} : QStringList()).status,
        0);
    const auto after = exported_.only();
    QVERIFY(after);
    QCOMPARE(textOf(*after->getDataset(), key) == value.toStdString(), isKept);
    QVERIFY(!contentsOf(copiesIn(exported_.folder()).front()).contains("Quillfeather"));
  }
}

void TestExportDeidentified::referencesResolve() {
  const QString path = write([](DcmDataset& d) {
    DcmItem* const item = itemOf(d, DCM_ReferencedImageSequence);
    item->putAndInsertString(DCM_ReferencedSOPClassUID, UID_MRImageStorage);
    item->putAndInsertString(DCM_ReferencedSOPInstanceUID, "1.2.3.77.5");
    d.putAndInsertString(DCM_FrameOfReferenceUID, "1.2.840.10008.1.4.1.1");
    d.putAndInsertString(DCM_IrradiationEventUID, "1.2.3.8\\1.2.3.9");
  });
  QCOMPARE(exported_.run(path).status, 0);
  const auto after = exported_.only();
  QVERIFY(after);
  DcmDataset& data = *after->getDataset();
  DcmItem* item = nullptr;
  QVERIFY(data.findAndGetSequenceItem(DCM_ReferencedImageSequence, item).good());
  QCOMPARE(textOf(*item, DCM_ReferencedSOPInstanceUID), exported_.uid("1.2.3.77.5"));
  QCOMPARE(textOf(*item, DCM_ReferencedSOPClassUID), std::string(UID_MRImageStorage));
  QCOMPARE(textOf(data, DCM_StudyInstanceUID), exported_.uid("1.2.3.77"));
  QCOMPARE(textOf(data, DCM_FrameOfReferenceUID), std::string("1.2.840.10008.1.4.1.1"));
  QCOMPARE(textOf(data, DCM_IrradiationEventUID), exported_.uid("1.2.3.8") + "\\" + exported_.uid("1.2.3.9"));
  QCOMPARE(textOf(*after->getMetaInfo(), DCM_MediaStorageSOPInstanceUID), textOf(data, DCM_SOPInstanceUID));
}

void TestExportDeidentified::datesMoveAlike_data() {
  QTest::addColumn<QByteArray>("date");
  QTest::addColumn<int>("days");
  QTest::addColumn<QByteArray>("moved");
  QTest::newRow("over a leap day") << QByteArray("20240228") << 2 << QByteArray("20240301");
  QTest::newRow("back over a year") << QByteArray("20240101") << -1 << QByteArray("20231231");
  QTest::newRow("old form") << QByteArray("2024.01.01") << 1 << QByteArray("20240102");
  QTest::newRow("a year alone cannot") << QByteArray("2024") << 1 << QByteArray();
  QTest::newRow("no date") << QByteArray("99999999") << 1 << QByteArray();
}

void TestExportDeidentified::datesMoveAlike() {
  QFETCH(QByteArray, date);
  QFETCH(int, days);
  QFETCH(QByteArray, moved);
  static QByteArray now;
  now = date;
  const QString path = write([](DcmDataset& d) {
    d.putAndInsertString(DCM_StudyDate, now.constData());
    d.putAndInsertString(DCM_AcquisitionDateTime, (now + "101112.5").constData());
    itemOf(d, DCM_RadiopharmaceuticalInformationSequence)
        ->putAndInsertString(DCM_RadiopharmaceuticalStartDateTime, (now + "091112").constData());
  });
  QCOMPARE(exported_.run(path, {QStringLiteral("--shift-dates"), QString::number(days)}).status, 0);
  const auto after = exported_.only();
  QVERIFY(after);
  DcmDataset& data = *after->getDataset();
  QCOMPARE(textOf(data, DCM_StudyDate), moved.toStdString());
  QCOMPARE(textOf(data, DCM_StudyTime), std::string("101112"));
  QCOMPARE(textOf(data, DCM_LongitudinalTemporalInformationModified), std::string("MODIFIED"));
  if (date.size() != 8 || moved.isEmpty()) return;
  QCOMPARE(textOf(data, DCM_AcquisitionDateTime), (moved + "101112.5").toStdString());
  DcmItem* item = nullptr;
  QVERIFY(data.findAndGetSequenceItem(DCM_RadiopharmaceuticalInformationSequence, item).good());
  QCOMPARE(textOf(*item, DCM_RadiopharmaceuticalStartDateTime), (moved + "091112").toStdString());
}

void TestExportDeidentified::whatWasDoneIsWritten() {
  const QString path = write([](DcmDataset& d) {
    d.putAndInsertString(DCM_DeidentificationMethod, "by hand");
    d.putAndInsertString(DCM_PatientIdentityRemoved, "NO");
  });
  QCOMPARE(exported_.run(path, {QStringLiteral("--keep"), QStringLiteral("patient,uids")}).status, 0);
  const auto after = exported_.only();
  QVERIFY(after);
  DcmDataset& data = *after->getDataset();
  QCOMPARE(textOf(data, DCM_PatientIdentityRemoved), std::string("YES"));
  QVERIFY(textOf(data, DCM_DeidentificationMethod).find("PS3.15 E.1-1 2026c") != std::string::npos);
  QCOMPARE(textOf(data, DCM_LongitudinalTemporalInformationModified), std::string("REMOVED"));
  QStringList codes;
  DcmItem* item = nullptr;
  for (int n = 0; data.findAndGetSequenceItem(DCM_DeidentificationMethodCodeSequence, item, n).good(); ++n)
    codes << QString::fromStdString(textOf(*item, DCM_CodeValue));
  QCOMPARE(codes, QStringList({QStringLiteral("113100"), QStringLiteral("113104"), QStringLiteral("113108"),
                               QStringLiteral("113110")}));
}

void TestExportDeidentified::runsAgree() {
  const QString path = write(nullptr);
  QCOMPARE(exported_.run(path).status, 0);
  const QString first = exported_.folder();
  QCOMPARE(exported_.run(path).status, 0);
  QCOMPARE(contentsOf(copiesIn(first).front()), contentsOf(copiesIn(exported_.folder()).front()));
  Exported other;
  QFile key(other.pathOf("key"));
  QVERIFY(key.open(QIODevice::Append) && key.write("!") == 1);
  key.close();
  QCOMPARE(other.run(path).status, 0);
  QVERIFY(contentsOf(copiesIn(first).front()) != contentsOf(copiesIn(other.folder()).front()));
}

void TestExportDeidentified::filesThatAreThereStay() {
  const QString path = write(nullptr);
  QCOMPARE(exported_.run(path).status, 0);
  const QString folder = exported_.folder(), copy = copiesIn(folder).front();
  const auto again = [&] {
    return runProgram({QStringLiteral("export"), path, QStringLiteral("--deidentify"), QStringLiteral("-o"),
                       folder, QStringLiteral("--key"), exported_.pathOf("key"), QStringLiteral("--json")});
  };
  const Outcome same = again();
  QCOMPARE(same.status, 0);
  QCOMPARE(QJsonDocument::fromJson(same.out)[QStringLiteral("alreadyThere")].toInt(), 1);
  QFile file(copy);
  QVERIFY(file.open(QIODevice::Append) && file.write("more") == 4);
  file.close();
  const QByteArray changed = contentsOf(copy);
  const Outcome other = again();
  QCOMPARE(other.status, 1);
  QVERIFY(other.err.contains("is there already, with other contents"));
  QCOMPARE(contentsOf(copy), changed);
  QCOMPARE(copiesIn(folder).size(), 1);
}

void TestExportDeidentified::whatCannotBeCleanedIsLeftOut_data() {
  QTest::addColumn<Edit>("edit");
  QTest::addColumn<QByteArray>("reason");
  const auto row = [](const char* name, const char* reason, Edit edit) {
    QTest::newRow(name) << edit << QByteArray(reason);
  };
  row("a document", "a document",
      [](DcmDataset& d) { d.putAndInsertString(DCM_SOPClassUID, UID_EncapsulatedPDFStorage); });
  row("a manufacturer's class", "own class",
      [](DcmDataset& d) { d.putAndInsertString(DCM_SOPClassUID, "1.3.12.2.1107.5.9.1"); });
  row("no study", "lacks the UID", [](DcmDataset& d) { d.findAndDeleteElement(DCM_StudyInstanceUID); });
}

void TestExportDeidentified::whatCannotBeCleanedIsLeftOut() {
  QFETCH(Edit, edit);
  QFETCH(QByteArray, reason);
  const Outcome outcome = exported_.run(write(edit));
  QCOMPARE(outcome.status, 1);
  QVERIFY2(outcome.err.contains("is left out") && outcome.err.contains(reason), outcome.err.constData());
  QVERIFY(copiesIn(exported_.folder()).isEmpty());
}

void TestExportDeidentified::wrongWordsAreUsage_data() {
  QTest::addColumn<QStringList>("options");
  QTest::addColumn<int>("status");
  QTest::addColumn<QByteArray>("says");
  QTest::newRow("kept and shifted") << QStringList{QStringLiteral("--keep"), QStringLiteral("dates"),
                                                   QStringLiteral("--shift-dates"), QStringLiteral("3")}
                                    << 2 << QByteArray("kept or shifted");
  QTest::newRow("an unknown word") << QStringList{QStringLiteral("--keep"), QStringLiteral("names")} << 2
                                   << QByteArray("names");
  QTest::newRow("no days") << QStringList{QStringLiteral("--shift-dates"), QStringLiteral("soon")} << 2
                           << QByteArray("shift-dates");
}

void TestExportDeidentified::wrongWordsAreUsage() {
  QFETCH(QStringList, options);
  const Outcome outcome = exported_.run(write(nullptr), options);
  QTEST(outcome.status, "status");
  QFETCH(QByteArray, says);
  QVERIFY2(outcome.err.contains(says), outcome.err.constData());
}

VOLUMEN_TEST(TestExportDeidentified);
#include "tst_export_deidentified.moc"
