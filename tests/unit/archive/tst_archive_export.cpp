// Guards `volumen export -o archive:NAME`: what is written is sent to the archive, and nothing of it stays
// here. Orthanc takes each object and gives it back as it is.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QDir>
#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>
#include <map>

#include "tests/fixtures/program.h"
#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/orthanc_peer.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestArchiveExport : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void whatIsWrittenIsSent_data();
  void whatIsWrittenIsSent();
  void orthancGivesEachBack_data() { whatIsWrittenIsSent_data(); }
  void orthancGivesEachBack();
  void whatIsNotTakenIsTold();
  void warningsOfCopiesNameTheArchive();
  void wrongNamesAreRefusedAtOnce_data();
  void wrongNamesAreRefusedAtOnce();
  void cleanup();

 private:
  void list(int port) const;  // lists an archive "to"
  // Runs the command with an archive "to" at this port.
  Outcome exported(int port, const QString& source, const QString& options) const;
  QString at(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }

  QTemporaryDir folder_;
  QString image_;  // SOP Instance UID of one
};

namespace {

// Returns what a file says in an attribute; empty if it cannot be read.
QString saidBy(const QString& path, const DcmTagKey& tag) {
  DcmFileFormat file;
  OFString value;
  if (file.loadFile(OFFilename(path.toUtf8().constData())).good())
    (void)file.getDataset()->findAndGetOFString(tag, value);
  return QString::fromLatin1(value.c_str());
}

}  // namespace

void TestArchiveExport::initTestCase() {
  if (!QrPeer::isInstalled()) QSKIP("storescp is not installed (package dcmtk)");
  const Outcome a = runProgram(
      {QStringLiteral("convert"), QStringLiteral("phantom:ct-head:24"), QStringLiteral("-o"), at("scans/")});
  QVERIFY2(a.status == 0, a.err);
  for (const char* name : {"volumen", "temporary"}) QVERIFY(QDir(folder_.path()).mkdir(QLatin1String(name)));
  QFile shapes(at("shapes.json"));
  QVERIFY(shapes.open(QIODevice::WriteOnly) &&
          shapes.write(R"([{"kind": "length", "points": [[0, 0, 0], [10, 0, 0]]}])") > 0);
  const Outcome b = runProgram({QStringLiteral("segment"), at("scans"), QStringLiteral("--range"),
                                QStringLiteral("300:"), QStringLiteral("-o"), at("segments.seg.nrrd")});
  QVERIFY2(b.status == 0, b.err);
  QFile document(at("document.pdf"));
  QVERIFY(document.open(QIODevice::WriteOnly) && document.write("%PDF-1.4\n%%EOF\n") > 0);
  image_ = saidBy(filesBelow(at("scans"))[0], DCM_SOPInstanceUID);
  QVERIFY(!image_.isEmpty());
  qputenv("XDG_CONFIG_HOME", folder_.path().toUtf8());
  qputenv("TMPDIR", at("temporary").toUtf8());
}

// The temporary folder is gone in every case.
void TestArchiveExport::cleanup() {
  QVERIFY(QDir(at("temporary")).isEmpty(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot));
}

void TestArchiveExport::list(int port) const {
  QFile file(at("volumen/archives.json"));
  if (file.open(QIODevice::WriteOnly))
    file.write(R"({"archives": [{"name": "to", "kind": "dimse", "host": "127.0.0.1", "port": )" +
               QByteArray::number(port) + R"(, "calledAe": "ANY"}]})");
}

Outcome TestArchiveExport::exported(int port, const QString& source, const QString& options) const {
  list(port);
  const QString given = QString(options)
                            .replace(QLatin1String("SHAPES"), at("shapes.json"))
                            .replace(QLatin1String("SEGMENTS"), at("segments.seg.nrrd"))
                            .replace(QLatin1String("DOCUMENT"), at("document.pdf"))
                            .replace(QLatin1String("UID"), image_);
  return runProgram(QStringList{QStringLiteral("export"), source} + given.split(QLatin1Char(' ')));
}

void TestArchiveExport::whatIsWrittenIsSent_data() {
  QTest::addColumn<QString>("options");
  QTest::addColumn<int>("instances");
  QTest::addColumn<QByteArray>("modality");
  QTest::newRow("a report") << QStringLiteral("--as sr --roi SHAPES") << 1 << QByteArray("SR");
  QTest::newRow("key images") << QStringLiteral("--as ko --images UID") << 1 << QByteArray("KO");
  QTest::newRow("a window") << QStringLiteral("--as gsps --window 40,400") << 1 << QByteArray("PR");
  QTest::newRow("segments") << QStringLiteral("--as seg --segments SEGMENTS") << 1 << QByteArray("SEG");
  QTest::newRow("structures") << QStringLiteral("--as rtstruct --segments SEGMENTS") << 1
                              << QByteArray("RTSTRUCT");
  QTest::newRow("a rendering") << QStringLiteral("--as sc --size 32x32") << 1 << QByteArray("OT");
  QTest::newRow("a document") << QStringLiteral("--as pdf --pdf DOCUMENT") << 1 << QByteArray("DOC");
  QTest::newRow("a series") << QStringLiteral("--as series --plane coronal --at 0") << 1 << QByteArray("CT");
  QTest::newRow("copies without identity")
      << QStringLiteral("--deidentify") << int(filesBelow(at("scans")).size()) << QByteArray("CT");
}

