// Guards `volumen export --deidentify`: attributes outside the table that hold identity, and the messages
// and files of runs that end early.
#include <sys/resource.h>

#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <memory>
#include <tuple>

#include "tests/fixtures/fixtures.h"
#include "tests/unit/deidentify/exported.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestDeidentifiedRuns : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void attributesBesideTheTableLoseIdentity_data();
  void attributesBesideTheTableLoseIdentity();
  void keptPrivateAttributesLoseIdentity_data();
  void keptPrivateAttributesLoseIdentity();
  void secondRunsOfOneUidAgree_data();
  void secondRunsOfOneUidAgree();
  void aLostMosaicIsTold();
  void noEmptyFolderIsLeft();
  void originalsAreNoTarget();
  void copiesOfAFullDiskAreCounted();

 private:
  Exported exported_;
};

void TestDeidentifiedRuns::attributesBesideTheTableLoseIdentity_data() {
  QTest::addColumn<quint32>("tag");
  QTest::addColumn<QByteArray>("vr");
  QTest::addColumn<QByteArray>("value");
  QTest::addColumn<QByteArray>("after");
  const auto row = [](const char* name, quint32 tag, const char* vr, const char* value,
                      const std::string& after) {
    QTest::newRow(name) << tag << QByteArray(vr) << QByteArray(value) << QByteArray::fromStdString(after);
  };
  row("a code with a name", 0x00180015, "CS", "MUSTERMANN", "DEIDENTIFIED");
  row("one of several codes", 0x00080008, "CS", "ORIGINAL\\PRIMARY\\MUSTERMANN\\M",
      "ORIGINAL\\PRIMARY\\DEIDENTIFIED\\M");
  row("a name over two codes", 0x00080008, "CS", "ORIGINAL\\PRIMARY\\MUSTER\\MANN",
      "ORIGINAL\\PRIMARY\\DEIDENTIFIED\\DEIDENTIFIED");
  row("a code without a name", 0x00180015, "CS", "HEAD", "HEAD");
  row("a code beside the pixels", 0x00280051, "CS", "MUSTERMANN\\ATTN", "DEIDENTIFIED\\ATTN");
  row("an ID in a code beside the pixels", 0x00282114, "CS", "PID77X", "DEIDENTIFIED");
  row("an ID over two values", 0x00281055, "LO", "PID\\77X", "DEIDENTIFIED");
  row("a short whole name", 0x00081090, "LO", "of ERIKA mustermann", "DEIDENTIFIED");
  row("the UID of a source", 0x00081167, "UI", "1.2.3.8\\1.2.3.9",
      exported_.uid("1.2.3.8") + "\\" + exported_.uid("1.2.3.9"));
  row("a UID that the table replaces by a dummy", 0x006a0003, "UI", "1.2.3.8", exported_.uid("1.2.3.8"));
  row("birth by another calendar", 0x00100033, "LO", "05.03.1330", "");
}

void TestDeidentifiedRuns::attributesBesideTheTableLoseIdentity() {
  QFETCH(quint32, tag);
  QFETCH(QByteArray, vr);
  QFETCH(QByteArray, value);
  const DcmTag attribute(Uint16(tag >> 16), Uint16(tag & 0xffff), DcmVR(vr.constData()));
  DicomPicture picture;
  picture.edit = [&](DcmDataset& data) {
    data.putAndInsertString(DCM_PatientName, "Mustermann^Erika");
    data.putAndInsertString(DCM_PatientID, "PID-77-X");
    data.putAndInsertString(attribute, value.constData());
  };
  const QString path = exported_.pathOf("in.dcm");
  writeDicom(path.toStdString(), picture);
  QCOMPARE(exported_.run(path).status, 0);
  const auto copy = exported_.only();
  QVERIFY(copy);
  QTEST(QByteArray::fromStdString(textOf(*copy->getDataset(), attribute)), "after");
}

