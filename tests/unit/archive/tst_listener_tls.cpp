// Guards whom a listener with TLS takes images from, and listening by IPv6.
#include <QFile>
#include <QProcess>
#include <QStandardPaths>
#include <QTcpSocket>
#include <QTemporaryDir>

#include "tests/fixtures/program.h"
#include "tests/unit/archive/pdus.h"
#include "tests/unit/archive/receiver.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestListenerTls : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void onlyPeersWhoEncryptAreAnswered_data();
  void onlyPeersWhoEncryptAreAnswered();
  void aSlowHandshakeIsCutOff();
  void filesThatCannotBeUsedAreNamed_data();
  void filesThatCannotBeUsedAreNamed();
  void addressesOfBothKindsAreListenedAt_data();
  void addressesOfBothKindsAreListenedAt();

 private:
  QString in(const char* name) const { return folder_.filePath(QLatin1String(name)); }
  // Replaces FOLDER.
  QByteArray settings(const char* tls) const {
    return QByteArray(tls).replace("FOLDER", folder_.path().toUtf8());
  }

  QTemporaryDir folder_;
};

void TestListenerTls::initTestCase() {
  for (const char* program : {"openssl", "storescu"})
    if (QStandardPaths::findExecutable(QLatin1String(program)).isEmpty())
      QSKIP(qPrintable(QStringLiteral("%1 is not installed").arg(QLatin1String(program))));
  for (const char* name : {"our", "peer", "other"})
    QCOMPARE(
        QProcess::execute(QStringLiteral("openssl"),
                          QStringLiteral("req -x509 -newkey rsa:2048 -nodes -subj /CN=localhost -days 30")
                                  .split(QLatin1Char(' ')) +
                              QStringList{QStringLiteral("-keyout"), in(name) + QStringLiteral(".key"),
                                          QStringLiteral("-out"), in(name) + QStringLiteral(".pem")}),
        0);
}

void TestListenerTls::onlyPeersWhoEncryptAreAnswered_data() {
  QTest::addColumn<QByteArray>("tls");
  QTest::addColumn<QString>("options");  // of storescu
  QTest::addColumn<bool>("isAnswered");
  const auto row = [](const char* name, const char* tls, const char* options, bool isAnswered) {
    QTest::newRow(name) << QByteArray(tls) << QString::fromLatin1(options) << isAnswered;
  };
  const char* const any = R"(, "tls": {"certificate": "FOLDER/our.pem", "key": "FOLDER/our.key"})";
  const char* const known =
      R"(, "tls": {"certificate": "FOLDER/our.pem", "key": "FOLDER/our.key", "ca": "FOLDER/peer.pem"})";
  row("any peer", any, "+tla +cf FOLDER/our.pem", true);
  row("a peer that shows a certificate, which is not wanted", any,
      "+tls FOLDER/other.key FOLDER/other.pem +cf FOLDER/our.pem", true);
  row("a peer that trusts others", any, "+tla +cf FOLDER/other.pem", false);
  row("a plain peer", any, "", false);
  row("a known peer", known, "+tls FOLDER/peer.key FOLDER/peer.pem +cf FOLDER/our.pem", true);
  row("another peer", known, "+tls FOLDER/other.key FOLDER/other.pem +cf FOLDER/our.pem", false);
  row("a peer without a certificate", known, "+tla +cf FOLDER/our.pem", false);
  row("TLS at a plain port", "", "+tla +cf FOLDER/our.pem", false);
}

void TestListenerTls::onlyPeersWhoEncryptAreAnswered() {
  QFETCH(QByteArray, tls);
  QFETCH(QString, options);
  QFETCH(bool, isAnswered);
  Receiver receiver(settings(tls.constData()));
  QVERIFY(receiver.start());
  options.replace(QLatin1String("FOLDER"), folder_.path());
  const QStringList words = options.split(QLatin1Char(' '), Qt::SkipEmptyParts);
  const QStringList image{writeImage(in("image.dcm"), "1.2.3", "1.2.3.1.1")};
  QCOMPARE(receiver.send(image, words) == 0, isAnswered);
  QCOMPARE(receiver.files().size(), isAnswered ? 1 : 0);
  const QByteArray said = receiver.interrupted();
  if (isAnswered) QCOMPARE(said, QByteArray("STORESCU (127.0.0.1): 1 image received.\n"));
  if (tls.isEmpty()) QCOMPARE(said, QByteArray());
  if (!isAnswered && !tls.isEmpty())
    QVERIFY2(said.startsWith("A peer (127.0.0.1): was cut off: it does not agree on TLS"), said);
}

