// Guards receiving in the window, by a real sender (storescu): what comes is listed, and only while it is
// wanted.
#include <QTcpServer>

#include "tests/ui/archives_window.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestReceiving : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void init() { openAlone(); }
  void whatComesIsListed();
  void whatKeepsItFromListeningIsTold_data();
  void whatKeepsItFromListeningIsTold();
};

namespace {

Archives listeningAt(int port) {
  Archives all;
  all.listen.emplace();
  all.listen->port = port;
  return all;
}

int send(int port, const QString& folder) {
  return QProcess::execute(QStringLiteral("storescu"),
                           {QStringLiteral("-aec"), QStringLiteral("VOLUMEN"), QStringLiteral("+sd"),
                            QStringLiteral("127.0.0.1"), QString::number(port), folder});
}

bool isFree(int port) {
  QTcpServer server;
  return server.listen(QHostAddress::LocalHost, quint16(port));
}

}  // namespace

void TestReceiving::initTestCase() {
  if (!QrPeer::isInstalled()) QSKIP("storescu is not installed (package dcmtk)");
}

void TestReceiving::whatComesIsListed() {
  const int port = freePort();
  const ListedArchives list(listeningAt(port));
  const Studies studies;
  ArchivesWindow w(studies);
  QVERIFY(isFree(port));
  auto* action = w.child<QAction>("receiveStudies");
  action->trigger();
  QTRY_VERIFY(!isFree(port));
  QVERIFY(listensAt(port));
  QVERIFY(studies.write());
  QCOMPARE(send(port, studies.data + QStringLiteral("/mueller")), 0);
  w.child<QAction>("showBrowser")->trigger();
  QVERIFY(w.has("Müller", 0));
  action->trigger();
  QTRY_VERIFY(isFree(port));
}

void TestReceiving::whatKeepsItFromListeningIsTold_data() {
  QTest::addColumn<bool>("isPortUsed");
  QTest::addColumn<QString>("sentence");
  QTest::newRow("nowhere to listen") << false << QStringLiteral("To receive studies, say in ");
  QTest::newRow("a port in use") << true << QStringLiteral("Port ");
}

void TestReceiving::whatKeepsItFromListeningIsTold() {
  QFETCH(bool, isPortUsed);
  QFETCH(QString, sentence);
  QTcpServer other;
  QVERIFY(other.listen(QHostAddress::LocalHost));
  const ListedArchives list(isPortUsed ? listeningAt(other.serverPort()) : Archives{});
  const Studies studies;
  ArchivesWindow w(studies);
  auto* action = w.child<QAction>("receiveStudies");
  action->trigger();
  QTRY_VERIFY2(w.banner()->sentence().startsWith(sentence), qPrintable(w.banner()->sentence()));
  QVERIFY(!action->isChecked());
  w.window.document().session.prefer([](Preferences& p) { p.receives = false; });
}

VOLUMEN_TEST(TestReceiving);
#include "tst_receiving.moc"