void TestDeidentifiedRuns::keptPrivateAttributesLoseIdentity_data() {
  QTest::addColumn<quint32>("tag");
  QTest::addColumn<QByteArray>("vr");
  QTest::addColumn<QByteArray>("value");
  QTest::addColumn<QByteArray>("after");  // empty: the attribute is gone
  const auto row = [](const char* name, quint32 tag, const char* vr, const char* value, const char* after) {
    QTest::newRow(name) << tag << QByteArray(vr) << QByteArray(value) << QByteArray(after);
  };
  row("a code with a name", 0x0019100d, "CS", "MUSTERMANN", "DEIDENTIFIED");
  row("codes with a name", 0x20011004, "CS", "ERIKA\\MUSTERMANN", "DEIDENTIFIED\\DEIDENTIFIED");
  row("a code without a name", 0x0019100d, "CS", "DIRECTIONAL", "DIRECTIONAL");
  row("a code of VR UN", 0x0019100d, "UN", "MUSTERMANN", "DEIDENTIFIED");
  row("a text with a name", 0x00431027, "SH", "of Mustermann", "DEIDENTIFIED");
  row("a number", 0x0019100c, "IS", "800", "800");
  row("a number of VR UN", 0x0019100c, "UN", "80", "38\\30");
  row("no number", 0x70531000, "DS", "770042ZZ", "");
  row("no number among others", 0x0043106f, "DS", "7\\770042ZZ", "");
  row("a text in place of a number", 0x0019100c, "LT", "770042ZZ", "");
  row("a person in place of a number", 0x0019100c, "PN", "Mustermann^Erika", "");
  row("a person in place of a code", 0x0019100d, "PN", "Schmidt^Eva", "");
  row("bytes in place of a number", 0x0019100e, "OB", "Schmidts", "");
  row("a name as long as numbers", 0x0019100e, "UN", "Mustermann Erika", "");
  row("bytes that are no whole number", 0x0019100e, "UN", "Schmid", "");
}

void TestDeidentifiedRuns::keptPrivateAttributesLoseIdentity() {
  QFETCH(quint32, tag);
  QFETCH(QByteArray, vr);
  QFETCH(QByteArray, value);
  const DcmTag attribute(Uint16(tag >> 16), Uint16(tag & 0xffff), DcmVR(vr.constData()));
  const bool isBytes = vr == "UN" || vr == "OB";
  DicomPicture picture;
  picture.edit = [&](DcmDataset& data) {
    data.putAndInsertString(DCM_PatientName, "Mustermann^Erika");
    for (const auto& [group, creator] :
         {std::pair(Uint16(0x0019), "SIEMENS MR HEADER"), std::pair(Uint16(0x0043), "GEMS_PARM_01"),
          std::pair(Uint16(0x2001), "Philips Imaging DD 001"),
          std::pair(Uint16(0x7053), "Philips PET Private Group")})
      data.putAndInsertString(DcmTag(group, 0x0010, EVR_LO), creator);
    if (!isBytes) return void(data.putAndInsertString(attribute, value.constData()));
    auto bytes = std::make_unique<DcmOtherByteOtherWord>(attribute);
    bytes->putUint8Array(reinterpret_cast<const Uint8*>(value.constData()),
                         static_cast<unsigned long>(value.size()));
    if (data.insert(bytes.get()).good()) std::ignore = bytes.release();
  };
  const QString path = exported_.pathOf("in.dcm");
  writeDicom(path.toStdString(), picture);
  DcmFileFormat source;
  QVERIFY(source.loadFile(path.toUtf8().constData()).good());
  QVERIFY(source.getDataset()->tagExists(attribute));
  QCOMPARE(exported_.run(path, {QStringLiteral("--keep"), QStringLiteral("private")}).status, 0);
  const auto copy = exported_.only();
  QVERIFY(copy);
  QTEST(QByteArray::fromStdString(textOf(*copy->getDataset(), attribute)), "after");
  QFETCH(QByteArray, after);
  QCOMPARE(bool(copy->getDataset()->tagExists(attribute)), !after.isEmpty());
}

void TestDeidentifiedRuns::secondRunsOfOneUidAgree_data() {
  QTest::addColumn<QString>("copied");
  QTest::addColumn<QString>("leftOut");
  const QString a = QStringLiteral("a.dcm"), b = QStringLiteral("b.dcm");
  QTest::newRow("the first of two was copied") << a << b;
  QTest::newRow("the second of two was copied") << b << a;
}

