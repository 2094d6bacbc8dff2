// Guards the size of what archives sent: studies that were fetched go, those unused longest first, and
// nothing else, nor what the user keeps.
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include "io/archive/fetch_archive.h"
#include "io/archive/fetched_studies.h"
#include "io/files/name_for_uid.h"
#include "tests/fixtures/program.h"
#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestArchiveTrim : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init();
  void whatIsUnusedLongestGoes_data();
  void whatIsUnusedLongestGoes();
  void othersStay_data();
  void othersStay();
  void keptStudiesStay_data();
  void keptStudiesStay();
  void onlyFetchedStudiesAreKept_data();
  void onlyFetchedStudiesAreKept();

 private:
  Outcome keep(const QStringList& words) const;
  QString studyFolder(int study) const;
  QJsonObject fetch(int study, const char* keepGb);
  QStringList inIndex() const;
  bool enlarge(int study, qint64 bytes) const;

  std::unique_ptr<QTemporaryDir> folder_;
  std::unique_ptr<QrPeer> peer_;
};

namespace {

constexpr qint64 mostOfAGb = 600'000'000;

QString uidOf(int study) { return QStringLiteral("1.2.%1").arg(study); }

}  // namespace

void TestArchiveTrim::init() {
  if (!QrPeer::isInstalled()) QSKIP("dcmqrscp is not installed (package dcmtk)");
  folder_ = std::make_unique<QTemporaryDir>();
  const QString scans = folder_->filePath(QStringLiteral("scans"));
  QVERIFY(QDir().mkpath(scans));
  peer_ = std::make_unique<QrPeer>();
  peer_->add(writeAllArchived(scans));
  QVERIFY(peer_->start());
}

QString TestArchiveTrim::studyFolder(int study) const {
  const std::string index = folder_->filePath(QStringLiteral("index")).toStdString();
  return QString::fromStdString(fetchedFolder(index, uidOf(study).toStdString()));
}

// Fetches a study into the index. Returns the report; empty if that failed.
QJsonObject TestArchiveTrim::fetch(int study, const char* keepGb) {
  const QString list = folder_->filePath(QStringLiteral("archives.json"));
  QFile file(list);
  if (!file.open(QIODevice::WriteOnly)) return {};
  file.write(R"({"archives": [{"name": "main", "kind": "dimse", "host": "127.0.0.1", "port": )" +
             QByteArray::number(peer_->port()) + R"(, "calledAe": "ARCH"}], "keepGb": )" + keepGb + "}");
  file.close();
  const Outcome outcome =
      runProgram({QStringLiteral("archive"), QStringLiteral("fetch"), QStringLiteral("main"), uidOf(study),
                  QStringLiteral("--archives"), list, QStringLiteral("--index"),
                  folder_->filePath(QStringLiteral("index")), QStringLiteral("--json")});
  if (outcome.status != 0) qWarning("%s", outcome.err.constData());
  return outcome.status == 0 ? QJsonDocument::fromJson(outcome.out).object() : QJsonObject();
}

Outcome TestArchiveTrim::keep(const QStringList& words) const {
  return runProgram(QStringList{QStringLiteral("archive"), QStringLiteral("keep"), QStringLiteral("--index"),
                                folder_->filePath(QStringLiteral("index")), QStringLiteral("--json")} +
                    words);
}

QStringList TestArchiveTrim::inIndex() const {
  const Outcome outcome = runProgram({QStringLiteral("list"), QStringLiteral("--json"),
                                      QStringLiteral("--index"), folder_->filePath(QStringLiteral("index"))});
  return uidsOf(QJsonDocument::fromJson(outcome.out).object()[u"studies"].toArray());
}

// Makes the first file of a study as large as this, with a hole.
bool TestArchiveTrim::enlarge(int study, qint64 bytes) const {
  const QStringList files = filesBelow(studyFolder(study));
  return !files.isEmpty() && QFile::resize(files.first(), bytes);
}

void TestArchiveTrim::whatIsUnusedLongestGoes_data() {
  QTest::addColumn<int>("opened");  // between the fetches; 0: none
  QTest::addColumn<QByteArray>("keepGb");
  QTest::addColumn<QStringList>("removed");
  QTest::newRow("what was fetched first") << 0 << QByteArray("1") << QStringList{uidOf(1)};
  QTest::newRow("but not if it was opened later") << 1 << QByteArray("1") << QStringList{uidOf(2)};
  QTest::newRow("nothing that has room") << 0 << QByteArray("2") << QStringList();
  QTest::newRow("nothing without a limit") << 0 << QByteArray("0") << QStringList();
}

void TestArchiveTrim::whatIsUnusedLongestGoes() {
  QFETCH(int, opened);
  QFETCH(QByteArray, keepGb);
  QFETCH(QStringList, removed);
  for (int study : {1, 2}) {
    QVERIFY(!fetch(study, "1").isEmpty());
    QVERIFY(enlarge(study, mostOfAGb));
  }
  if (opened > 0) QCOMPARE(runProgram({QStringLiteral("info"), studyFolder(opened)}).status, 0);
  const QJsonObject report = fetch(3, keepGb.constData());
  QStringList told;
  for (const QJsonValue& uid : report[u"removedStudies"].toArray()) told << uid.toString();
  QCOMPARE(told, removed);
  for (int study : {1, 2, 3}) {
    const bool isRemoved = removed.contains(uidOf(study));
    QCOMPARE(QDir(studyFolder(study)).exists(), !isRemoved);
    QCOMPARE(inIndex().contains(uidOf(study)), !isRemoved);
  }
  // It comes again, and may go again.
  for (const QString& uid : removed)
    QCOMPARE(fetch(uid.back().digitValue(), "2")[u"fetched"].toInt() > 0, true);
}