void TestListenerTls::aSlowHandshakeIsCutOff() {
  Receiver receiver(settings(R"(, "tls": {"certificate": "FOLDER/our.pem", "key": "FOLDER/our.key"})"));
  QVERIFY(receiver.start());
  const auto slow = receiver.connection(QByteArray::fromHex("16030100c8"));
  for (int n = 0; n < 100 && slow->state() == QAbstractSocket::ConnectedState; ++n) {
    slow->write("\1", 1);
    slow->waitForDisconnected(200);
  }
  QCOMPARE(slow->state(), QAbstractSocket::UnconnectedState);
  QCOMPARE(receiver.echo({QStringLiteral("+tla"), QStringLiteral("-ic")}), 0);
}

void TestListenerTls::filesThatCannotBeUsedAreNamed_data() {
  QTest::addColumn<QByteArray>("tls");
  QTest::addColumn<QByteArray>("sentence");
  const auto row = [](const char* name, const char* tls, const char* sentence) {
    QTest::newRow(name) << QByteArray(tls) << QByteArray(sentence);
  };
  row("no certificate", R"({"certificate": "FOLDER/none", "key": "FOLDER/our.key"})",
      "FOLDER/none is no certificate that can be read.");
  row("another key", R"({"certificate": "FOLDER/our.pem", "key": "FOLDER/peer.key"})",
      "FOLDER/peer.key is not the key of FOLDER/our.pem.");
  row("no authority", R"({"certificate": "FOLDER/our.pem", "key": "FOLDER/our.key", "ca": "FOLDER/none"})",
      "FOLDER/none holds no certificate that can be read.");
  row("only an authority", R"({"ca": "FOLDER/peer.pem"})",
      "must name our \"certificate\" and its \"key\", and may name the \"ca\" of peers");
}

void TestListenerTls::filesThatCannotBeUsedAreNamed() {
  QFETCH(QByteArray, tls);
  QFETCH(QByteArray, sentence);
  QFile list(in("archives.json"));
  QVERIFY(list.open(QIODevice::WriteOnly));
  list.write("{\"listen\": {\"tls\": " + settings(tls.constData()) + "}}");
  list.close();
  const Outcome done =
      runProgram({QStringLiteral("archive"), QStringLiteral("receive"), QStringLiteral("--archives"),
                  list.fileName(), QStringLiteral("-o"), in("nothing")});
  QCOMPARE(done.status, 1);
  QVERIFY2(done.err.contains(settings(sentence.constData())), done.err);
}

void TestListenerTls::addressesOfBothKindsAreListenedAt_data() {
  QTest::addColumn<QByteArray>("address");
  QTest::addColumn<QString>("peer");
  QTest::addColumn<QByteArray>("told");
  QTest::newRow("IPv6") << QByteArray("::1") << QStringLiteral("::1") << QByteArray("BYHAND (::1): ");
  QTest::newRow("all, by IPv6") << QByteArray("::") << QStringLiteral("::1") << QByteArray("BYHAND (::1): ");
  QTest::newRow("all, by IPv4") << QByteArray("::") << QStringLiteral("127.0.0.1")
                                << QByteArray("BYHAND (127.0.0.1): ");
  QTest::newRow("all of IPv4") << QByteArray("0.0.0.0") << QStringLiteral("127.0.0.1")
                               << QByteArray("BYHAND (127.0.0.1): ");
}

void TestListenerTls::addressesOfBothKindsAreListenedAt() {
  QFETCH(QByteArray, address);
  QFETCH(QString, peer);
  QFETCH(QByteArray, told);
  if (!QFile::exists(QStringLiteral("/proc/net/if_inet6")) && address.contains(':'))
    QSKIP("this machine has no IPv6");
  Receiver receiver(", \"address\": \"" + address + '"');
  QVERIFY(receiver.start());
  QTcpSocket socket;
  socket.connectToHost(peer, quint16(receiver.port()));
  QVERIFY(socket.waitForConnected(5000));
  socket.write(associationRequest() + storagePdus() + releaseRequest());
  const QByteArray releaseAnswer("\6\0\0\0\0\4\0\0\0\0", 10);
  for (QByteArray answers; !answers.endsWith(releaseAnswer); answers += socket.readAll())
    QVERIFY(socket.waitForReadyRead(10000));
  QCOMPARE(receiver.files().size(), 1);
  QCOMPARE(receiver.interrupted(), told + "1 image received.\n");
}

VOLUMEN_TEST(TestListenerTls);
#include "tst_listener_tls.moc"
