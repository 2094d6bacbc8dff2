// Guards the index (import.md): after any failure of database, program or disk it stays usable. The next
// import gives the same result as an undisturbed one.
#include <unistd.h>

#include <QProcess>
#include <atomic>
#include <filesystem>
#include <functional>
#include <thread>

#include "io/index/schema.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/mount_disk.h"
#include "tests/fixtures/program.h"
#include "tests/unit/index/index_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;
namespace fs = std::filesystem;

namespace {

using Spoil = std::function<void(const std::string& database)>;

void makeStudies(const IndexFolder& folder, int files) {
  for (int n = 0; n < files; ++n) {
    const int study = n % 5;
    const std::string uid = "1." + std::to_string(study);
    folder.add({"f" + std::to_string(n / 40) + "/i" + std::to_string(n), "P" + std::to_string(study), uid,
                uid + "." + std::to_string(n % 2), n});
  }
}

int numberFrom(const char* variable, int otherwise) {
  const int given = qEnvironmentVariableIntValue(variable);
  return given > 0 ? given : otherwise;
}

/// Returns the contents after an undisturbed import.
std::string undisturbed(const IndexFolder& folder) {
  Result<Index> index = Index::open(folder.index() + "-undisturbed");
  if (!index || !index->import({folder.data()})) return "failed";
  return tests::contentsOf(*index);
}

void makeSchema(const std::string& path, std::size_t version) {
  const auto db = Database::open(path);
  for (std::size_t n = 0; n < version; ++n)
    for (const char* statement : indexSteps()[n]) (*db)->run(statement);
  (*db)->runOnce("PRAGMA application_id = 1987013749");
  (*db)->runOnce("PRAGMA user_version = " + std::to_string(version));
  QVERIFY((*db)->takeStatus().ok());
}

}  // namespace

class TestIndexSafety : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void damagedIsSetAside_data();
  void damagedIsSetAside();
  void wholeIsNot_data();
  void wholeIsNot();
  void olderSchemaIsUpdated();
  void killedImportGoesOn();
  void twoProgramsAtOnce();
  void anImportWaitsForALongOne();
  void anOpenIndexKeepsItsLog();
  void threadsReadWhileOneWrites();
  void diskFull();
  void folderThatCannotBeWritten();
  void othersCannotRead();
  void readOnlyData();
};

void TestIndexSafety::damagedIsSetAside_data() {
  QTest::addColumn<Spoil>("spoil");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* name, Spoil spoil, const char* says = "was damaged") {
    QTest::newRow(name) << spoil << QString::fromLatin1(says);
  };
  row("garbage", [](const std::string& db) { writeAll(db, std::vector<std::uint8_t>(9000, 0xa5)); });
  row("text", [](const std::string& db) { writeAll(db, {'h', 'e', 'l', 'l', 'o'}); });
  row("cut in the middle", [](const std::string& db) { fs::resize_file(db, fs::file_size(db) / 2); });
  row("cut within a page", [](const std::string& db) { fs::resize_file(db, fs::file_size(db) - 100); });
  row("a page of zeros", [](const std::string& db) {
    std::vector<std::uint8_t> bytes = readAll(db);
    std::fill(bytes.begin() + 4096, bytes.begin() + 8192, std::uint8_t(0));
    writeAll(db, bytes);
  });
  row("its beginning overwritten", [](const std::string& db) {
    std::vector<std::uint8_t> bytes = readAll(db);
    std::fill(bytes.begin(), bytes.begin() + 64, std::uint8_t(7));
    writeAll(db, bytes);
  });
  row("another program's database", [](const std::string& path) {
    fs::remove(path);
    const auto db = Database::open(path);
    (*db)->run("CREATE TABLE bookmarks(id INTEGER)");
    QVERIFY((*db)->takeStatus().ok());
  });
  row(
      "a newer schema",
      [](const std::string& path) {
        const auto db = Database::open(path);
        (*db)->runOnce("PRAGMA user_version = 99");
        QVERIFY((*db)->takeStatus().ok());
      },
      "newer volumen");
}