void TestArchiveExport::whatIsWrittenIsSent() {
  QFETCH(QString, options);
  QFETCH(int, instances);
  QFETCH(QByteArray, modality);
  const StorePeer peer;
  QVERIFY(peer.isListening);
  const int known = int(filesBelow(at("scans")).size());
  const Outcome sent = exported(peer.port(), at("scans"), options + QStringLiteral(" -o archive:to"));
  QVERIFY2(sent.status == 0, sent.err);
  QCOMPARE(sent.out,
           QByteArray("Sent %1 of %1 instances to to\n").replace("%1", QByteArray::number(instances)));
  const QStringList kept = filesBelow(peer.folder());
  QCOMPARE(kept.size(), instances);
  QCOMPARE(filesBelow(at("scans")).size(), known);
  QCOMPARE(saidBy(kept[0], DCM_Modality).toLatin1(), modality);
}

void TestArchiveExport::orthancGivesEachBack() {
  if (!OrthancPeer::isInstalled()) QSKIP("Orthanc is not installed (package orthanc)");
  QFETCH(QString, options);
  OrthancPeer orthanc;
  QVERIFY(orthanc.start());
  const QTemporaryDir row;
  const bool isNamed = options.contains(QStringLiteral("SEGMENTS"));  // its name chooses the format
  const QString written = row.filePath(isNamed ? QStringLiteral("written.dcm") : QStringLiteral("written")),
                back = row.filePath(QStringLiteral("back"));
  const Outcome made = exported(orthanc.port(), at("scans"), options + QStringLiteral(" -o ") + written);
  QVERIFY2(made.status == 0, made.err);
  const QStringList files = QFileInfo(written).isDir() ? filesBelow(written) : QStringList{written};
  const auto archive = [](const QStringList& words) {
    return runProgram(QStringList{QStringLiteral("archive")} + words);
  };
  const Outcome sent = archive({QStringLiteral("send"), QStringLiteral("to"), written});
  QVERIFY2(sent.status == 0, sent.err);
  const QString study = saidBy(files[0], DCM_StudyInstanceUID);
  const Outcome fetched =
      archive({QStringLiteral("fetch"), QStringLiteral("to"), study, QStringLiteral("-o"), back});
  QVERIFY2(fetched.status == 0, fetched.err);
  std::map<QString, QString> returned;  // files by instance
  for (const QString& file : filesBelow(back)) returned[saidBy(file, DCM_SOPInstanceUID)] = file;
  QCOMPARE(returned.size(), std::size_t(files.size()));
  for (const QString& file : files) {
    DcmFileFormat one, other;
    QVERIFY(one.loadFile(OFFilename(file.toUtf8().constData())).good());
    QVERIFY(
        other.loadFile(OFFilename(returned[saidBy(file, DCM_SOPInstanceUID)].toUtf8().constData())).good());
    QVERIFY2(one.getDataset()->compare(*other.getDataset()) == 0, qPrintable(file));
  }
}

void TestArchiveExport::whatIsNotTakenIsTold() {
  const StorePeer peer({QStringLiteral("--abort-during")});
  QVERIFY(peer.isListening);
  const QString options = QStringLiteral("--as series --plane coronal --at 0 --json -o archive:to");
  const Outcome sent = exported(peer.port(), at("scans"), options);
  QCOMPARE(sent.status, 1);
  QVERIFY2(sent.err.contains("ended the connection."), sent.err);
  QVERIFY2(sent.err.contains("archive:to") && !sent.err.contains("temporary"), sent.err);
  QVERIFY2(!sent.out.contains("temporary"), sent.out);
  const QJsonObject told = QJsonDocument::fromJson(sent.out).object()[QStringLiteral("archive")].toObject();
  QCOMPARE(told[QStringLiteral("name")].toString(), QStringLiteral("to"));
  QCOMPARE(told[QStringLiteral("instances")].toInt(), 1);
  QCOMPARE(told[QStringLiteral("sent")].toInt(-1), 0);
}

void TestArchiveExport::warningsOfCopiesNameTheArchive() {
  const StorePeer peer;
  QVERIFY(peer.isListening);
  const Outcome sent =
      exported(peer.port(), at("scans"), QStringLiteral("--deidentify --json -o archive:to"));
  QVERIFY2(sent.status == 0, sent.err);
  QVERIFY2(sent.err.contains("A face may be recognised in pictures of a head: archive:to/"), sent.err);
  QVERIFY2(!sent.err.contains("temporary") && !sent.out.contains("temporary"), sent.err + sent.out);
}

void TestArchiveExport::wrongNamesAreRefusedAtOnce_data() {
  QTest::addColumn<QString>("options");
  QTest::addColumn<int>("status");
  QTest::addColumn<QByteArray>("says");
  QTest::newRow("an unknown archive")
      << QStringLiteral("--as series -o archive:other") << 1 << QByteArray("There is no archive \"other\"");
  QTest::newRow("an unknown archive for copies")
      << QStringLiteral("--deidentify -o archive:other") << 1 << QByteArray("There is no archive \"other\"");
  QTest::newRow("an unknown archive for a format without identity")
      << QStringLiteral("--as series --deidentify -o archive:other") << 1
      << QByteArray("There is no archive \"other\"");
  QTest::newRow("a study") << QStringLiteral("--as series -o archive:to/1.2") << 1
                           << QByteArray("There is no archive \"to/1.2\"");
  QTest::newRow("surfaces") << QStringLiteral("--as stl --segments none -o archive:to") << 2
                            << QByteArray("--as stl writes no DICOM");
}

// PATH is not there: so nothing was read.
void TestArchiveExport::wrongNamesAreRefusedAtOnce() {
  QFETCH(QString, options);
  QFETCH(QByteArray, says);
  const Outcome a = exported(1, at("nowhere"), options);
  QTEST(a.status, "status");
  QVERIFY2(a.err.contains(says) && !a.err.contains("nowhere"), a.err);
}

VOLUMEN_TEST(TestArchiveExport);
#include "tst_archive_export.moc"
