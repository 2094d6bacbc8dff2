// Guards `volumen archive receive`: what peers send is kept whole, as they sent it and once; whom it answers.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>

#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QTcpServer>
#include <QTemporaryDir>
#include <memory>

#include "io/archive/offered_contexts.h"
#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/pdus.h"
#include "tests/unit/archive/receiver.h"
#include "tests/unit/io/dicom_writer.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestArchiveReceive : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void instancesAreKeptAsSent_data();
  void instancesAreKeptAsSent();
  void allClassesButOtherServicesAreStored_data();
  void allClassesButOtherServicesAreStored();
  void onlyThoseWhoMayAreAnswered_data();
  void onlyThoseWhoMayAreAnswered();
  void peersAtOnceLoseNothing();
  void anInstanceIsKeptOnce();
  void instancesThatCannotBeFiledAreRefused_data();
  void instancesThatCannotBeFiledAreRefused();
  void namesFromPeersAreNoPaths();
  void whatCameIsInTheIndex();
  void eachInstanceIsALineOfJson();
  void whatHindersListeningIsExplained();

 private:
  QString in(const char* name) const { return folder_.filePath(QLatin1String(name)); }
  QString write(const char* name, const char* study, const char* instance, const char* patient = "DOE^JANE",
                int side = 4) const {
    return writeImage(in(name), study, instance, patient, side);
  }

  QTemporaryDir folder_;
};

void TestArchiveReceive::initTestCase() {
  for (const char* program : {"storescu", "echoscu"})
    if (QStandardPaths::findExecutable(QLatin1String(program)).isEmpty())
      QSKIP("storescu and echoscu are not installed (package dcmtk)");
}

void TestArchiveReceive::instancesAreKeptAsSent_data() {
  QTest::addColumn<QByteArray>("syntax");
  QTest::addColumn<QString>("option");  // of storescu, which proposes the syntax
  const auto row = [](const char* name, const char* syntax, const char* option) {
    QTest::newRow(name) << QByteArray(syntax) << QString::fromLatin1(option);
  };
  row("implicit", UID_LittleEndianImplicitTransferSyntax, "-xi");
  row("explicit", UID_LittleEndianExplicitTransferSyntax, "-xe");
  row("big endian", UID_BigEndianExplicitTransferSyntax, "-xb");
  row("RLE", UID_RLELosslessTransferSyntax, "-xr");
  row("JPEG lossless", UID_JPEGProcess14SV1TransferSyntax, "-xs");
  row("JPEG-LS", UID_JPEGLSLosslessTransferSyntax, "-xt");
}

void TestArchiveReceive::instancesAreKeptAsSent() {
  QFETCH(QByteArray, syntax);
  QFETCH(QString, option);
  const QString sent = in("sent.dcm");
  DicomPicture picture{.columns = 64, .rows = 64};
  for (int n = 0; n < 64 * 64; ++n) picture.pixels.push_back(std::uint16_t(n * 7));
  writeDicom(sent.toStdString(), picture, syntax);
  Receiver receiver;
  QVERIFY(receiver.start());
  QCOMPARE(receiver.send({sent}, {option}), 0);
  QCOMPARE(receiver.files().size(), 1);
  const QString kept = receiver.files().first();
  QVERIFY(!dataSetIn(contentsOf(sent)).isEmpty() &&
          dataSetIn(contentsOf(kept)) == dataSetIn(contentsOf(sent)));
  QVERIFY(contentsOf(kept).left(400).contains(syntax));
  QCOMPARE(receiver.interrupted(), QByteArray("STORESCU (127.0.0.1): 1 image received.\n"));
}

void TestArchiveReceive::allClassesButOtherServicesAreStored_data() {
  QTest::addColumn<QByteArray>("sopClass");
  QTest::addColumn<bool>("isStored");
  QTest::newRow("CT") << QByteArray(UID_CTImageStorage) << true;
  QTest::newRow("a class of the future") << QByteArray("1.2.840.10008.5.1.4.1.1.999") << true;
  QTest::newRow("colour palettes") << QByteArray(UID_ColorPaletteStorage) << true;
  QTest::newRow("a private class") << QByteArray("1.3.12.2.1107.5.9.1") << true;
  QTest::newRow("a search") << QByteArray(UID_FINDStudyRootQueryRetrieveInformationModel) << false;
  QTest::newRow("storage commitment") << QByteArray(UID_StorageCommitmentPushModelSOPClass) << false;
  QTest::newRow("a performed step") << QByteArray(UID_ModalityPerformedProcedureStepSOPClass) << false;
  QTest::newRow("printing") << QByteArray(UID_BasicGrayscalePrintManagementMetaSOPClass) << false;
}

