// Guards `volumen archive send`: what is sent arrives as it is, and only what an archive keeps counts as
// sent.
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QStandardPaths>

#include "tests/fixtures/program.h"
#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/orthanc_peer.h"
#include "tests/unit/archive/web_peer.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestArchiveSend : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void instancesComeBackAsTheyWere_data();
  void instancesComeBackAsTheyWere();
  void whatIsSentIsDecompressedWhereAPeerTakesNoOther();
  void onlyWhatAnAnswerNamesIsSent_data();
  void onlyWhatAnAnswerNamesIsSent();
  void largeRequestsAreDivided();
  void aPeerThatHangsUpIsTold();
  void wrongPathsAreExplained_data();
  void wrongPathsAreExplained();

 private:
  Outcome archive(const QByteArray& list, const QStringList& words) const;

  QTemporaryDir folder_;
  QString scans_;
  QStringList files_;
};

namespace {

QByteArray dimse(int port, const char* ae = "ANY") {
  return R"({"name": "to", "kind": "dimse", "host": "127.0.0.1", "port": )" + QByteArray::number(port) +
         R"(, "calledAe": ")" + ae + "\"}";
}

QByteArray web(const QByteArray& url, const QByteArray& more = {}) {
  return R"({"name": "to", "kind": "dicomweb", "url": ")" + url + '"' + more + '}';
}

// The SOP Instance UIDs in a request of STOW-RS.
QList<QByteArray> uidsSent(const QByteArray& body) {
  QList<QByteArray> uids;
  for (const ArchivedStudy& study : archivedStudies)
    for (const char* series : {".1", ".2"})
      if (const QByteArray uid = QByteArray(study.uid) + series + ".1"; body.contains(uid)) uids << uid;
  return uids;
}

QByteArray listOf(const char* tag, const QList<QByteArray>& uids, const QByteArray& more = {}) {
  QByteArray items;
  for (const QByteArray& uid : uids)
    items += (items.isEmpty() ? "" : ",") + QByteArray(R"({"00081155": {"vr": "UI", "Value": [")") + uid +
             "\"]}" + more + '}';
  return '"' + QByteArray(tag) + R"(": {"vr": "SQ", "Value": [)" + items + "]}";
}

}  // namespace

void TestArchiveSend::initTestCase() {
  if (!QrPeer::isInstalled()) QSKIP("storescp is not installed (package dcmtk)");
  scans_ = folder_.filePath(QStringLiteral("scans"));
  QVERIFY(QDir().mkpath(scans_));
  files_ = writeAllArchived(scans_);
  QFile other(scans_ + QStringLiteral("/notes.txt"));
  QVERIFY(other.open(QIODevice::WriteOnly) && other.write("No picture.") > 0);
}

Outcome TestArchiveSend::archive(const QByteArray& list, const QStringList& words) const {
  const QString path = folder_.filePath(QStringLiteral("archives.json"));
  QFile file(path);
  if (file.open(QIODevice::WriteOnly)) file.write("{\"archives\": [" + list + "]}");
  file.close();
  return runProgram(QStringList{QStringLiteral("archive")} + words +
                    QStringList{QStringLiteral("--archives"), path});
}

void TestArchiveSend::instancesComeBackAsTheyWere_data() {
  QTest::addColumn<bool>("isWeb");
  QTest::newRow("DIMSE") << false;
  QTest::newRow("DICOMweb") << true;
}

void TestArchiveSend::instancesComeBackAsTheyWere() {
  QFETCH(bool, isWeb);
  if (!OrthancPeer::isInstalled()) QSKIP("Orthanc is not installed (packages orthanc, orthanc-dicomweb)");
  OrthancPeer peer;
  QVERIFY(peer.start());
  const QByteArray list =
      isWeb ? web(peer.url().toUtf8(), R"(, "user": "alice", "passwordCommand": "echo secret")")
            : dimse(peer.port(), "ORTHANC");
  const Outcome sent = archive(list, {QStringLiteral("send"), QStringLiteral("to"), scans_});
  QVERIFY2(sent.status == 0, sent.err);
  QCOMPARE(sent.out, QByteArray("Sent 7 of 7 instances to to; 1 file holds none\n"));
  for (const ArchivedStudy& study : archivedStudies) {
    const QString to =
        folder_.filePath(QStringLiteral("%1 back %2").arg(isWeb).arg(QLatin1String(study.uid)));
    const Outcome fetched = archive(list, {QStringLiteral("fetch"), QStringLiteral("to"),
                                           QString::fromLatin1(study.uid), QStringLiteral("-o"), to});
    QVERIFY2(fetched.status == 0, fetched.err);
    const QStringList back = filesBelow(to);
    QVERIFY(!back.isEmpty());
    for (const QString& file : back) {
      const Instance instance = instanceIn(file);
      QVERIFY(instance == instanceIn(scans_ + u'/' + QString::fromStdString(instance.seriesUid) +
                                     QStringLiteral(".dcm")));
    }
  }
}

