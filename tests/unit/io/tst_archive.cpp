// Guards design.md 7: a zip archive is opened like a folder. Nothing is unpacked outside its own folder, and
// a zip bomb is refused before it fills the disk.
#include <archive.h>
#include <archive_entry.h>

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <filesystem>
#include <random>

#include "io/load.h"
#include "io/open.h"
#include "io/zip_archive.h"
#include "io/zip_entries.h"
#include "tests/unit/io/dicom_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

struct Entry {
  std::string name;
  std::vector<std::uint8_t> bytes;
  bool isLink = false;
};

void writeZip(const std::string& path, const std::vector<Entry>& entries) {
  archive* a = archive_write_new();
  archive_write_set_format_zip(a);
  archive_write_open_filename(a, path.c_str());
  for (const Entry& e : entries) {
    archive_entry* entry = archive_entry_new();
    archive_entry_set_pathname(entry, e.name.c_str());
    archive_entry_set_filetype(entry, e.isLink ? AE_IFLNK : AE_IFREG);
    archive_entry_set_perm(entry, 0644);
    if (e.isLink) archive_entry_set_symlink(entry, "/etc/passwd");
    archive_entry_set_size(entry, e.isLink ? 0 : la_int64_t(e.bytes.size()));
    archive_write_header(a, entry);
    if (!e.isLink) archive_write_data(a, e.bytes.data(), e.bytes.size());
    archive_entry_free(entry);
  }
  archive_write_close(a);
  archive_write_free(a);
}

// Returns slices of a series in a folder of the archive.
std::vector<Entry> slices(int count) {
  const DicomFolder folder;
  std::vector<Entry> entries;
  for (int n = 0; n < count; ++n) {
    folder.add("s", sliceAt(n, 10 * n));
    entries.push_back({numbered("study/series/s", n), readAll(folder.path("s")), false});
  }
  return entries;
}

}  // namespace

class TestArchive : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init();
  void cleanup();
  void isOpenedLikeAFolder();
  void aPartOfItIsOpened_data();
  void aPartOfItIsOpened();
  void hostileEntriesAreLeftOut_data();
  void hostileEntriesAreLeftOut();
  void tooManyFilesAreKnownAtOnce();
  void bombIsRefused();
  void flatDataAreNoBomb();
  void everyMutationEndsWell();
  void leftoversGo();

 private:
  std::string path(const char* name) const { return folder_->filePath(QLatin1String(name)).toStdString(); }
  std::unique_ptr<QTemporaryDir> folder_;
};

void TestArchive::init() { folder_ = std::make_unique<QTemporaryDir>(); }

// Mutated archives may hold names that are not text, which QTemporaryDir cannot remove.
void TestArchive::cleanup() { std::filesystem::remove_all(folder_->path().toStdString()); }

void TestArchive::isOpenedLikeAFolder() {
  std::vector<Entry> entries = slices(3);
  const std::string header =
      "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 1\nspacings: 1 1 1\nencoding: raw\ndata file: "
      "v.raw\n\n";
  entries.push_back({"other/v.nhdr", {header.begin(), header.end()}, false});
  entries.push_back({"other/v.raw", {1, 2, 3, 4}, false});
  writeZip(path("a.zip"), entries);
  const Result<Study> study = openStudy(path("a.zip"));
  QVERIFY2(study.ok(), study.ok() ? "" : study.message().c_str());
  QCOMPARE(study->volumes.size(), std::size_t(2));
  for (const Series& series : study->volumes) {
    const auto loaded = loadSeries(series);
    QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.message().c_str());
    if (series.format == "DICOM")
      QCOMPARE(firstOfEachSlice(*loaded->acquired), (std::vector<float>{0, 10, 20}));
  }
  // Opening again does not unpack again.
  const Result<Study> again = openStudy(path("a.zip"));
  QVERIFY(again.ok());
  QCOMPARE(again->volumes[0].path, study->volumes[0].path);
}

void TestArchive::aPartOfItIsOpened_data() {
  QTest::addColumn<QByteArray>("name");
  QTest::addColumn<int>("files");  // number in the only series; 0 if it is not opened
  QTest::newRow("all") << QByteArray("/") << 3;
  QTest::newRow("a folder") << QByteArray("/study/series") << 3;
  QTest::newRow("a file") << QByteArray("/study/series/s1") << 1;
  QTest::newRow("what it does not hold") << QByteArray("/study/s1") << 0;
  QTest::newRow("what lies outside") << QByteArray("/../outside") << 0;
  QTest::newRow("what lies outside, further in") << QByteArray("/study/../../../outside") << 0;
}

// The reported path of an unpacked part opens it again.
void TestArchive::aPartOfItIsOpened() {
  QFETCH(QByteArray, name);
  QFETCH(int, files);
  writeZip(path("a.zip"), slices(3));
  writeAll(path("outside"), slices(1)[0].bytes);
  const Result<Study> study = openStudy(path("a.zip") + name.toStdString());
  if (files == 0) {
    QVERIFY(!study.ok());
    QVERIFY2(study.message().find("a.zip holds no ") != std::string::npos, study.message().c_str());
    return;
  }
  QVERIFY2(study.ok(), study.ok() ? "" : study.message().c_str());
  QCOMPARE(study->volumes.size(), std::size_t(1));
  QCOMPARE(study->volumes[0].files.size(), std::size_t(files));
  const std::string told = lastingPath(study->volumes[0].path);
  QCOMPARE(told, path(files == 1 ? "a.zip/study/series/s1" : "a.zip/study/series"));
  const Result<Study> again = openStudy(told);
  QVERIFY(again.ok());
  QCOMPARE(again->volumes[0].files, study->volumes[0].files);
  QCOMPARE(lastingPath(path("outside")), path("outside"));
}