void TestArchiveReceive::allClassesButOtherServicesAreStored() {
  QFETCH(QByteArray, sopClass);
  QFETCH(bool, isStored);
  QCOMPARE(volumen::isStorageClass(sopClass.toStdString()), isStored);
}

void TestArchiveReceive::onlyThoseWhoMayAreAnswered_data() {
  QTest::addColumn<QByteArray>("fields");
  QTest::addColumn<QString>("calling");
  QTest::addColumn<QString>("called");
  QTest::addColumn<QByteArray>("told");
  const auto row = [](const char* name, const char* fields, const char* calling, const char* called,
                      const char* told) {
    QTest::newRow(name) << QByteArray(fields) << QString::fromLatin1(calling) << QString::fromLatin1(called)
                        << QByteArray(told);
  };
  const char* const verified = "verified that volumen answers.";
  row("anyone", "", "ANYONE", "VOLUMEN", verified);
  row("a peer", R"(, "peers": ["PACS", "CT 1"])", "CT 1", "VOLUMEN", verified);
  row("our own title", R"(, "ae": "READING ROOM 2")", "PACS", "READING ROOM 2", verified);
  row("another title", "", "PACS", "NOBODY", "was rejected: it calls \"NOBODY\", not \"VOLUMEN\".");
  row("another case", "", "PACS", "Volumen", "was rejected: it calls \"Volumen\", not \"VOLUMEN\".");
  row("no peer", R"(, "peers": ["PACS"])", "CT 1", "VOLUMEN", "was rejected: it is none of the \"peers\".");
}

void TestArchiveReceive::onlyThoseWhoMayAreAnswered() {
  QFETCH(QByteArray, fields);
  QFETCH(QString, calling);
  QFETCH(QString, called);
  QFETCH(QByteArray, told);
  Receiver receiver(fields);
  QVERIFY(receiver.start());
  const int status = receiver.echo({QStringLiteral("-aet"), calling, QStringLiteral("-aec"), called});
  QCOMPARE(status == 0, told.startsWith("verified"));
  QCOMPARE(receiver.interrupted(), calling.toUtf8() + " (127.0.0.1): " + told + '\n');
}

void TestArchiveReceive::peersAtOnceLoseNothing() {
  constexpr int peers = 4, images = 25;
  Receiver receiver;
  QVERIFY(receiver.start());
  std::vector<std::unique_ptr<QProcess>> sending;
  for (int peer = 0; peer < peers; ++peer) {
    QStringList files;
    for (int n = 0; n < images; ++n) {
      const QByteArray uid = QByteArray::number(peer) + '.' + QByteArray::number(n);
      files << write("p" + uid, "1.2.3", "1.2.3.1." + uid);
    }
    files << write("shared.dcm", "1.2.3", "1.2.3.1.9");
    QProcess& process = *sending.emplace_back(std::make_unique<QProcess>());
    process.setStandardOutputFile(QProcess::nullDevice());
    process.setStandardErrorFile(QProcess::nullDevice());
    process.start(QStringLiteral("storescu"), receiver.call() + files);
  }
  for (const auto& process : sending) {
    QVERIFY(process->waitForFinished(60000));
    QCOMPARE(process->exitCode(), 0);
  }
  QCOMPARE(receiver.files().size(), peers * images + 1);
  QCOMPARE(receiver.interrupted().count("; 1 image here already."), peers - 1);
}

void TestArchiveReceive::anInstanceIsKeptOnce() {
  const QString one = write("one.dcm", "1.2.3", "1.2.3.1.1");
  const QString other = write("other.dcm", "1.2.3", "1.2.3.1.1", "DOE^JOHN");
  Receiver receiver;
  QVERIFY(receiver.start());
  QCOMPARE(receiver.send({one}), 0);
  QCOMPARE(receiver.send({one}, {QStringLiteral("-aet"), QStringLiteral("AGAIN")}), 0);
  QVERIFY(receiver.send({other}) != 0);
  QCOMPARE(receiver.files().size(), 1);
  QCOMPARE(dataSetsBelow(receiver.output()), QList<QByteArray>{dataSetIn(contentsOf(one))});
  QCOMPARE(receiver.interrupted(),
           QByteArray("STORESCU (127.0.0.1): 1 image received.\n"
                      "AGAIN (127.0.0.1): 1 image here already.\n"
                      "STORESCU (127.0.0.1): 1 image refused; another image with the UID 1.2.3.1.1 is here "
                      "already.\n"));
}

