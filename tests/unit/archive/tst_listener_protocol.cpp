// Guards how the listener answers peers that use the protocol in rare or forbidden ways (PS3.7, PS3.8).
#include <QTcpSocket>

#include "tests/unit/archive/pdus.h"
#include "tests/unit/archive/receiver.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestListenerProtocol : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void requestsAreAnswered_data();
  void requestsAreAnswered();
  void contextsAreAnsweredEach();
  void aRejectedPeerTakesNoPlace();

 private:
  Receiver listener_;
};

namespace {

// Returns what the listener sends until it ends the association or the connection.
QByteArray answersTo(const Receiver& listener, const QByteArray& bytes) {
  constexpr int lengthOfEnd = 10, rejection = 3, releaseAnswer = 6, abortion = 7;
  const auto peer = listener.connection(bytes);
  QByteArray answers = peer->readAll();
  const auto isEnded = [&] {
    const QByteArray last = answers.right(lengthOfEnd);
    const bool isEnd =
        last.startsWith(rejection) || last.startsWith(releaseAnswer) || last.startsWith(abortion);
    return isEnd && last.mid(1, 5) == QByteArray("\0\0\0\0\4", 5);
  };
  while (!isEnded() && peer->waitForReadyRead(15000)) answers += peer->readAll();
  return peer->error() == QAbstractSocket::SocketTimeoutError ? "it is still open" : answers;
}

// Returns the types of PDUs, and the statuses of answers in them: "accept 0000 released".
QByteArray named(const QByteArray& answers) {
  constexpr int head = 6, acceptance = 2, rejection = 3, data = 4, releaseAnswer = 6, abortion = 7;
  const auto number = [&](qsizetype at, int count) {
    qsizetype value = 0;
    for (int n = 0; n < count; ++n) value = value << 8 | uchar(answers.at(at + n));
    return value;
  };
  QByteArrayList names;
  for (qsizetype at = 0; at + head <= answers.size(); at += head + number(at + 2, 4)) {
    const int type = answers.at(at);
    if (type == acceptance) names << "accepted";
    if (type == rejection) names << "rejected " + answers.mid(at + head + 1, 3).toHex();
    if (type == releaseAnswer) names << "released";
    if (type == abortion) names << "aborted";
    const QByteArray value = answers.mid(at, head + number(at + 2, 4));
    const qsizetype status = value.indexOf(QByteArray("\0\0\0\x09\2\0\0\0", 8));
    if (type == data && status > 0)
      names << QByteArray(1, value.at(status + 9)).toHex() + QByteArray(1, value.at(status + 8)).toHex();
  }
  return names.join(' ');
}

}  // namespace

void TestListenerProtocol::initTestCase() { QVERIFY(listener_.start()); }