void TestArchiveTrim::othersStay_data() {
  QTest::addColumn<QByteArray>("what");
  QTest::newRow("a study that a peer has sent images of") << QByteArray("received");
  QTest::newRow("a study that another program uses") << QByteArray("used");
  QTest::newRow("a study that was here before it was fetched") << QByteArray("older");
  QTest::newRow("what a link in place of a study leads to") << QByteArray("link");
  QTest::newRow("what a link in place of a series leads to") << QByteArray("link of a series");
  QTest::newRow("files of other names") << QByteArray("other names");
}

void TestArchiveTrim::othersStay() {
  QFETCH(QByteArray, what);
  const QString study = studyFolder(1), root = QFileInfo(study).path();
  if (what == "older") QVERIFY(QDir().mkpath(study));
  QVERIFY(!fetch(1, "1").isEmpty());
  QVERIFY(enlarge(1, 2 * mostOfAGb));
  QString file = filesBelow(study).first();
  const QString series = QFileInfo(file).path(), elsewhere = folder_->filePath(QStringLiteral("elsewhere"));
  if (what == "received")
    QVERIFY(beginReceived(root.toStdString(), nameForUid("1.2.1"), nameForUid("1.2.1.9")));
  if (what == "used") useFetched({file.toStdString()});
  if (what.startsWith("link")) {
    const QString from = what == "link" ? study : series;
    QVERIFY(QDir().rename(from, elsewhere) && QFile::link(elsewhere, from));
    QVERIFY(!fetch(2, "1").isEmpty());
    QVERIFY(enlarge(2, 2 * mostOfAGb));
    file.replace(from, elsewhere);
  }
  if (what == "other names") {
    const QString other = series + QStringLiteral("/report.dcm");
    QVERIFY(QFile::copy(filesBelow(folder_->filePath(QStringLiteral("scans"))).first(), other));
    file = other;
  }
  QVERIFY(!fetch(3, "1").isEmpty());
  QVERIFY(QFile::exists(file));
}

void TestArchiveTrim::keptStudiesStay_data() {
  QTest::addColumn<bool>("isLetGo");
  QTest::addColumn<qint64>("bytesOfSecond");
  QTest::addColumn<QStringList>("removed");
  QTest::newRow("a kept study does not count") << false << mostOfAGb << QStringList();
  QTest::newRow("others go in its place") << false << 2 * mostOfAGb << QStringList{uidOf(2)};
  QTest::newRow("not if it is kept no longer") << true << mostOfAGb << QStringList{uidOf(1)};
}

void TestArchiveTrim::keptStudiesStay() {
  QFETCH(bool, isLetGo);
  QFETCH(qint64, bytesOfSecond);
  QFETCH(QStringList, removed);
  const auto kept = [&] { return QJsonDocument::fromJson(keep({}).out)[u"kept"].toArray().toVariantList(); };
  QVERIFY(!fetch(1, "0").isEmpty() && enlarge(1, mostOfAGb));
  QVERIFY(!fetch(2, "0").isEmpty() && enlarge(2, bytesOfSecond));
  QVERIFY(kept().isEmpty());
  QCOMPARE(keep({uidOf(1)}).status, 0);
  QCOMPARE(kept(), QVariantList{uidOf(1)});
  if (isLetGo) QCOMPARE(keep({uidOf(1), QStringLiteral("--off")}).status, 0);
  QCOMPARE(kept().isEmpty(), isLetGo);
  const QJsonObject report = fetch(3, "1");
  QCOMPARE(report[u"removedStudies"].toArray(), QJsonArray::fromStringList(removed));
  for (int study : {1, 2, 3}) QCOMPARE(inIndex().contains(uidOf(study)), !removed.contains(uidOf(study)));
}

void TestArchiveTrim::onlyFetchedStudiesAreKept_data() {
  QTest::addColumn<QByteArray>("what");
  QTest::newRow("a study that is not here") << QByteArray();
  QTest::newRow("a study that a peer has sent images of") << QByteArray("received");
  QTest::newRow("a study whose images are gone") << QByteArray("gone");
}

void TestArchiveTrim::onlyFetchedStudiesAreKept() {
  QFETCH(QByteArray, what);
  if (!what.isEmpty()) QVERIFY(!fetch(1, "1").isEmpty());
  if (what == "received")
    QVERIFY(beginReceived(QFileInfo(studyFolder(1)).path().toStdString(), nameForUid("1.2.1"),
                          nameForUid("1.2.1.9")));
  if (what == "gone")
    for (const QString& file : filesBelow(studyFolder(1))) QVERIFY(QFile::remove(file));
  const Outcome outcome = keep({uidOf(1)});
  QCOMPARE(outcome.status, 1);
  QVERIFY2(outcome.err.contains("The study 1.2.1 was not fetched from an archive to this computer"),
           outcome.err);
  QVERIFY(QJsonDocument::fromJson(outcome.out)[u"problem"].isString());
}

VOLUMEN_TEST(TestArchiveTrim);
#include "tst_archive_trim.moc"
