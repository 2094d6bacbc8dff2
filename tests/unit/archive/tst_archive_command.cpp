// Guards `volumen archive`: searching real archives (dcmqrscp, Orthanc by DIMSE and by DICOMweb), and the
// sentence on each thing that can be wrong with a peer.
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QRegularExpression>
#include <memory>

#include "tests/fixtures/program.h"
#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/orthanc_peer.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestArchiveCommand : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void studiesAreFound_data();
  void studiesAreFound();
  void answersAreShapedAsThoseOfTheIndex();
  void seriesAreListed();
  void aLimitIsTold();
  void nothingFoundIsNoFailure();
  void peersThatFailAreExplained_data();
  void peersThatFailAreExplained();
  void aSilentPeerIsLeftAfterTenSeconds();
  void wrongUsageIsRefused_data();
  void wrongUsageIsRefused();

 private:
  QStringList with(const QString& command, const QStringList& more) const {
    return QStringList{QStringLiteral("archive"), command, QStringLiteral("--archives"), file_} + more;
  }
  void list(const QByteArray& name, int port, const QByteArray& calledAe, const QByteArray& more = {});
  void startOrthanc();
  QJsonArray studies(const QStringList& words, const QString& archive = QStringLiteral("qr")) const;

  QTemporaryDir folder_;
  QString file_;
  QStringList archives_;
  std::unique_ptr<QrPeer> peer_;
  std::unique_ptr<OrthancPeer> orthanc_;  // null if it is not installed
};

namespace {

QStringList wordsOf(const char* words) {
  return QString::fromUtf8(words).split(QLatin1Char(' '), Qt::SkipEmptyParts);
}

}  // namespace

void TestArchiveCommand::list(const QByteArray& name, int port, const QByteArray& calledAe,
                              const QByteArray& more) {
  archives_ << QString::fromUtf8(
      "{\"name\": \"" + name + R"(", "kind": "dimse", "host": "127.0.0.1", "port": )" +
      QByteArray::number(port) + ", \"calledAe\": \"" + calledAe + '"' + more + '}');
  QFile out(file_);
  QVERIFY(out.open(QIODevice::WriteOnly));
  out.write("{\"archives\": [" + archives_.join(QStringLiteral(", ")).toUtf8() + "]}");
}

QJsonArray TestArchiveCommand::studies(const QStringList& words, const QString& archive) const {
  const Outcome done = runProgram(
      with(QStringLiteral("query"), QStringList{archive} + words + QStringList{QStringLiteral("--json")}));
  if (done.status != 0) qCritical("%s", done.err.constData());
  return QJsonDocument::fromJson(done.out)[QStringLiteral("studies")].toArray();
}

void TestArchiveCommand::initTestCase() {
  file_ = folder_.filePath(QStringLiteral("archives.json"));
  if (!QrPeer::isInstalled()) QSKIP("dcmqrscp is not installed (package dcmtk)");
  peer_ = std::make_unique<QrPeer>();
  peer_->add(writeAllArchived(folder_.path()));
  QVERIFY(peer_->start());
  startOrthanc();
  list("qr", peer_->port(), "ARCH");
}

void TestArchiveCommand::startOrthanc() {
  if (!OrthancPeer::isInstalled()) return;
  orthanc_ = std::make_unique<OrthancPeer>();
  QVERIFY(orthanc_->start());
  orthanc_->add(QDir(folder_.path())
                    .entryList({QStringLiteral("*.dcm")})
                    .replaceInStrings(QRegularExpression(QStringLiteral("^")), folder_.path() + u'/'));
  list("orthanc", orthanc_->port(), "ORTHANC");
  archives_ << QStringLiteral(R"({"name": "web", "kind": "dicomweb", "url": "%1", "user": "alice",
      "passwordCommand": "echo secret"})")
                   .arg(orthanc_->url());
}