void TestArchiveSend::whatIsSentIsDecompressedWhereAPeerTakesNoOther() {
  const QString packed = folder_.filePath(QStringLiteral("packed.dcm"));
  QCOMPARE(QProcess::execute(QStringLiteral("dcmcjpls"), {files_[0], packed}), 0);
  QVERIFY(contentsOf(packed) != contentsOf(files_[0]));
  const StorePeer all({QStringLiteral("+xa")}), plain({QStringLiteral("+xi")});
  QVERIFY(all.isListening && plain.isListening);
  for (const StorePeer* peer : {&all, &plain}) {
    const Outcome sent = archive(dimse(peer->port()), {QStringLiteral("send"), QStringLiteral("to"), packed});
    QVERIFY2(sent.status == 0, sent.err);
    QCOMPARE(filesBelow(peer->folder()).size(), 1);
    QVERIFY(instanceIn(filesBelow(peer->folder())[0]) == instanceIn(files_[0]));
  }
  QCOMPARE(contentsOf(filesBelow(all.folder())[0]).contains("1.2.840.10008.1.2.4.80"), true);
  QCOMPARE(contentsOf(filesBelow(plain.folder())[0]).contains("1.2.840.10008.1.2.4.80"), false);
}

void TestArchiveSend::onlyWhatAnAnswerNamesIsSent_data() {
  QTest::addColumn<QByteArray>("status");
  QTest::addColumn<int>("kept");  // of seven; the others are refused, or left out if negative
  QTest::addColumn<int>("exit");
  QTest::addColumn<QByteArray>("sentence");
  QTest::newRow("all") << QByteArray("200 OK") << 7 << 0 << QByteArray();
  QTest::newRow("some refused") << QByteArray("202 Accepted") << 5 << 3
                                << QByteArray("refuses it: it has no room.");
  QTest::newRow("some not named") << QByteArray("200 OK") << -5 << 3
                                  << QByteArray("does not say that it keeps it (status 200).");
  QTest::newRow("none, with a good status") << QByteArray("200 OK") << 0 << 1 << QByteArray("refuses it");
  QTest::newRow("none, with a bad one") << QByteArray("409 Conflict") << 0 << 1 << QByteArray("refuses it");
}

void TestArchiveSend::onlyWhatAnAnswerNamesIsSent() {
  QFETCH(QByteArray, status);
  QFETCH(int, kept);
  QFETCH(int, exit);
  QFETCH(QByteArray, sentence);
  const HttpPeer peer([&](const HttpRequest& request) {
    const QList<QByteArray> uids = uidsSent(request.body);
    const int count = std::abs(kept);
    QByteArray body = listOf("00081199", uids.mid(0, count));
    if (kept >= 0)
      body += "," + listOf("00081198", uids.mid(count), R"(, "00081197": {"vr": "US", "Value": [42752]})");
    const bool isRight = request.method == "POST" && request.path == "/dicom-web/studies" &&
                         request.headers.at("content-type")
                             .startsWith("multipart/related; type=\"application/dicom\"; boundary=\"");
    return isRight ? httpAnswer(status, "application/dicom+json", "{" + body + "}")
                   : httpAnswer("415 Unsupported", "text/plain", "");
  });
  const Outcome sent = archive(web(peer.url()), {QStringLiteral("send"), QStringLiteral("to"), scans_});
  QCOMPARE(sent.status, exit);
  QVERIFY2(sent.out.startsWith("Sent " + QByteArray::number(std::abs(kept)) + " of 7 instances"), sent.out);
  QVERIFY2(sent.err.contains(sentence), sent.err);
}

void TestArchiveSend::largeRequestsAreDivided() {
  QList<int> counts;
  const HttpPeer peer([&](const HttpRequest& request) {
    const QList<QByteArray> uids = uidsSent(request.body);
    counts << int(uids.size());
    return uids.size() > 2
               ? httpAnswer("413 Payload Too Large", "text/html", "<html></html>")
               : httpAnswer("200 OK", "application/dicom+json", "{" + listOf("00081199", uids) + "}");
  });
  const Outcome sent = archive(web(peer.url()), {QStringLiteral("send"), QStringLiteral("to"), scans_});
  QVERIFY2(sent.status == 0, sent.err);
  QCOMPARE(counts, (QList<int>{7, 3, 1, 1, 1, 1, 1, 1, 1}));
}

void TestArchiveSend::aPeerThatHangsUpIsTold() {
  const StorePeer peer({QStringLiteral("--abort-during")});
  QVERIFY(peer.isListening);
  const Outcome sent = archive(
      dimse(peer.port()), {QStringLiteral("send"), QStringLiteral("to"), scans_, QStringLiteral("--json")});
  QCOMPARE(sent.status, 1);
  QVERIFY2(sent.err.contains("ended the connection."), sent.err);
}

void TestArchiveSend::wrongPathsAreExplained_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QByteArray>("sentence");
  QTest::newRow("a missing file") << QStringLiteral("nowhere") << QByteArray("nowhere");
  QTest::newRow("no DICOM") << scans_ + QStringLiteral("/notes.txt")
                            << QByteArray("There is nothing to send: notes.txt");
  QTest::newRow("a phantom") << QStringLiteral("phantom:ct-head") << QByteArray("phantom:ct-head");
  QTest::newRow("a study without an index") << QStringLiteral("index:77") << QByteArray("index:77: ");
}

void TestArchiveSend::wrongPathsAreExplained() {
  QFETCH(QString, path);
  QFETCH(QByteArray, sentence);
  const Outcome sent = archive(dimse(freePort()), {QStringLiteral("send"), QStringLiteral("to"), path});
  QCOMPARE(sent.status, 1);
  QVERIFY2(sent.err.contains(sentence), sent.err);
}

VOLUMEN_TEST(TestArchiveSend);
#include "tst_archive_send.moc"