void TestIndexSafety::damagedIsSetAside() {
  QFETCH(Spoil, spoil);
  QFETCH(QString, says);
  const IndexFolder folder;
  makeStudies(folder, 40);
  folder.import();
  const std::string database = folder.index() + "/index.sqlite";
  QVERIFY(!fs::exists(database + "-wal"));  // it was closed properly
  spoil(database);
  {
    Index index = folder.open();
    QVERIFY2(index.notice().find(says.toStdString()) != std::string::npos, index.notice().c_str());
    QVERIFY(index.notice().ends_with("."));
    QCOMPARE(studiesIn(index).size(), std::size_t(0));
    QVERIFY(index.import({folder.data()}).ok());
    QCOMPARE(tests::contentsOf(index), undisturbed(folder));
  }
  std::size_t aside = 0;
  for (const auto& entry : fs::directory_iterator(folder.index()))
    aside += entry.path().filename().string().starts_with("index.sqlite.") ? 1 : 0;
  QCOMPARE(aside, std::size_t(1));
  QVERIFY(folder.open().notice().empty());
}

void TestIndexSafety::wholeIsNot_data() {
  QTest::addColumn<Spoil>("spoil");
  const auto row = [](const char* name, Spoil spoil) { QTest::newRow(name) << spoil; };
  row("untouched", [](const std::string&) {});
  row("garbage for a log",
      [](const std::string& db) { writeAll(db + "-wal", std::vector<std::uint8_t>(9000, 0xa5)); });
  row("an empty log", [](const std::string& db) { writeAll(db + "-wal", {}); });
  row("a lock left behind",
      [](const std::string& db) { writeAll(fs::path(db).parent_path().string() + "/index.lock", {}); });
}

void TestIndexSafety::wholeIsNot() {
  QFETCH(Spoil, spoil);
  const IndexFolder folder;
  makeStudies(folder, 40);
  folder.import();
  spoil(folder.index() + "/index.sqlite");
  const Index index = folder.open();
  QCOMPARE(index.notice(), std::string());
  QCOMPARE(tests::contentsOf(index), undisturbed(folder));
}

void TestIndexSafety::olderSchemaIsUpdated() {
  const IndexFolder folder;
  fs::create_directories(folder.index());
  fs::create_directories(folder.data());
  const std::string path = folder.index() + "/index.sqlite";
  makeSchema(path, 1);
  {
    const auto db = Database::open(path);
    (*db)->run("INSERT INTO folder(id, path, device) VALUES(1, ?, 1)", Blob{folder.data()});
    (*db)->run(
        "INSERT INTO study(id, key, uid, patient_name, patient_id, birth_date, sex, date, time, description,"
        " accession, words, imported_at) VALUES(1, x'01', '1.2', 'A', '', '', '', '', '', '', '', 'a', '')");
    (*db)->run(
        "INSERT INTO series(id, study_id, key, uid, number, modality, description, date, time, label,"
        " is_volume, images) VALUES(1, 1, x'02', '1.2.3', '', 'CT', '', '', '', '', 1, 1)");
    (*db)->run(
        "INSERT INTO file(folder_id, name, size, mtime_ns, ctime_ns, inode, device, series_id)"
        " VALUES(1, x'61', 1, 1, 1, 1, 1, 1)");
    QVERIFY((*db)->takeStatus().ok());
  }
  const Index index = folder.open();
  QCOMPARE(index.notice(), std::string());
  QCOMPARE(studiesIn(index).size(), std::size_t(1));
  QCOMPARE(filesIn(index, 1).at(0), folder.data("a"));
  const auto db = Database::open(path);
  QCOMPARE((*db)->number("PRAGMA user_version"), std::int64_t(indexSteps().size()));
  QCOMPARE((*db)->number("SELECT COUNT(*) FROM series_folder"), std::int64_t(1));
}