void TestListenerProtocol::requestsAreAnswered_data() {
  QTest::addColumn<QByteArray>("bytes");
  QTest::addColumn<QByteArray>("answers");
  const auto row = [](const char* name, const QByteArray& bytes, const char* answers) {
    QTest::newRow(name) << bytes << QByteArray(answers);
  };
  const auto asked = [&](const char* name, const AssociationRequest& request, const char* answers) {
    row(name, associationRequest(request) + echoPdu() + releaseRequest(), answers);
  };
  const QByteArray open = associationRequest();
  const QByteArray uids = commandElement(0x0003, "1.2.840.10008.1.20.1") + commandElement(0x1001, "1.2.3");
  const auto normalized = [&](quint16 field, const QByteArray& more) {
    return commandPdu(1, uids + commandElement(0x0100, field) + commandElement(0x0110, quint16(1)) +
                             commandElement(0x0800, quint16(0x0101)) + more);
  };
  row("a test between images",
      open + echoPdu() + storagePdus() + echoPdu() + storagePdus() + echoPdu() + releaseRequest(),
      "accepted 0000 0000 0000 0000 0000 released");
  row("a cancellation of nothing",
      open +
          commandPdu(1, commandElement(0x0100, quint16(0x0fff)) + commandElement(0x0120, quint16(1)) +
                            commandElement(0x0800, quint16(0x0101))) +
          echoPdu() + releaseRequest(),
      "accepted 0000 released");
  row("an image where only verification was agreed on", open + storagePdus(1) + echoPdu() + releaseRequest(),
      "accepted 0122 0000 released");
  row("an image in a context that was not agreed on", open + storagePdus(5), "accepted aborted");
  row("several requests in one message",
      open + joined(storagePdus() + echoPdu() + storagePdus() + echoPdu()) + releaseRequest(),
      "accepted 0000 0000 0000 0000 released");
  row("a value that is longer than its message",
      open + pduOf(pduData, bigEndian(quint32(100)) + QByteArray("\1\3", 2) + QByteArray(20, '\0')) +
          echoPdu(),
      "accepted");
  row("N-GET", open + normalized(0x0110, commandElement(0x1005, QByteArray(4000, '\1'))), "accepted aborted");
  row("N-ACTION, storage commitment", open + normalized(0x0130, commandElement(0x1008, quint16(1))),
      "accepted aborted");
  row("N-CREATE", open + normalized(0x0140, {}), "accepted aborted");
  row("an answer to nothing",
      open + commandPdu(1, commandElement(0x0100, quint16(0x8001)) + commandElement(0x0120, quint16(1)) +
                               commandElement(0x0800, quint16(0x0101)) + commandElement(0x0900, quint16(0))),
      "accepted aborted");
  row("a second request for an association", open + open, "accepted aborted");
  asked("the peer takes PDUs of any length", {.mostBytes = 0}, "accepted 0000 released");
  asked("the peer takes PDUs of a byte", {.mostBytes = 1}, "accepted aborted");
  asked("another AE title", {.called = "NOBODY"}, "rejected 010107");
  asked("another application context", {.name = pduItem(0x10, "1.2.3")}, "rejected 010102");
  asked("no application context", {.name = {}}, "");
  asked("a blank AE title of the peer", {.calling = " "}, "");
  asked("an item that is longer than its PDU", {.name = QByteArray("\x10\0\x7f\xff", 4) + "1.2"}, "");
  asked("one context twice", {.contexts = proposalOf(1, "1.2.840.10008.1.1").repeated(2)}, "");
  asked("a context without transfer syntax", {.contexts = proposalOf(1, "1.2.840.10008.1.1", {})}, "");
  asked("roles, a user, an asynchronous window",
        {.more = pduItem(0x53, bigEndian(quint16(5)) + bigEndian(quint16(5))) +
                 pduItem(0x54, bigEndian(quint16(17)) + "1.2.840.10008.1.1" + QByteArray("\1\1", 2)) +
                 pduItem(0x55, "SCANNER 1") +
                 pduItem(0x58, QByteArray("\2\1", 2) + bigEndian(quint16(4)) + "user" +
                                   bigEndian(quint16(4)) + "word") +
                 pduItem(0x57, bigEndian(quint16(3)) + "1.2" + bigEndian(quint16(0)))},
        "accepted 0000 released");
  asked("a user with a second field that it must not have",
        {.more = pduItem(0x58,
                         QByteArray("\1\0", 2) + bigEndian(quint16(1)) + "a" + bigEndian(quint16(1)) + "b")},
        "");
  asked("two users",
        {.more = pduItem(0x58, QByteArray("\1\0", 2) + bigEndian(quint16(1)) + "a" + bigEndian(quint16(0)))
                     .repeated(2)},
        "");
}

void TestListenerProtocol::requestsAreAnswered() {
  QFETCH(QByteArray, bytes);
  QFETCH(QByteArray, answers);
  QCOMPARE(named(answersTo(listener_, bytes)), answers);
  // Whatever the peer was, the next one is answered.
  QCOMPARE(named(answersTo(listener_, associationRequest() + echoPdu() + releaseRequest())),
           QByteArray("accepted 0000 released"));
}

void TestListenerProtocol::contextsAreAnsweredEach() {
  QByteArray contexts;
  QList<QByteArray> many;
  for (int n = 0; n < 60; ++n) many << "1.2.3." + QByteArray::number(n);
  for (int id = 1; id < 256; id += 2)
    contexts += proposalOf(id, id % 4 == 1 ? "1.2.840.10008.1.1" : "1.2.840.10008.5.1.4.1.2.2.1",
                           id == 5 ? many : QList<QByteArray>{"1.2.840.10008.1.2"});
  const QByteArray answers =
      answersTo(listener_, associationRequest({.contexts = contexts}) + releaseRequest());
  QCOMPARE(named(answers), QByteArray("accepted released"));
  for (int id = 1; id < 256; id += 2) {
    const char result = id == 5 ? 4 : id % 4 == 1 ? 0 : 3;
    const QByteArray answer = QByteArray(1, char(id)) + '\0' + result + '\0' + '\x40';
    QVERIFY2(answers.contains(answer), qPrintable(QString::number(id)));
  }
}

void TestListenerProtocol::aRejectedPeerTakesNoPlace() {
  Receiver one(R"(, "mostAssociations": 1)");
  QVERIFY(one.start());
  const auto rejected = one.connection(associationRequest({.called = "NOBODY"}));
  QVERIFY(rejected->waitForReadyRead(5000));
  QCOMPARE(named(answersTo(one, associationRequest() + echoPdu() + releaseRequest())),
           QByteArray("accepted 0000 released"));
}

VOLUMEN_TEST(TestListenerProtocol);
#include "tst_listener_protocol.moc"
