// Guards `volumen archive send` against archives that break off or lie, in each phase of C-STORE and STOW-RS:
// only what an archive says that it keeps counts, and a sentence names the archive.
#include <QTemporaryDir>

#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/fake_scp.h"
#include "tests/unit/archive/web_peer.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestArchiveSendFaults : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void onlyWhatIsKeptCounts_data();
  void onlyWhatIsKeptCounts();
  void aWebArchiveMayEndInEachPhase_data();
  void aWebArchiveMayEndInEachPhase();

 private:
  QTemporaryDir scans_;  // three images
};

namespace {

void addSending(const char* name, ScpAnswer store, int status, int kept, const char* sentence) {
  QTest::newRow(name) << std::move(store) << status << kept << QByteArray(sentence);
}

// Returns what answers the first of three images rightly, and the others so.
ScpAnswer secondWith(std::function<QByteArray(const DimseMessage&)> bytes) {
  return [bytes = std::move(bytes)](ScpLine& line, const DimseMessage& request) {
    const bool isFirst = valueIn(request.command, 0, 0x1000).startsWith("1.2.1.1.1");
    line.send(isFirst ? responseTo(request) : bytes(request));
    if (!isFirst) line.hangUp();
  };
}

// A peer that reads so many bytes of a request, sends an answer and ends the connection.
std::function<void(QTcpSocket&)> endsAfter(qsizetype bytes, const QByteArray& answer) {
  return [=](QTcpSocket& socket) {
    for (qsizetype count = 0; count < bytes && socket.waitForReadyRead(5000);)
      count += socket.readAll().size();
    if (!answer.isEmpty()) socket.write(answer), socket.waitForBytesWritten(1000);
    answer.isEmpty() ? socket.abort() : socket.disconnectFromHost();
    if (socket.state() != QTcpSocket::UnconnectedState) socket.waitForDisconnected(1000);
  };
}

}  // namespace

void TestArchiveSendFaults::initTestCase() {
  const QList<QByteArray> files = instancesOfOneSeries(3);
  for (qsizetype n = 0; n < files.size(); ++n) {
    QFile file(scans_.filePath(QStringLiteral("%1.dcm").arg(n)));
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(files[n]) == files[n].size());
  }
}

void TestArchiveSendFaults::onlyWhatIsKeptCounts_data() {
  QTest::addColumn<ScpAnswer>("store");
  QTest::addColumn<int>("status");
  QTest::addColumn<int>("kept");
  QTest::addColumn<QByteArray>("sentence");
  const char* const ended = "ended the connection.";
  const auto second = [](const DimseResponse& response) {
    return secondWith([=](const DimseMessage& request) { return responseTo(request, response); });
  };
  addSending(
      "the end in place of the first answer", [](ScpLine& line, const DimseMessage&) { line.hangUp(); }, 1, 0,
      ended);
  addSending("the end in place of the second answer",
             secondWith([](const DimseMessage&) { return QByteArray(); }), 3, 1, ended);
  addSending("the end in the middle of an answer",
             secondWith([](const DimseMessage& request) { return responseTo(request).chopped(10); }), 3, 1,
             ended);
  addSending("an abort", secondWith([](const DimseMessage&) { return pduOf(pduAbort, QByteArray(4, '\0')); }),
             3, 1, ended);
  addSending("a status that nobody knows", second({.status = 0x0123}), 3, 1, "refuses it with status 0123.");
  addSending("no room", second({.status = 0xa700}), 3, 1, "is out of resources (status A700).");
  addSending("the answer to another message", second({.idOffset = 7}), 3, 1, "does not keep to DICOM (DIMSE");
  addSending("the answer for another image", second({.instanceUid = "1.2.1.1.9"}), 3, 1,
             "answers for another image.");
  addSending("no status", second({.hasStatus = false}), 3, 1, "does not keep to DICOM (DIMSE");
  addSending("data of 4 GiB", secondWith([](const DimseMessage&) { return endlessPdu(); }), 3, 1,
             "does not keep to DICOM (DUL Illegal PDU Length");
  addSending("a command of 25,000 sequences within each other",
             secondWith([](const DimseMessage&) { return deepCommand(); }), 3, 1,
             "sent an answer that is too large.");
  addSending(
      "one byte after another",
      [](ScpLine& line, const DimseMessage& request) { line.drip(responseTo(request), 10); }, 0, 3, "");
  addSending("the answer to another service", secondWith([](DimseMessage request) {
               request.command.replace(commandElement(0x0100, storeRequest),
                                       commandElement(0x0100, findRequest));
               return responseTo(request);
             }),
             3, 1, "does not keep to DICOM (DIMSE");
}

void TestArchiveSendFaults::onlyWhatIsKeptCounts() {
  QFETCH(ScpAnswer, store);
  QFETCH(int, status);
  QFETCH(int, kept);
  QFETCH(QByteArray, sentence);
  const FakeScp peer(store);
  const Outcome done =
      runArchive(peer.port(), {QStringLiteral("send"), QStringLiteral("main"), scans_.path()});
  QVERIFY2(done.status == status, done.err);
  if (kept > 0)
    QCOMPARE(done.out, "Sent " + QByteArray::number(kept) + " of 3 instances to main\n");
  else
    QVERIFY2(done.out.isEmpty() || done.out.startsWith("Sent 0 of 3 "), done.out);
  QCOMPARE(done.err.isEmpty(), sentence.isEmpty());
  QVERIFY2(done.err.contains(sentence), done.err);
  for (const QByteArray& line : done.err.split('\n').mid(0, done.err.count('\n')))
    QVERIFY2(line.contains("The archive \"main\" "), line);
}

void TestArchiveSendFaults::aWebArchiveMayEndInEachPhase_data() {
  QTest::addColumn<qsizetype>("bytes");
  QTest::addColumn<QByteArray>("answer");
  QTest::addColumn<QByteArray>("sentence");
  const QByteArray ok = "HTTP/1.1 200 OK\r\nContent-Type: application/dicom+json\r\n";
  const auto row = [](const char* name, qsizetype bytes, const QByteArray& answer, const char* sentence) {
    QTest::newRow(name) << bytes << answer << QByteArray(sentence);
  };
  const char* const ended = "ended the connection.";
  constexpr qsizetype all = 2500;  // of three images; fewer than are sent
  row("before the request", 0, "", ended);
  row("in the head of the request", 1, "", ended);
  row("in the body of the request", all / 2, "", ended);
  row("in place of the answer", all, "", ended);
  row("in the head of the answer", all, ok, ended);
  row("in the body of the answer", all, ok + "Content-Length: 100\r\n\r\n{", ended);
  row("with an answer that is no JSON", all, ok + "Content-Length: 1\r\n\r\n{",
      "does not say that it keeps it");
}

void TestArchiveSendFaults::aWebArchiveMayEndInEachPhase() {
  QFETCH(qsizetype, bytes);
  QFETCH(QByteArray, answer);
  QFETCH(QByteArray, sentence);
  const FakePeer peer(endsAfter(bytes, answer));
  const QTemporaryDir lists;
  const QByteArray url = "http://127.0.0.1:" + QByteArray::number(peer.port());
  const Outcome done =
      runProgram({QStringLiteral("archive"), QStringLiteral("send"), QStringLiteral("main"), scans_.path(),
                  QStringLiteral("--archives"), writeWebListWith(url, lists.path())});
  QCOMPARE(done.status, 1);
  QVERIFY2(done.err.contains("The archive \"main\" ") && done.err.contains(sentence), done.err);
}

VOLUMEN_TEST(TestArchiveSendFaults);
#include "tst_archive_send_faults.moc"
