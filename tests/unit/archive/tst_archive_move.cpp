// Guards fetching from an archive that only sends by connections of its own (C-MOVE): dcmqrscp without C-GET.
#include <QFile>
#include <QTcpServer>

#include "tests/fixtures/program.h"
#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestArchiveMove : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void instancesAreThoseOfTheArchive();
  void whatIsMissingIsFetched();
  void whatCannotBeMovedIsExplained_data();
  void whatCannotBeMovedIsExplained();

 private:
  Outcome fetch(const QByteArray& listen, const QString& to) const;
  QByteArray ours() const {
    return R"({"ae": "VOLUMEN", "port": )" + QByteArray::number(peer_.ourPort()) + '}';
  }

  QTemporaryDir folder_;
  QrPeer peer_;
};

void TestArchiveMove::initTestCase() {
  if (!QrPeer::isInstalled()) QSKIP("dcmqrscp is not installed (package dcmtk)");
  peer_.add(writeAllArchived(folder_.path()));
  QVERIFY(peer_.start({QStringLiteral("--disable-get")}));
}

Outcome TestArchiveMove::fetch(const QByteArray& listen, const QString& to) const {
  const QString path = folder_.filePath(QStringLiteral("archives.json"));
  QFile list(path);
  if (list.open(QIODevice::WriteOnly))
    list.write(R"({"archives": [{"name": "qr", "kind": "dimse", "host": "127.0.0.1", "port": )" +
               QByteArray::number(peer_.port()) + R"(, "calledAe": "ARCH"}])" +
               (listen.isEmpty() ? "" : ", \"listen\": " + listen) + '}');
  list.close();
  return runProgram({QStringLiteral("archive"), QStringLiteral("fetch"), QStringLiteral("qr"),
                     QStringLiteral("1.2.1"), QStringLiteral("--archives"), path, QStringLiteral("-o"), to});
}

void TestArchiveMove::instancesAreThoseOfTheArchive() {
  const QString to = folder_.filePath(QStringLiteral("moved"));
  const Outcome done = fetch(ours(), to);
  QVERIFY2(done.status == 0, done.err);
  QCOMPARE(done.out, "Fetched 2 of 2 images: " + to.toUtf8() + '\n');
  const QStringList files = filesBelow(to);
  QCOMPARE(files.size(), 2);
  for (const QString& file : files) {
    const Instance instance = instanceIn(file);
    QVERIFY(instance == instanceIn(folder_.filePath(QString::fromStdString(instance.seriesUid) +
                                                    QStringLiteral(".dcm"))));
  }
}

void TestArchiveMove::whatIsMissingIsFetched() {
  const QString to = folder_.filePath(QStringLiteral("again"));
  QCOMPARE(fetch(ours(), to).status, 0);
  QVERIFY(QFile::remove(filesBelow(to).first()));
  QCOMPARE(fetch(ours(), to).out, "Fetched 1 of 2 images; 1 was here already: " + to.toUtf8() + '\n');
  QCOMPARE(filesBelow(to).size(), 2);
}

void TestArchiveMove::whatCannotBeMovedIsExplained_data() {
  QTest::addColumn<QByteArray>("how");
  QTest::addColumn<QByteArray>("sentence");
  const auto row = [](const char* name, const char* how, const char* sentence) {
    QTest::newRow(name) << QByteArray(how) << QByteArray(sentence);
  };
  row("nowhere to listen", "none",
      "offers no retrieval over one association (C-GET): add \"listen\" to the list of archives, so that it "
      "can "
      "send here (C-MOVE).");
  row("a title that the archive does not know", "title",
      "does not know our AE title, or has no address for it. It must know the AE title OTHER");
  row("another port than the archive knows", "port", "It must know the AE title VOLUMEN");
  row("a peer that may not send", "peers", "It must know the AE title VOLUMEN");
  row("a port in use", "in use", "is in use");
}

void TestArchiveMove::whatCannotBeMovedIsExplained() {
  QFETCH(QByteArray, how);
  QFETCH(QByteArray, sentence);
  QTcpServer other;
  QByteArray listen = ours();
  if (how == "none") listen.clear();
  if (how == "title") listen.replace("VOLUMEN", "OTHER");
  if (how == "port") listen = R"({"port": )" + QByteArray::number(freePort()) + '}';
  if (how == "peers") listen.replace("\"ae\"", R"("peers": ["NOBODY"], "ae")");
  if (how == "in use") QVERIFY(other.listen(QHostAddress::LocalHost, quint16(peer_.ourPort())));
  const QString to = folder_.filePath(QString::fromLatin1(how));
  const Outcome done = fetch(listen, to);
  QCOMPARE(done.status, 1);
  QVERIFY2(done.err.contains(sentence), done.err);
  QVERIFY(filesBelow(to).isEmpty());
}

VOLUMEN_TEST(TestArchiveMove);
#include "tst_archive_move.moc"