// Of two files with one UID that differ, the one whose copy is there stays the one that is copied.
void TestDeidentifiedRuns::secondRunsOfOneUidAgree() {
  QFETCH(QString, copied);
  const QTemporaryDir source, target;
  DicomPicture picture;
  picture.edit = [](DcmDataset& data) { data.putAndInsertString(DCM_SOPInstanceUID, "1.2.3.4.5.1"); };
  for (const char* name : {"a.dcm", "b.dcm"}) {
    picture.pixels = {std::uint16_t(name[0])};
    writeDicom(source.filePath(QString::fromLatin1(name)).toStdString(), picture);
  }
  const auto run = [&](const QString& path) {
    return runProgram({QStringLiteral("export"), path, QStringLiteral("--deidentify"), QStringLiteral("-o"),
                       target.filePath(QStringLiteral("out")), QStringLiteral("--key"),
                       exported_.pathOf("key"), QStringLiteral("--json")});
  };
  QCOMPARE(run(source.filePath(copied)).status, 0);
  const Outcome again = run(source.path());
  QCOMPARE(again.status, 3);
  const QJsonDocument report = QJsonDocument::fromJson(again.out);
  QCOMPARE(report[QStringLiteral("alreadyThere")].toInt(), 1);
  QCOMPARE(report[QStringLiteral("twice")].toInt(), 0);
  QCOMPARE(report[QStringLiteral("leftOut")].toArray().size(), 1);
  const QJsonValue left = report[QStringLiteral("leftOut")][0];
  QFETCH(QString, leftOut);
  QCOMPARE(left[QStringLiteral("path")].toString(), source.filePath(leftOut));
  QCOMPARE(left[QStringLiteral("reason")].toString(),
           QStringLiteral("another file with other contents has the same instance UID"));
}

void TestDeidentifiedRuns::aLostMosaicIsTold() {
  const std::string path = dataPath("dicom-geometry/mr-mosaic-siemens/axasc35.dcm");
  NEED_DATA(path);
  const Outcome a = exported_.run(QString::fromStdString(path), {QStringLiteral("--json")});
  QCOMPARE(a.status, 0);
  QVERIFY2(a.err.contains("mosaic form no volume any more"), a.err);
  QCOMPARE(QJsonDocument::fromJson(a.out)[QStringLiteral("withoutMosaic")].toArray().size(), 1);
}

void TestDeidentifiedRuns::noEmptyFolderIsLeft() {
  const QTemporaryDir source;
  QFile text(source.filePath(QStringLiteral("a.txt")));
  QVERIFY(text.open(QIODevice::WriteOnly) && text.write("no DICOM") > 0);
  text.close();
  const Outcome a = exported_.run(source.path());
  QCOMPARE(a.status, 1);
  QVERIFY2(a.err.contains("holds no DICOM files"), a.err);
  QVERIFY(!QFile::exists(exported_.folder()));
}

void TestDeidentifiedRuns::originalsAreNoTarget() {
  const QTemporaryDir source;
  const QString path = source.filePath(QStringLiteral("a.dcm"));
  writeDicom(path.toStdString(), {});
  for (const QString& from : {source.path(), path}) {
    const Outcome a =
        runProgram({QStringLiteral("export"), from, QStringLiteral("--deidentify"), QStringLiteral("-o"),
                    source.path(), QStringLiteral("--key"), exported_.pathOf("key")});
    QCOMPARE(a.status, 2);
    QVERIFY2(a.err.contains("is among the originals"), a.err);
  }
  QCOMPARE(copiesIn(source.path()), QStringList{path});
}

// The last file is larger than the limit. How many files are written before it depends on chance.
void TestDeidentifiedRuns::copiesOfAFullDiskAreCounted() {
  constexpr int small = 20, side = 512;
  const QTemporaryDir source, target;
  DicomPicture picture;
  for (int n = 0; n < small; ++n)
    writeDicom(source.filePath(QStringLiteral("%1.dcm").arg(n, 2, 10, QLatin1Char('0'))).toStdString(),
               picture);
  picture.columns = picture.rows = side;
  writeDicom(source.filePath(QStringLiteral("large.dcm")).toStdString(), picture);
  const QString folder = target.filePath(QStringLiteral("out"));
  const Outcome a =
      runProgram({QStringLiteral("export"), source.path(), QStringLiteral("--deidentify"),
                  QStringLiteral("-o"), folder, QStringLiteral("--key"), exported_.pathOf("key")},
                 [] {
                   constexpr rlim_t most = 100 << 10;
                   const rlimit few{most, most};
                   ::setrlimit(RLIMIT_FSIZE, &few);
                 });
  QCOMPARE(a.status, 1);
  const qsizetype copies = copiesIn(folder).size();
  const QByteArray said = "Copies of " + QByteArray::number(copies) + " of 21 files are in ";
  QCOMPARE(a.err.contains(said), copies > 0);
  QCOMPARE(QFile::exists(folder), copies > 0);
}

VOLUMEN_TEST(TestDeidentifiedRuns);
#include "tst_deidentified_runs.moc"
