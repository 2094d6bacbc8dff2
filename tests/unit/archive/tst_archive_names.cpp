// Guards the names of what archives and peers send: whoever comes second never replaces a file.
#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <algorithm>
#include <array>
#include <thread>

#include "io/archive/fetch_archive.h"
#include "io/archive/instance_folder.h"
#include "io/archive/received_files.h"
#include "io/files/name_for_uid.h"
#include "tests/fixtures/program.h"
#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestArchiveNames : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aFileIsNotReplaced_data();
  void aFileIsNotReplaced();
  void aFetchLeavesWhatAnotherProgramFetched();
  void oneOfManyReceivedAtOnceIsKept();
};

namespace {

void putText(const QString& path, const QByteArray& text) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly) && file.write(text) == text.size());
}

}  // namespace

void TestArchiveNames::aFileIsNotReplaced_data() {
  QTest::addColumn<QByteArray>("there");  // what has the name already
  QTest::addColumn<bool>("isRenamed");
  QTest::newRow("nothing there") << QByteArray() << true;
  QTest::newRow("a file") << QByteArray("file") << false;
  QTest::newRow("a link to nowhere") << QByteArray("link") << false;
  QTest::newRow("a folder") << QByteArray("folder") << false;
}

void TestArchiveNames::aFileIsNotReplaced() {
  QFETCH(QByteArray, there);
  QFETCH(bool, isRenamed);
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("name"));
  {
    auto file = OutputFile::create(folder.filePath(QStringLiteral("other")).toStdString());
    QVERIFY(file && file->write("new"));
    if (there == "file") putText(path, "old");
    if (there == "link") QVERIFY(QFile::link(QStringLiteral("nowhere"), path));
    if (there == "folder") QVERIFY(QDir().mkdir(path));
    const auto renamed = file->commitAsNew(path.toStdString());
    QVERIFY(renamed);
    QCOMPARE(*renamed, isRenamed);
  }
  if (there.isEmpty()) QCOMPARE(contentsOf(path), QByteArray("new"));
  if (there == "file") QCOMPARE(contentsOf(path), QByteArray("old"));
  if (there == "link") QVERIFY(QFileInfo(path).isSymLink());
  QCOMPARE(
      QDir(folder.path()).entryList(QDir::AllEntries | QDir::System | QDir::Hidden | QDir::NoDotAndDotDot),
      QStringList{QStringLiteral("name")});
}

void TestArchiveNames::aFetchLeavesWhatAnotherProgramFetched() {
  const QTemporaryDir folder;
  InstanceFolder files("main", folder.path().toStdString(), "1.2", "1.2.1", 10);
  const auto path = files.begin();
  QVERIFY(path);
  putText(QString::fromStdString(*path), "ours");
  const QString name =
      folder.filePath(QString::fromStdString(nameForUid("1.2.1.1")) + QStringLiteral(".dcm"));
  putText(name, "theirs");
  QVERIFY(files.end({"1.2", "1.2.1", "1.2.1.1", "", ""}));
  QVERIFY(files.has("1.2.1.1"));
  QCOMPARE(contentsOf(name), QByteArray("theirs"));
  QCOMPARE(filesBelow(folder.path()), QStringList{name});
}

// Two images of one UID that differ, each sent by several peers at once.
void TestArchiveNames::oneOfManyReceivedAtOnceIsKept() {
  constexpr std::size_t peers = 8;
  const QTemporaryDir source;
  const QByteArray one = contentsOf(writeArchived(source.path(), archivedStudies[0], 1));
  QByteArray other = one;
  other.replace("Thorax", "Schrax");
  QVERIFY(one != other);
  for (int round = 0; round < 20; ++round) {
    const QTemporaryDir folder;
    ReceivedFiles files(folder.path().toStdString(), {});
    std::array<Filed, peers> filed;
    std::vector<std::thread> threads;
    for (std::size_t n = 0; n < peers; ++n)
      threads.emplace_back([&, n] {
        auto file = files.begin();
        const QByteArray& bytes = n % 2 ? other : one;
        if (file && file->write(bytes.constData(), std::size_t(bytes.size()))) filed[n] = files.file(*file);
      });
    for (std::thread& thread : threads) thread.join();
    const auto kept =
        std::ranges::find_if(filed, [](const Filed& f) { return f.status == 0 && !f.alreadyHere; });
    QVERIFY(kept != filed.end());
    const std::size_t first = std::size_t(kept - filed.begin());
    for (std::size_t n = 0; n < peers; ++n) {
      QCOMPARE(filed[n].status, n % 2 == first % 2 ? 0u : isDuplicate);
      QCOMPARE(filed[n].alreadyHere, n % 2 == first % 2 && n != first);
    }
    const QStringList there = filesBelow(folder.path());
    QCOMPARE(there, QStringList{QString::fromStdString(kept->path)});
    QCOMPARE(contentsOf(there.first()), first % 2 ? other : one);
  }
}

VOLUMEN_TEST(TestArchiveNames);
#include "tst_archive_names.moc"