void TestArchive::hostileEntriesAreLeftOut_data() {
  QTest::addColumn<QByteArray>("name");
  QTest::addColumn<bool>("isLink");
  QTest::newRow("parent folder") << QByteArray("../evil") << false;
  QTest::newRow("parent folder further in") << QByteArray("a/../../../evil") << false;
  QTest::newRow("absolute") << QByteArray("/tmp/volumen-evil") << false;
  QTest::newRow("backslashes") << QByteArray("..\\evil") << false;
  QTest::newRow("a name of 300 bytes") << QByteArray(300, 'x') << false;
  QTest::newRow("100 folders") << QByteArray("a/").repeated(100) + "x" << false;
  QTest::newRow("a link") << QByteArray("link") << true;
  QTest::newRow("a name twice") << QByteArray("study/series/s0") << false;
}

void TestArchive::hostileEntriesAreLeftOut() {
  QFETCH(QByteArray, name);
  QFETCH(bool, isLink);
  std::vector<Entry> entries = slices(2);
  entries.push_back({name.toStdString(), {'e', 'v', 'i', 'l'}, isLink});
  writeZip(path("a.zip"), entries);
  const Result<UnpackedArchive> archive = unpackZip(path("a.zip"), path("cache"), {});
  QVERIFY2(archive.ok(), archive.ok() ? "" : archive.message().c_str());
  QCOMPARE(archive->leftOut.size(), std::size_t(1));
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path("cache")))
    if (entry.is_regular_file() && entry.path().filename() != "lock") {
      QVERIFY(entry.path().string().starts_with(archive->folder));
      ++files;
    }
  QCOMPARE(files, std::size_t(2));
  QVERIFY(!QFile::exists(QStringLiteral("/tmp/volumen-evil")));
}

// The headers alone decide, as unpacking so many files would be slow.
void TestArchive::tooManyFilesAreKnownAtOnce() {
  std::vector<Entry> entries;
  for (int n = 0; n < 100'001; ++n) entries.push_back({std::to_string(n), {}});
  writeZip(path("many.zip"), entries);
  QVERIFY(hasMoreEntries(path("many.zip"), 100'000, {}));
  QVERIFY(!hasMoreEntries(path("many.zip"), 100'001, {}));
  const auto archive = unpackZip(path("many.zip"), path("cache"), {});
  QVERIFY(!archive.ok());
  QVERIFY2(archive.message().find("more than 100000 files: it is not unpacked") != std::string::npos,
           archive.message().c_str());
}

void TestArchive::bombIsRefused() {
  writeZip(path("bomb.zip"), {{"zeros", std::vector<std::uint8_t>(64 << 20), false}});
  const Result<Study> study = openStudy(path("bomb.zip"));
  QVERIFY(!study.ok());
  QVERIFY2(study.message().find("it is not unpacked") != std::string::npos, study.message().c_str());
}

// Small archives may hold data that compress well, such as 8 MiB of zeros.
void TestArchive::flatDataAreNoBomb() {
  writeZip(path("flat.zip"), {{"zeros", std::vector<std::uint8_t>(8 << 20), false}});
  QVERIFY(unpackZip(path("flat.zip"), path("cache"), {}).ok());
}

void TestArchive::everyMutationEndsWell() {
  writeZip(path("a.zip"), slices(2));
  const std::vector<std::uint8_t> whole = readAll(path("a.zip"));
  std::mt19937 random(7);
  int refused = 0;
  for (int n = 0; n < 300; ++n) {
    std::vector<std::uint8_t> spoiled = whole;
    for (int changes = 0; changes < 3; ++changes) spoiled[random() % whole.size()] = std::uint8_t(random());
    if (n % 3 == 0) spoiled.resize(random() % whole.size());
    const std::string name = path(numbered("m", n).c_str());
    writeAll(name, spoiled);
    if (!isZipArchive(name)) continue;
    const Result<UnpackedArchive> archive = unpackZip(name, path("cache"), {});
    if (!archive) ++refused;
    if (!archive) QVERIFY(archive.message().ends_with("."));
  }
  QVERIFY(refused > 0);
}

// Leftovers of a terminated program are removed with the next archive. Those in use by others stay.
void TestArchive::leftoversGo() {
  writeZip(path("a.zip"), slices(1));
  const std::string left = path("cache") + "/archives/left";
  QVERIFY(QDir().mkpath(QString::fromStdString(left + "/files")));
  writeAll(left + "/files/x", {1});
  QVERIFY(unpackZip(path("a.zip"), path("cache"), {}).ok());
  QVERIFY(!std::filesystem::exists(left));
  writeZip(path("b.zip"), slices(2));
  const Result<UnpackedArchive> first = unpackZip(path("a.zip"), path("cache"), {});
  QVERIFY(first.ok() && unpackZip(path("b.zip"), path("cache"), {}).ok());
  QVERIFY(std::filesystem::exists(first->folder));
}

VOLUMEN_TEST(TestArchive);
#include "tst_archive.moc"
