// Guards `volumen archive` over TLS: whom it trusts, and what it says of others.
#include <QCryptographicHash>
#include <QFile>
#include <QProcess>
#include <QSslCertificate>
#include <QStandardPaths>
#include <QTemporaryDir>

#include "tests/fixtures/program.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestArchiveTls : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void onlyTheRightPeerIsTrusted_data();
  void onlyTheRightPeerIsTrusted();
  void cleanupTestCase();

 private:
  QString in(const char* name) const { return folder_.filePath(QLatin1String(name)); }
  bool makeCertificate(const char* certificate, const char* key);
  bool listen(QProcess& peer, int port, const QStringList& more);

  QTemporaryDir folder_;
  QProcess open_, closed_;  // the latter wants our certificate
  const int openPort_ = freePort(), closedPort_ = freePort();
  QByteArray pin_;
};

bool TestArchiveTls::makeCertificate(const char* certificate, const char* key) {
  return QProcess::execute(QStringLiteral("openssl"),
                           QStringLiteral("req -x509 -newkey rsa:2048 -nodes -subj /CN=localhost -days 30")
                                   .split(QLatin1Char(' ')) +
                               QStringList{QStringLiteral("-keyout"), in(key), QStringLiteral("-out"),
                                           in(certificate)}) == 0;
}

bool TestArchiveTls::listen(QProcess& peer, int port, const QStringList& more) {
  peer.setStandardOutputFile(QProcess::nullDevice());
  peer.setStandardErrorFile(QProcess::nullDevice());
  peer.start(QStringLiteral("storescp"), QStringList{QStringLiteral("+tls"), in("key.pem"), in("cert.pem")} +
                                             more + QStringList{QString::number(port)});
  return peer.waitForStarted() && listensAt(port);
}

void TestArchiveTls::initTestCase() {
  for (const char* program : {"openssl", "storescp"})
    if (QStandardPaths::findExecutable(QLatin1String(program)).isEmpty())
      QSKIP(qPrintable(QStringLiteral("%1 is not installed").arg(QLatin1String(program))));
  QVERIFY(makeCertificate("cert.pem", "key.pem") && makeCertificate("our.pem", "our-key.pem"));
  QCOMPARE(QProcess::execute(QStringLiteral("openssl"),
                             {QStringLiteral("rsa"), QStringLiteral("-aes128"), QStringLiteral("-passout"),
                              QStringLiteral("pass:secret"), QStringLiteral("-in"), in("our-key.pem"),
                              QStringLiteral("-out"), in("locked.pem")}),
           0);
  pin_ = QSslCertificate::fromPath(in("cert.pem")).value(0).digest(QCryptographicHash::Sha256).toHex();
  QCOMPARE(pin_.size(), 64);
  QVERIFY(listen(open_, openPort_, {QStringLiteral("-ic")}));
  QVERIFY(listen(closed_, closedPort_, {QStringLiteral("+cf"), in("our.pem")}));
}

void TestArchiveTls::cleanupTestCase() {
  for (QProcess* peer : {&open_, &closed_}) peer->kill(), peer->waitForFinished();
}

void TestArchiveTls::onlyTheRightPeerIsTrusted_data() {
  QTest::addColumn<bool>("isOpen");
  QTest::addColumn<QString>("tls");  // PIN and FOLDER are replaced
  QTest::addColumn<QString>("sentence");
  const auto row = [](const char* name, bool isOpen, const char* tls, const char* sentence) {
    QTest::newRow(name) << isOpen << QString::fromLatin1(tls) << QString::fromLatin1(sentence);
  };
  row("its pin", true, R"("pin": "PIN")", "");
  row("its certificate", true, R"("ca": "FOLDER/cert.pem")", "");
  row("another pin", true, R"("pin": "0000000000000000000000000000000000000000000000000000000000000000")",
      "has another certificate than the pinned one: its SHA-256 is PIN.");
  row("another certificate", true, R"("ca": "FOLDER/our.pem")",
      "has a certificate that FOLDER/our.pem does not vouch for.");
  row("no file of certificates", true, R"("ca": "FOLDER/none.pem")",
      "FOLDER/none.pem holds no certificate that can be read.");
  row("ours is wanted", false, R"("pin": "PIN")", "it may want a certificate of ours");
  row("ours is given", false, R"("pin": "PIN", "certificate": "FOLDER/our.pem", "key": "FOLDER/our-key.pem")",
      "");
  row("a key with a passphrase", false,
      R"("pin": "PIN", "certificate": "FOLDER/our.pem", "key": "FOLDER/locked.pem")",
      "FOLDER/locked.pem is no private key that can be read.");
  row("the key of another", false,
      R"("pin": "PIN", "certificate": "FOLDER/our.pem", "key": "FOLDER/key.pem")",
      "FOLDER/key.pem is not the key of FOLDER/our.pem.");
}

void TestArchiveTls::onlyTheRightPeerIsTrusted() {
  QFETCH(bool, isOpen);
  QFETCH(QString, tls);
  QFETCH(QString, sentence);
  for (QString* text : {&tls, &sentence})
    text->replace(QLatin1String("PIN"), QString::fromLatin1(pin_))
        .replace(QLatin1String("FOLDER"), folder_.path());
  QFile file(in("archives.json"));
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(
      QStringLiteral(R"({"archives": [{"name": "main", "kind": "dimse", "host": "localhost", "port": %1,
    "calledAe": "STORESCP", "tls": {%2}}]})")
          .arg(isOpen ? openPort_ : closedPort_)
          .arg(tls)
          .toUtf8());
  file.close();
  const Outcome done =
      runProgram(QStringList{QStringLiteral("archive"), QStringLiteral("test"), QStringLiteral("main"),
                             QStringLiteral("--archives"), in("archives.json")});
  QVERIFY2(done.status == (sentence.isEmpty() ? 0 : 1), done.err);
  QVERIFY2(QString::fromUtf8(done.err).contains(sentence), done.err);
}

VOLUMEN_TEST(TestArchiveTls);
#include "tst_archive_tls.moc"
