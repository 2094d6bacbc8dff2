// Guards the institutions of the index (import.md). An older index without them reads them later, from one
// file of each study. Files that have changed since they were indexed are not used.
#include <filesystem>
#include <functional>

#include "io/index/schema.h"
#include "tests/unit/index/index_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;
namespace fs = std::filesystem;

namespace {

using SpoilFile = std::function<void(const std::string& path)>;

// Turns the index into one of the version without institutions.
void forgetInstitutions(const IndexFolder& folder) {
  const auto db = Database::open(folder.index() + "/index.sqlite");
  (*db)->run("ALTER TABLE study DROP COLUMN institution");
  (*db)->run("ALTER TABLE file DROP COLUMN no_image");
  (*db)->run("UPDATE study SET words = 'a'");
  (*db)->runOnce("PRAGMA user_version = 2");
  QVERIFY((*db)->takeStatus().ok());
}

// Returns the institutions of all studies, sorted by patient name; "?" if unknown.
QString institutionsIn(const IndexFolder& folder) {
  folder.open();  // updates the schema
  const auto db = Database::open(folder.index() + "/index.sqlite");
  QStringList all;
  for (Rows rows = (*db)->run("SELECT IFNULL(institution, '?') FROM study ORDER BY patient_name");
       rows.next();)
    all << QString::fromStdString(rows.text(0));
  return all.join(QLatin1Char(';'));
}

}  // namespace

class TestIndexInstitutions : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void areReadLater();
  void areOfTheFilesIndexed_data();
  void areOfTheFilesIndexed();
  void areNoReasonToBeCancelled();
};

// Opens an index of the version without institutions. Its contents stay. The next import of any folder reads
// one file of each study, if that file is present.
void TestIndexInstitutions::areReadLater() {
  const IndexFolder folder;
  folder.add({"a/1", "A", "1.1", "1.1.1", 0});
  folder.add({"a/2", "A", "1.1", "1.1.1", 1});
  folder.add({"b/1", "B", "1.2", "1.2.1", 0});
  folder.add({"c/1", "C", "1.3", "1.3.1", 0});
  folder.import();
  const std::string expected = tests::contentsOf(folder.open());
  QVERIFY(folder.open().opened(studiesIn(folder.open()).at(0).id).ok());
  forgetInstitutions(folder);
  fs::rename(folder.data("b"), folder.data("") + "-away");
  {
    const Index index = folder.open();
    QCOMPARE(index.notice(), std::string());
    const std::vector<IndexedStudy> all = studiesIn(index);
    QCOMPARE(all.size(), std::size_t(3));
    QVERIFY(std::ranges::all_of(all, [](const IndexedStudy& s) { return s.institution.empty(); }));
    QCOMPARE(std::ranges::count(all, std::string(), &IndexedStudy::openedAt), std::ptrdiff_t(2));
  }
  const ImportReport report = folder.import("c");
  QVERIFY(report.unchanged == 1 && report.added == 0 && report.changed == 0);
  QCOMPARE(studiesIn(folder.open(), {.words = "louis hopital"}).size(), std::size_t(2));
  fs::rename(folder.data("") + "-away", folder.data("b"));
  folder.import("c");
  QCOMPARE(studiesIn(folder.open(), {.words = "louis hopital"}).size(), std::size_t(3));
  QCOMPARE(tests::contentsOf(folder.open()), expected);
}

void TestIndexInstitutions::areOfTheFilesIndexed_data() {
  QTest::addColumn<SpoilFile>("spoil");  // changes the file at a path
  QTest::addColumn<QString>("made");
  const auto row = [](const char* name, SpoilFile spoil, const char* made) {
    QTest::newRow(name) << spoil << QString::fromLatin1(made);
  };
  row(
      "a file as it was", [](const std::string&) {}, "North");
  row(
      "one that changed",
      [](const std::string& path) {
        std::vector<std::uint8_t> bytes = readAll(path);
        bytes.push_back(0);
        writeAll(path, bytes);
      },
      "?");
  row(
      "one written to by the time of before",
      [](const std::string& path) {
        const auto before = fs::last_write_time(path);
        writeAll(path, std::vector<std::uint8_t>(fs::file_size(path), 0xa5));
        fs::last_write_time(path, before);
      },
      "?");
  row(
      "another one in its place",
      [](const std::string& path) {
        const auto before = fs::last_write_time(path);
        fs::copy_file(path, path + ".copy");
        fs::rename(path, path + ".kept");  // keeps the file, so that its inode is not reused
        fs::rename(path + ".copy", path);
        fs::last_write_time(path, before);
      },
      "?");
  row(
      "one that is gone", [](const std::string& path) { fs::remove(path); }, "?");
}

// Spoils one file of the study before its institution is read.
void TestIndexInstitutions::areOfTheFilesIndexed() {
  QFETCH(SpoilFile, spoil);
  QFETCH(QString, made);
  const IndexFolder folder;
  MadeFile file{"a/1", "A", "1.1", "1.1.1", 0};
  file.institution = "North";
  folder.add(file);
  // Only one of the two series names its institution.
  MadeFile silent{"b/1", "B", "1.2", "1.2.1", 0}, named{"b/2", "B", "1.2", "1.2.2", 1};
  silent.institution = "", named.institution = "South";
  folder.add(silent);
  folder.add(named);
  MadeFile nowhere{"c/1", "C", "1.3", "1.3.1", 0};
  nowhere.institution = "";
  folder.add(nowhere);
  folder.add({"d/1", "D", "1.4", "1.4.1", 0});
  folder.import();
  forgetInstitutions(folder);
  QCOMPARE(institutionsIn(folder), QStringLiteral("?;?;?;?"));
  spoil(folder.data("a/1"));
  QVERIFY(!folder.import("d").cancelled);
  QCOMPARE(institutionsIn(folder), made + QStringLiteral(";South;;Hôpital Saint-Louis"));
}

// Reading institutions reports its own progress. If cancelled, it resumes with the next import.
void TestIndexInstitutions::areNoReasonToBeCancelled() {
  const IndexFolder folder;
  for (int n = 0; n < 5; ++n) {
    const std::string uid = "1." + std::to_string(n);
    folder.add({"f" + std::to_string(n) + "/1", "P" + std::to_string(n), uid, uid + ".1", 0, {}, "North"});
  }
  folder.import();
  forgetInstitutions(folder);
  const CancelToken cancel;
  const auto stopAtThird = [&](const char* what, std::size_t done, std::size_t total) {
    if (std::string(what) != readingInstitutions) return;
    QCOMPARE(total, std::size_t(5));
    if (done == 2) cancel.cancel();
  };
  const Result<ImportReport> report = folder.open().import({folder.data("f0")}, stopAtThird, cancel);
  QVERIFY(report && !report->cancelled);
  QCOMPARE(report->unchanged, 1);
  QCOMPARE(institutionsIn(folder), QStringLiteral("North;North;North;?;?"));
  folder.import("f0");
  QCOMPARE(institutionsIn(folder), QStringLiteral("North;North;North;North;North"));
}

VOLUMEN_TEST(TestIndexInstitutions);
#include "tst_index_institutions.moc"