void TestArchiveCommand::studiesAreFound_data() {
  QTest::addColumn<QString>("archive");
  QTest::addColumn<QStringList>("words");
  QTest::addColumn<QStringList>("uids");
  const auto row = [](const char* name, const char* words, const char* uids) {
    for (const char* archive : {"qr", "orthanc", "web"})
      QTest::addRow("%s, %s", name, archive)
          << QString::fromLatin1(archive) << wordsOf(words) << wordsOf(uids);
  };
  row("all", "", "1.2.1 1.2.2 1.2.3 1.2.4 1.2.5 1.2.6");
  row("small letters", "doe", "1.2.1 1.2.2");
  row("capitals", "DOE", "1.2.1 1.2.2");
  row("two words", "doe brain", "1.2.2");
  row("part of an ID", "id3", "1.2.3");
  row("a description", "thorax", "1.2.1");
  row("a modality", "ct", "1.2.1 1.2.3 1.2.5");
  row("a modality and a name", "ct doe", "1.2.1");
  row("a year", "2026", "1.2.1 1.2.2");
  row("a year and a name", "2026 jane", "1.2.1");
  row("family name and given name", "Doe, John", "1.2.2");
  row("a word that is a command", "import", "");
  row("a day", "2026-03-14", "1.2.1");
  row("a month", "2026-03", "1.2.1 1.2.2");
  row("a range", "20240101-20251231", "1.2.3 1.2.4");
  row("Latin 1", "jérôme", "1.2.3");
  row("the whole name", "buc^jérôme", "1.2.3");
  row("Cyrillic", "люкceмбypг", "1.2.4");
  row("Japanese", "やまだ", "1.2.5");
  row("Hebrew", "שרון", "1.2.6");
  row("a wildcard", "d?e", "1.2.1 1.2.2");
  row("a wildcard in a description", "d*e", "1.2.1 1.2.2 1.2.3");
}

void TestArchiveCommand::studiesAreFound() {
  QFETCH(QString, archive);
  if (archive != u"qr" && !orthanc_) QSKIP("Orthanc is not installed (packages orthanc, orthanc-dicomweb)");
  QFETCH(QStringList, words);
  QFETCH(QStringList, uids);
  QCOMPARE(uidsOf(studies(words, archive)), uids);
}

void TestArchiveCommand::answersAreShapedAsThoseOfTheIndex() {
  const QJsonArray found = studies({QStringLiteral("PID3")});
  QCOMPARE(found.size(), 1);
  const QJsonObject study = found[0].toObject();
  QCOMPARE(study[QStringLiteral("patient")].toObject()[QStringLiteral("name")].toString(),
           QStringLiteral("Buc^Jérôme"));
  QCOMPARE(study[QStringLiteral("date")].toString(), QStringLiteral("2025-01-01"));
  QCOMPARE(study[QStringLiteral("number")].toInt(), 1);
  // dcmqrscp does not tell how many there are.
  QVERIFY(study[QStringLiteral("images")].isNull());
  const QString folder = folder_.filePath(QStringLiteral("index"));
  QCOMPARE(runProgram({QStringLiteral("import"), QStringLiteral("--index"), folder,
                       folder_.filePath(QStringLiteral("1.2.3.1.dcm"))})
               .status,
           0);
  const Outcome listed =
      runProgram({QStringLiteral("list"), QStringLiteral("--index"), folder, QStringLiteral("--json")});
  const QJsonObject indexed =
      QJsonDocument::fromJson(listed.out)[QStringLiteral("studies")].toArray()[0].toObject();
  QCOMPARE(study.keys(), indexed.keys());
}

void TestArchiveCommand::seriesAreListed() {
  const QJsonArray found = studies({QStringLiteral("jane"), QStringLiteral("--series")});
  QCOMPARE(found.size(), 1);
  QCOMPARE(found[0].toObject()[QStringLiteral("series")].toArray().size(), 2);
  QCOMPARE(found[0].toObject()[QStringLiteral("modalities")].toString(), QStringLiteral("CT"));
}

void TestArchiveCommand::aLimitIsTold() {
  const Outcome done = runProgram(
      with(QStringLiteral("query"), {QStringLiteral("qr"), QStringLiteral("--limit"), QStringLiteral("2")}));
  QCOMPARE(done.status, 0);
  QCOMPARE(done.out.count('\n'), 3);
  QCOMPARE(done.err, QByteArray("volumen: The archive \"qr\" may have more studies: only the first that it "
                                "sent are listed. Add a word or a "
                                "date.\n"));
}

void TestArchiveCommand::nothingFoundIsNoFailure() {
  const Outcome done =
      runProgram(with(QStringLiteral("query"), {QStringLiteral("qr"), QStringLiteral("nobody")}));
  QCOMPARE(done.status, 0);
  QCOMPARE(done.err, QByteArray("No study has all of these words.\n"));
  QCOMPARE(studies({QStringLiteral("nobody")}).size(), 0);
}

