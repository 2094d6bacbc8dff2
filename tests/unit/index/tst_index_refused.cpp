// Guards what the index reports about files that could not be read, and when it reads them again.
#include <filesystem>

#include "io/index/database.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/index/index_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;
namespace fs = std::filesystem;

class TestIndexRefused : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void refusedFileIsReadOnce();
  void refusedFileIsTold();
  void whatIsToldFollowsTheFiles();
  void whatWasRefusedIsReadAgainWhereAsked();
};

void TestIndexRefused::refusedFileIsReadOnce() {
  const IndexFolder folder;
  folder.add({"a/i0", "A", "1.1", "1.1.1", 0});
  folder.add({"a/i1", "A", "1.1", "1.1.1", 1});
  const std::vector<std::uint8_t> whole = readAll(folder.data("a/i1"));
  fs::resize_file(folder.data("a/i1"), whole.size() - 9);
  const ImportReport first = folder.import();
  QCOMPARE(first.refused.size(), std::size_t(1));
  QVERIFY(first.refused[0].reason.find("cut off") != std::string::npos);
  Index index = folder.open();
  bool read = false;
  const auto again = index.import({folder.data()}, [&](const char* what, std::size_t, std::size_t) {
    read |= std::string(what) == "reading headers";
  });
  QVERIFY(!read);
  QCOMPARE(again->refused.size(), std::size_t(1));
  QCOMPARE(again->refused[0].reason, first.refused[0].reason);
  writeAll(folder.data("a/i1"), whole);
  const ImportReport repaired = folder.import();
  QCOMPARE(repaired.refused.size(), std::size_t(0));
  QCOMPARE(repaired.added, 1);
  QCOMPARE(studiesIn(index).at(0).images, 2);
  QCOMPARE(studiesIn(index).at(0).warnings, 0);
}

// A refused file gives a warning of the series it belongs to.
void TestIndexRefused::refusedFileIsTold() {
  const IndexFolder folder;
  for (int n = 0; n < 3; ++n) folder.add({"a/i" + std::to_string(n), "A", "1.1", "1.1.1", n});
  fs::resize_file(folder.data("a/i2"), fs::file_size(folder.data("a/i2")) - 9);
  folder.import();
  const Index index = folder.open();
  const IndexedStudy study = studiesIn(index).at(0);
  QCOMPARE(study.warnings, 1);
  const std::vector<std::string> warnings = seriesIn(index, study.id).at(0).warnings;
  QCOMPARE(warnings.size(), std::size_t(1));
  QVERIFY2(warnings[0].starts_with("Slice i2 could not be read"), warnings[0].c_str());
  fs::remove(folder.data("a/i2"));
  folder.import();
  QCOMPARE(studiesIn(folder.open()).at(0).warnings, 0);
}

// Covers a refused file that is added later, that stays refused, and that is repaired.
void TestIndexRefused::whatIsToldFollowsTheFiles() {
  const IndexFolder folder;
  for (int n = 0; n < 3; ++n) folder.add({"a/i" + std::to_string(n), "A", "1.1", "1.1.1", n});
  folder.import();
  folder.add({"a/i3", "A", "1.1", "1.1.1", 3});
  const std::vector<std::uint8_t> whole = readAll(folder.data("a/i3"));
  fs::resize_file(folder.data("a/i3"), 200);
  for (int times = 0; times < 2; ++times) {
    folder.import();
    QCOMPARE(studiesIn(folder.open()).at(0).warnings, 1);
  }
  folder.add({"a/i4", "A", "1.1", "1.1.1", 4});
  folder.import();
  QCOMPARE(studiesIn(folder.open()).at(0).warnings, 1);
  writeAll(folder.data("a/i3"), whole);
  folder.import();
  QCOMPARE(studiesIn(folder.open()).at(0).warnings, 0);
  QCOMPARE(studiesIn(folder.open()).at(0).images, 5);
}

// Imitates an index that mistook a failure of the machine for one of the file.
void TestIndexRefused::whatWasRefusedIsReadAgainWhereAsked() {
  const IndexFolder folder;
  for (int n = 0; n < 3; ++n) folder.add({"a/i" + std::to_string(n), "A", "1.1", "1.1.1", n});
  folder.import();
  {
    const auto db = Database::open(folder.index() + "/index.sqlite");
    (*db)->run("UPDATE file SET series_id = NULL, reason = 'made to do harm', program = ? WHERE name = ?",
               VOLUMEN_VERSION, Blob{"i1"});
    QVERIFY((*db)->takeStatus().ok());
  }
  QCOMPARE(folder.import().refused.size(), std::size_t(1));
  Index index = folder.open();
  const auto again = index.import({folder.data()}, {}, {}, true);
  QCOMPARE(again->refused.size(), std::size_t(0));
  QCOMPARE(again->added, 1);
  QCOMPARE(studiesIn(index).at(0).images, 3);
}

VOLUMEN_TEST(TestIndexRefused);
#include "tst_index_refused.moc"