void TestArchiveReceive::instancesThatCannotBeFiledAreRefused_data() {
  QTest::addColumn<QByteArray>("fields");
  QTest::addColumn<QByteArray>("study");
  QTest::addColumn<int>("side");
  QTest::addColumn<QByteArray>("told");
  QTest::newRow("no study") << QByteArray() << QByteArray() << 4
                            << QByteArray("1 image refused; an image has no StudyInstanceUID.");
  QTest::newRow("too large") << QByteArray(R"(, "mostMegabytes": 1)") << QByteArray("1.2.3") << 1024
                             << QByteArray(
                                    "was cut off: its image has more than 1 megabytes "
                                    "(\"mostMegabytes\").");
}

void TestArchiveReceive::instancesThatCannotBeFiledAreRefused() {
  QFETCH(QByteArray, fields);
  QFETCH(QByteArray, study);
  QFETCH(int, side);
  QFETCH(QByteArray, told);
  Receiver receiver(fields);
  QVERIFY(receiver.start());
  QVERIFY(receiver.send({write("odd.dcm", study, "1.2.3.1.1", "DOE^JANE", side)}) != 0);
  QVERIFY(receiver.files().isEmpty());
  QCOMPARE(receiver.interrupted(), "STORESCU (127.0.0.1): " + told + '\n');
}

void TestArchiveReceive::namesFromPeersAreNoPaths() {
  Receiver receiver;
  QVERIFY(receiver.start());
  QCOMPARE(receiver.send({write("path.dcm", "../../../../x", "../../x")}), 0);
  QCOMPARE(receiver.files().size(), 1);
  const QString name = receiver.files().first().mid(receiver.output().size());
  static const QRegularExpression hashes(QStringLiteral("^/[0-9a-f]{32}/[0-9a-f]{32}/[0-9a-f]{32}\\.dcm$"));
  QVERIFY2(hashes.match(name).hasMatch(), qPrintable(name));
}

void TestArchiveReceive::whatCameIsInTheIndex() {
  Receiver receiver;
  QVERIFY(receiver.startIntoIndex());
  QCOMPARE(receiver.send({write("first.dcm", "1.2.3", "1.2.3.1.1")}), 0);
  QTRY_COMPARE_WITH_TIMEOUT(uidsOf(receiver.studies()), QStringList{QStringLiteral("1.2.3")}, 20000);
  QCOMPARE(receiver.send({write("second.dcm", "1.2.4", "1.2.4.1.1")}), 0);
  QVERIFY(receiver.endsBy(SIGINT));
  QCOMPARE(uidsOf(receiver.studies()), (QStringList{QStringLiteral("1.2.3"), QStringLiteral("1.2.4")}));
}

void TestArchiveReceive::eachInstanceIsALineOfJson() {
  Receiver receiver;
  QVERIFY(receiver.start({QStringLiteral("--json")}));
  QCOMPARE(receiver.send({write("a.dcm", "1.2.3", "1.2.3.1.1"), write("b.dcm", "1.2.3", "1.2.3.1.2")}), 0);
  const QList<QByteArray> lines = receiver.interrupted().trimmed().split('\n');
  QCOMPARE(lines.size(), 2);
  const QJsonObject second = QJsonDocument::fromJson(lines[1]).object();
  QCOMPARE(second[QStringLiteral("sopInstanceUid")].toString(), QStringLiteral("1.2.3.1.2"));
  QCOMPARE(second[QStringLiteral("callingAe")].toString(), QStringLiteral("STORESCU"));
  QVERIFY(receiver.files().contains(second[QStringLiteral("path")].toString()));
}

void TestArchiveReceive::whatHindersListeningIsExplained() {
  QTcpServer other;
  QVERIFY(other.listen(QHostAddress::LocalHost));
  const auto receive = [&](const QByteArray& list) {
    QFile file(in("archives.json"));
    if (!file.open(QIODevice::WriteOnly) || file.write(list) < 0) return Outcome{};
    file.close();
    return runProgram({QStringLiteral("archive"), QStringLiteral("receive"), QStringLiteral("--archives"),
                       file.fileName(), QStringLiteral("-o"), in("nothing")});
  };
  const QByteArray port = QByteArray::number(other.serverPort());
  const Outcome used = receive("{\"listen\": {\"port\": " + port + "}}");
  QCOMPARE(used.status, 1);
  QVERIFY2(used.err.contains("Port " + port + " of 127.0.0.1 is in use: "), used.err);
  const Outcome elsewhere = receive(R"({"listen": {"address": "192.0.2.1"}})");
  QCOMPARE(elsewhere.status, 1);
  QVERIFY2(elsewhere.err.contains("192.0.2.1 is no address of this machine"), elsewhere.err);
  const Outcome none = receive("{}");
  QCOMPARE(none.status, 1);
  QVERIFY2(none.err.contains("archives.json does not say where to listen: add \"listen\": "), none.err);
}

VOLUMEN_TEST(TestArchiveReceive);
#include "tst_archive_receive.moc"
