// Guards `volumen archive fetch`: what a real archive (dcmqrscp) holds comes whole, once, and into the index.
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include "tests/fixtures/program.h"
#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestArchiveFetch : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void fetchedInstancesAreThoseOfTheArchive();
  void whatIsHereIsNotFetchedAgain();
  void aStudyIsFetchedIntoTheIndex();
  void aStudyOfAnArchiveIsAPath();
  void whatCannotBeFetchedIsExplained_data();
  void whatCannotBeFetchedIsExplained();

 private:
  Outcome fetch(const QStringList& more) const;

  QTemporaryDir folder_;
  QrPeer peer_;
};

void TestArchiveFetch::initTestCase() {
  if (!QrPeer::isInstalled()) QSKIP("dcmqrscp is not installed (package dcmtk)");
  peer_.add(writeAllArchived(folder_.path()));
  QVERIFY(peer_.start());
  QFile list(folder_.filePath(QStringLiteral("archives.json")));
  QVERIFY(list.open(QIODevice::WriteOnly));
  list.write(R"({"archives": [{"name": "qr", "kind": "dimse", "host": "127.0.0.1", "port": )" +
             QByteArray::number(peer_.port()) + R"(, "calledAe": "ARCH"}]})");
}

Outcome TestArchiveFetch::fetch(const QStringList& more) const {
  return runProgram(QStringList{QStringLiteral("archive"), QStringLiteral("fetch"), QStringLiteral("qr"),
                                QStringLiteral("--archives"),
                                folder_.filePath(QStringLiteral("archives.json"))} +
                    more);
}

void TestArchiveFetch::fetchedInstancesAreThoseOfTheArchive() {
  for (const ArchivedStudy& m : archivedStudies) {
    const QString folder = folder_.filePath(QStringLiteral("of ") + QString::fromLatin1(m.uid));
    const Outcome done =
        fetch({QString::fromLatin1(m.uid), QStringLiteral("-o"), folder, QStringLiteral("--json")});
    QVERIFY2(done.status == 0, done.err);
    QVERIFY2(done.err.isEmpty(), done.err);
    const QJsonObject told = QJsonDocument::fromJson(done.out).object();
    const QStringList files = filesBelow(folder);
    QCOMPARE(told[QStringLiteral("fetched")].toInt(), files.size());
    QCOMPARE(files.size(), qstrcmp(m.uid, archivedStudies[0].uid) == 0 ? 2 : 1);
    for (const QString& file : files) {
      const Instance fetched = instanceIn(file);
      const QString source = QString::fromStdString(fetched.seriesUid) + QStringLiteral(".dcm");
      QVERIFY(fetched == instanceIn(folder_.filePath(source)));
      QCOMPARE(fetched.name, std::string(m.name));
    }
  }
}

void TestArchiveFetch::whatIsHereIsNotFetchedAgain() {
  const QString folder = folder_.filePath(QStringLiteral("twice"));
  const auto told = [&] { return fetch({QStringLiteral("1.2.1"), QStringLiteral("-o"), folder}).out; };
  QCOMPARE(told(), "Fetched 2 of 2 images: " + folder.toUtf8() + '\n');
  QCOMPARE(told(), "Fetched 0 of 2 images; 2 were here already: " + folder.toUtf8() + '\n');
  QVERIFY(QFile::remove(filesBelow(folder).first()));
  QCOMPARE(told(), "Fetched 1 of 2 images; 1 was here already: " + folder.toUtf8() + '\n');
  QCOMPARE(filesBelow(folder).size(), 2);
  const Outcome one =
      fetch({QStringLiteral("1.2.1/1.2.1.2"), QStringLiteral("-o"), folder + QStringLiteral("/one")});
  QVERIFY2(one.out.startsWith("Fetched 1 of 1 images: "), one.out);
}