// Kills the program repeatedly, each time a little later. VOLUMEN_KILLS sets the number of times.
void TestIndexSafety::killedImportGoesOn() {
  const IndexFolder folder;
  makeStudies(folder, 1500);
  const std::string expected = undisturbed(folder);
  const int kills = numberFrom("VOLUMEN_KILLS", 50);
  Chance chance(11);
  int killed = 0;
  for (int n = 0; n < kills; ++n) {
    if (chance.oneIn(4)) fs::remove_all(folder.index());  // most imports resume after the last kill
    QProcess program;
    program.start(QStringLiteral(VOLUMEN_PROGRAM),
                  {QStringLiteral("import"), QString::fromStdString(folder.data()), QStringLiteral("--index"),
                   QString::fromStdString(folder.index())});
    QVERIFY(program.waitForStarted());
    program.waitForFinished(int(chance.between(1, 400)));
    if (program.state() != QProcess::NotRunning) ++killed;
    program.kill();
    program.waitForFinished();
    const Index index = folder.open();
    QVERIFY2(index.notice().empty(), index.notice().c_str());
    QVERIFY(index.studies().ok());
  }
  QVERIFY(killed > 0);
  folder.import();
  QCOMPARE(tests::contentsOf(folder.open()), expected);
}

void TestIndexSafety::twoProgramsAtOnce() {
  const IndexFolder folder;
  makeStudies(folder, 1500);
  const std::string expected = undisturbed(folder);
  for (int round = 0; round < 3; ++round) {
    fs::remove_all(folder.index());
    QProcess programs[3];
    for (QProcess& program : programs)
      program.start(QStringLiteral(VOLUMEN_PROGRAM),
                    {QStringLiteral("import"), QString::fromStdString(folder.data()),
                     QStringLiteral("--index"), QString::fromStdString(folder.index())});
    for (QProcess& program : programs) {
      QVERIFY(program.waitForFinished(120000));
      QVERIFY2(program.exitCode() == 0, program.readAllStandardError().constData());
    }
    const Index index = folder.open();
    QVERIFY2(index.notice().empty(), index.notice().c_str());
    QCOMPARE(tests::contentsOf(index), expected);
  }
}

// On a busy machine another program's import holds the index for more than the usual five seconds of SQLite.
void TestIndexSafety::anImportWaitsForALongOne() {
  const IndexFolder folder;
  makeStudies(folder, 10);
  folder.open();
  const Result<std::unique_ptr<Database>> other = Database::open(folder.index() + "/index.sqlite");
  QVERIFY(other.ok());
  (*other)->begin();
  QProcess program;
  program.start(QStringLiteral(VOLUMEN_PROGRAM),
                {QStringLiteral("import"), QString::fromStdString(folder.data()), QStringLiteral("--index"),
                 QString::fromStdString(folder.index())});
  QVERIFY(!program.waitForFinished(7000));
  QVERIFY((*other)->commit().ok());
  QVERIFY(program.waitForFinished(120000));
  QVERIFY2(program.exitCode() == 0, program.readAllStandardError().constData());
}

// A program that stays (the window, a listener) keeps its locks, whatever else it opens: others that come and
// go must not delete the log that it writes to.
void TestIndexSafety::anOpenIndexKeepsItsLog() {
  const IndexFolder folder;
  folder.add({"first/1.dcm", "First^Patient", "1.2.1", "1.2.1.1"});
  folder.import("first");
  Index index = folder.open();
  const auto listed = [&] {
    return runProgram(
               {QStringLiteral("list"), QStringLiteral("--index"), QString::fromStdString(folder.index())})
        .out;
  };
  folder.open();
  QVERIFY(listed().contains("First"));
  folder.add({"second/1.dcm", "Second^Patient", "1.2.2", "1.2.2.1"});
  QVERIFY(index.import({folder.data("second")}).ok());
  QVERIFY(fs::exists(folder.index() + "/index.sqlite-wal"));
  for (int n = 0; n < 2; ++n) QVERIFY2(listed().contains("Second"), listed());
  QVERIFY(fs::exists(folder.index() + "/index.sqlite-wal"));
}