void TestArchiveCommand::peersThatFailAreExplained_data() {
  QTest::addColumn<QByteArray>("name");
  QTest::addColumn<QByteArray>("sentence");
  QTest::newRow("an AE title that is not known")
      << QByteArray("called") << QByteArray("does not go by the AE title NOBODY: correct \"calledAe\".");
  QTest::newRow("no listener") << QByteArray("closed")
                               << QByteArray("cannot be reached: Connection refused.");
  QTest::newRow("an unknown host") << QByteArray("host")
                                   << QByteArray("cannot be found: no address is known for this host.");
  QTest::newRow("HTTP") << QByteArray("http")
                        << QByteArray("does not answer in DICOM: is this the port of another service");
  QTest::newRow("a peer that hangs up")
      << QByteArray("hangs up")
      << QByteArray("ends the connection at once: it may expect TLS, or not know our");
  QTest::newRow("TLS on a plain port") << QByteArray("tls") << QByteArray("does not agree on TLS: ");
  QTest::newRow("an unknown name") << QByteArray("nobody") << QByteArray("There is no archive \"nobody\"");
}

void TestArchiveCommand::peersThatFailAreExplained() {
  QFETCH(QByteArray, name);
  QFETCH(QByteArray, sentence);
  const FakePeer http([](QTcpSocket& socket) {
    socket.waitForReadyRead(1000);
    socket.write("HTTP/1.1 400 Bad Request\r\nConnection: close\r\n\r\n");
    socket.disconnectFromHost();
    socket.waitForDisconnected(1000);
  });
  const FakePeer hangsUp([](QTcpSocket& socket) { socket.abort(); });
  archives_.clear();
  list("called", peer_->port(), "NOBODY");
  list("closed", freePort(), "ARCH");
  list("http", http.port(), "ARCH");
  list("hangs up", hangsUp.port(), "ARCH");
  list("tls", peer_->port(), "ARCH", ", \"tls\": {\"pin\": \"" + QByteArray(64, '0') + "\"}");
  archives_ << QStringLiteral(
      R"({"name": "host", "kind": "dimse", "host": "no.such.host.invalid", "calledAe": "A"})");
  list("last", freePort(), "ARCH");
  const Outcome done = runProgram(with(QStringLiteral("test"), {QString::fromUtf8(name)}));
  QCOMPARE(done.status, 1);
  QVERIFY2(done.err.contains(sentence), done.err);
  QCOMPARE(done.err.count('\n'), 1);
  QVERIFY(done.out.isEmpty());
}

void TestArchiveCommand::aSilentPeerIsLeftAfterTenSeconds() {
  const FakePeer silent([](QTcpSocket& socket) { socket.waitForDisconnected(30000); });
  archives_.clear();
  list("silent", silent.port(), "ARCH");
  const Outcome done = runProgram(with(QStringLiteral("test"), {QStringLiteral("silent")}));
  QCOMPARE(done.status, 1);
  QVERIFY2(done.err.contains("does not answer within 10 s."), done.err);
}

void TestArchiveCommand::wrongUsageIsRefused_data() {
  QTest::addColumn<QStringList>("words");
  QTest::addColumn<QByteArray>("sentence");
  const auto row = [](const char* name, const char* words, const char* sentence) {
    QTest::newRow(name) << wordsOf(words) << QByteArray(sentence);
  };
  row("no command", "", "Missing COMMAND: list, test, query, fetch, keep, send, receive.");
  row("no name", "query", "Missing NAME: the archive's name");
  row("an unknown option", "query qr --seires", "Unknown option --seires. Did you mean --series?");
  row("no such file", "list --archives nowhere.json", "nowhere.json cannot be read: no such file.");
  row("limit 0", "query qr --limit 0", "\"0\" is not a whole number from 1 to 1000000.");
}

void TestArchiveCommand::wrongUsageIsRefused() {
  QFETCH(QStringList, words);
  QFETCH(QByteArray, sentence);
  const Outcome done = runProgram(QStringList{QStringLiteral("archive")} + words);
  QCOMPARE(done.status, words.contains(QLatin1String("nowhere.json")) ? 1 : 2);
  QVERIFY2(done.err.contains(sentence), done.err);
}

VOLUMEN_TEST(TestArchiveCommand);
#include "tst_archive_command.moc"