void TestArchiveFetch::aStudyIsFetchedIntoTheIndex() {
  const QString index = folder_.filePath(QStringLiteral("fetched index"));
  const Outcome done = fetch({QStringLiteral("1.2.3"), QStringLiteral("--index"), index});
  QVERIFY2(done.status == 0, done.err);
  const Outcome listed =
      runProgram({QStringLiteral("list"), QStringLiteral("--index"), index, QStringLiteral("--json")});
  QCOMPARE(uidsOf(QJsonDocument::fromJson(listed.out)[QStringLiteral("studies")].toArray()),
           QStringList{QStringLiteral("1.2.3")});
}

// Each command fetches what "archive:NAME/STUDY[/SERIES]" names, and keeps it.
void TestArchiveFetch::aStudyOfAnArchiveIsAPath() {
  const QString config = folder_.filePath(QStringLiteral("config/volumen"));
  QVERIFY(QDir().mkpath(config));
  QVERIFY(QFile::copy(folder_.filePath(QStringLiteral("archives.json")),
                      config + QStringLiteral("/archives.json")));
  qputenv("XDG_CONFIG_HOME", folder_.filePath(QStringLiteral("config")).toUtf8());
  qputenv("XDG_DATA_HOME", folder_.filePath(QStringLiteral("data")).toUtf8());
  const auto info = [](const char* path) {
    return runProgram({QStringLiteral("info"), QString::fromLatin1(path), QStringLiteral("--json")});
  };
  const Outcome study = info("archive:qr/1.2.1"), series = info("archive:qr/1.2.1/1.2.1.2");
  const Outcome link = info("volumen:archive:qr/1.2.1%2F1.2.1.2"), file = info("volumen:/etc/hosts");
  const Outcome unknown = info("archive:qr/9.9"), noStudy = info("archive:qr"),
                noArchive = info("archive:x/1");
  const QStringList kept = filesBelow(folder_.filePath(QStringLiteral("data/volumen/fetched")));
  qunsetenv("XDG_CONFIG_HOME");
  qunsetenv("XDG_DATA_HOME");
  QVERIFY2(study.status == 0 && study.out.contains("1.2.1.1") && study.out.contains("1.2.1.2"), study.err);
  QVERIFY2(series.status == 0 && !series.out.contains("\"1.2.1.1\""), series.err);
  QCOMPARE(kept.size(), 2);
  QCOMPARE(link.out, series.out);
  QVERIFY2(file.status == 1 && file.err.contains("volumen:/etc/hosts"), file.err);
  QVERIFY2(unknown.status == 1 && unknown.err.contains("archive:qr/9.9: The archive \"qr\" lists no images"),
           unknown.err);
  QVERIFY2(noStudy.err.contains("archive:qr: name a study by its UID"), noStudy.err);
  QVERIFY2(noArchive.err.contains("archive:x/1: There is no archive \"x\""), noArchive.err);
}

void TestArchiveFetch::whatCannotBeFetchedIsExplained_data() {
  QTest::addColumn<QString>("study");
  QTest::addColumn<QString>("folder");
  QTest::addColumn<QByteArray>("sentence");
  const auto row = [](const char* name, const char* study, const char* folder, const char* sentence) {
    QTest::newRow(name) << QString::fromLatin1(study) << QString::fromLatin1(folder) << QByteArray(sentence);
  };
  row("an unknown study", "9.9.9", "", "The archive \"qr\" lists no images of this study.");
  row("an unknown series", "1.2.1/9.9.9", "", "The archive \"qr\" lists no images of this series.");
  row("a UID that is a path", "..", "", "The archive \"qr\" lists no images of this study.");
  row("a folder that cannot be made", "1.2.1", "/proc/none", "/proc/none");
}

void TestArchiveFetch::whatCannotBeFetchedIsExplained() {
  QFETCH(QString, study);
  QFETCH(QString, folder);
  QFETCH(QByteArray, sentence);
  const QString to = folder.isEmpty() ? folder_.filePath(QStringLiteral("nothing")) : folder;
  const Outcome done = fetch({study, QStringLiteral("-o"), to});
  QCOMPARE(done.status, 1);
  QVERIFY2(done.err.contains(sentence), done.err);
  QVERIFY(done.out.isEmpty());
  QVERIFY(filesBelow(to).isEmpty());
}

VOLUMEN_TEST(TestArchiveFetch);
#include "tst_archive_fetch.moc"