void TestIndexSafety::threadsReadWhileOneWrites() {
  const IndexFolder folder;
  makeStudies(folder, 800);
  folder.open();
  std::atomic<bool> done{false};
  std::atomic<int> failures{0}, reads{0};
  std::vector<std::thread> readers;
  for (int n = 0; n < 2; ++n)
    readers.emplace_back([&] {
      const Index index = folder.open();
      while (!done) {
        const auto studies = index.studies({.words = "p"});
        failures += studies.ok() ? 0 : 1;
        ++reads;
      }
    });
  const ImportReport report = folder.import();
  done = true;
  for (std::thread& reader : readers) reader.join();
  QCOMPARE(report.added, 800);
  QCOMPARE(failures.load(), 0);
  QVERIFY(reads > 0);
}

void TestIndexSafety::diskFull() {
  const IndexFolder folder;
  makeStudies(folder, 1500);
  fs::create_directories(folder.index());
  MOUNT_DISK(folder.index().c_str(), 0, "size=300k");
  std::string message;
  std::size_t kept = 0;
  bool usable = false;
  {
    Index index = folder.open();
    const auto report = index.import({folder.data()});
    if (!report) message = report.message();
    usable = index.studies().ok();
  }
  {
    const Result<Index> again = Index::open(folder.index());
    if (again && again->notice().empty() && again->studies()) kept = again->studies()->size() + 1;
  }
  mount("tmpfs", folder.index().c_str(), "tmpfs", MS_REMOUNT, "size=64m");
  std::string after;
  {
    Index index = folder.open();
    if (index.notice().empty() && index.import({folder.data()})) after = tests::contentsOf(index);
  }
  QCOMPARE(umount(folder.index().c_str()), 0);
  QVERIFY2(message.find("disk is full") != std::string::npos, message.c_str());
  QVERIFY(usable);
  QVERIFY(kept > 0);
  QCOMPARE(after, undisturbed(folder));
}

void TestIndexSafety::folderThatCannotBeWritten() {
  const IndexFolder folder;
  const Result<Index> noFolder = Index::open("/proc/volumen");
  QVERIFY(!noFolder.ok());
  QVERIFY2(noFolder.message().find("/proc/volumen") != std::string::npos, noFolder.message().c_str());
  fs::create_directories(folder.index());
  MOUNT_DISK(folder.index().c_str(), MS_RDONLY, "size=300k");
  const Result<Index> readOnly = Index::open(folder.index());
  QCOMPARE(umount(folder.index().c_str()), 0);
  QVERIFY(!readOnly.ok());
  QVERIFY2(readOnly.message().find("Cannot write") != std::string::npos, readOnly.message().c_str());
}

// Permissions are also restricted if the folder existed before and was open to all.
void TestIndexSafety::othersCannotRead() {
  const IndexFolder folder;
  fs::create_directories(folder.index());
  const Index index = folder.open();
  for (const auto& entry : fs::directory_iterator(folder.index()))
    if (entry.path().filename().string().starts_with("index.sqlite"))
      QCOMPARE(int(entry.status().permissions()), 0600);
}

void TestIndexSafety::readOnlyData() {
  const IndexFolder folder;
  makeStudies(folder, 40);
  fs::permissions(folder.data("f0"), fs::perms::owner_read | fs::perms::owner_exec);
  QCOMPARE(folder.import().added, 40);
  fs::permissions(folder.data("f0"), fs::perms::owner_all);
}

VOLUMEN_TEST(TestIndexSafety);
#include "tst_index_safety.moc"
