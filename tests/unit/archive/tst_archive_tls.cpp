// Guards `volumen archive` over TLS: whom it trusts, and what it says of others.
#include <QCryptographicHash>
#include <QDir>
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
  void onlyTheRightWebPeerIsTrusted_data();
  void onlyTheRightWebPeerIsTrusted();
  void cleanupTestCase();

 private:
  QString in(const char* name) const { return folder_.filePath(QLatin1String(name)); }
  // Tests an archive, and compares what is said with the row's sentence.
  void compare(const QString& fields, QString tls);
  bool makeCertificate(const char* certificate, const char* key);
  bool listen(QProcess& peer, int port, const QStringList& more);
  bool serve(QProcess& peer, int port, const QStringList& more);

  QTemporaryDir folder_;
  // By DIMSE and by HTTP. The closed ones want our certificate.
  QProcess open_, closed_, webOpen_, webClosed_;
  const int openPort_ = freePort(), closedPort_ = freePort(), webOpenPort_ = freePort(),
            webClosedPort_ = freePort();
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

// openssl serves files: one is the answer to the test of a DICOMweb archive.
bool TestArchiveTls::serve(QProcess& peer, int port, const QStringList& more) {
  peer.setWorkingDirectory(in("web"));
  peer.setStandardOutputFile(QProcess::nullDevice());
  peer.setStandardErrorFile(QProcess::nullDevice());
  peer.start(QStringLiteral("openssl"),
             QStringList{QStringLiteral("s_server"), QStringLiteral("-HTTP"), QStringLiteral("-accept"),
                         QString::number(port), QStringLiteral("-key"), in("key.pem"),
                         QStringLiteral("-cert"), in("cert.pem")} +
                 more);
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
  QVERIFY(QDir().mkpath(in("web/dicom-web")));
  QFile answer(in("web/dicom-web/studies?limit=1"));
  QVERIFY(answer.open(QIODevice::WriteOnly));
  answer.write("HTTP/1.0 200 OK\r\nContent-Type: application/dicom+json\r\nContent-Length: 2\r\n\r\n[]");
  answer.close();
  QVERIFY(serve(webOpen_, webOpenPort_, {}));
  QVERIFY(serve(webClosed_, webClosedPort_,
                {QStringLiteral("-Verify"), QStringLiteral("1"), QStringLiteral("-verify_return_error"),
                 QStringLiteral("-CAfile"), in("our.pem")}));
}

void TestArchiveTls::cleanupTestCase() {
  for (QProcess* peer : {&open_, &closed_, &webOpen_, &webClosed_}) peer->kill(), peer->waitForFinished();
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

void TestArchiveTls::onlyTheRightWebPeerIsTrusted_data() {
  QTest::addColumn<QString>("url");  // OPEN and CLOSED are replaced by ports
  QTest::addColumn<QString>("tls");
  QTest::addColumn<QString>("sentence");
  const auto row = [](const char* name, const char* url, const char* tls, const char* sentence) {
    QTest::newRow(name) << QString::fromLatin1(url) << QString::fromLatin1(tls)
                        << QString::fromLatin1(sentence);
  };
  const char* const open = "https://localhost:OPEN";
  const char* const closed = "https://localhost:CLOSED";
  row("its pin", open, R"("pin": "PIN")", "");
  row("its pin under another name", "https://127.0.0.1:OPEN", R"("pin": "PIN")", "");
  row("its certificate", open, R"("ca": "FOLDER/cert.pem")", "");
  row("its certificate under another name", "https://127.0.0.1:OPEN", R"("ca": "FOLDER/cert.pem")",
      "has a certificate that FOLDER/cert.pem does not vouch for: The host name did not match");
  row("another pin", open, R"("pin": "0000000000000000000000000000000000000000000000000000000000000000")",
      "has another certificate than the pinned one: its SHA-256 is PIN.");
  row("another certificate", open, R"("ca": "FOLDER/our.pem")",
      "has a certificate that FOLDER/our.pem does not vouch for: ");
  row("nothing to trust it by", open, "", "has a certificate that this machine does not vouch for: ");
  row("no file of certificates", open, R"("ca": "FOLDER/none.pem")",
      "FOLDER/none.pem holds no certificate that can be read.");
  row("no TLS", "http://localhost:OPEN", "", "ended the connection.");
  row("ours is wanted", closed, R"("pin": "PIN")", "The archive \"main\" (");
  row("ours is given", closed,
      R"("pin": "PIN", "certificate": "FOLDER/our.pem", "key": "FOLDER/our-key.pem")", "");
  row("a key with a passphrase", closed,
      R"("pin": "PIN", "certificate": "FOLDER/our.pem", "key": "FOLDER/locked.pem")",
      "FOLDER/locked.pem is no private key that can be read.");
}

void TestArchiveTls::onlyTheRightWebPeerIsTrusted() {
  QFETCH(QString, url);
  QFETCH(QString, tls);
  url.replace(QLatin1String("OPEN"), QString::number(webOpenPort_))
      .replace(QLatin1String("CLOSED"), QString::number(webClosedPort_));
  compare(QStringLiteral(R"("kind": "dicomweb", "url": "%1/dicom-web")").arg(url), tls);
}

void TestArchiveTls::onlyTheRightPeerIsTrusted() {
  QFETCH(bool, isOpen);
  QFETCH(QString, tls);
  compare(QStringLiteral(R"("kind": "dimse", "host": "localhost", "calledAe": "STORESCP", "port": %1)")
              .arg(isOpen ? openPort_ : closedPort_),
          tls);
}

void TestArchiveTls::compare(const QString& fields, QString tls) {
  QFETCH(QString, sentence);
  for (QString* text : {&tls, &sentence})
    text->replace(QLatin1String("PIN"), QString::fromLatin1(pin_))
        .replace(QLatin1String("FOLDER"), folder_.path());
  if (!tls.isEmpty()) tls = QStringLiteral(R"(, "tls": {%1})").arg(tls);
  QFile file(in("archives.json"));
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(
      (QStringLiteral(R"({"archives": [{"name": "main", )") + fields + tls + QStringLiteral("}]}")).toUtf8());
  file.close();
  const Outcome done =
      runProgram(QStringList{QStringLiteral("archive"), QStringLiteral("test"), QStringLiteral("main"),
                             QStringLiteral("--archives"), in("archives.json")});
  QVERIFY2(done.status == (sentence.isEmpty() ? 0 : 1), done.err);
  QVERIFY2(QString::fromUtf8(done.err).contains(sentence), done.err);
}

VOLUMEN_TEST(TestArchiveTls);
#include "tst_archive_tls.moc"
