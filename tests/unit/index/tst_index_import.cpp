// Guards the index (import.md): it lists the same contents of a folder as `info`, and every change of files
// is noticed.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "io/open.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/index/index_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;
namespace fs = std::filesystem;

namespace {

using Change = std::function<void(const IndexFolder&)>;

/// Makes two studies. The first has two series in separate folders.
void makeStudies(const IndexFolder& folder) {
  for (int n = 0; n < 4; ++n) {
    folder.add({"a/s1/i" + std::to_string(n), "Müller^Jörg", "1.1", "1.1.1", n});
    folder.add({"a/s2/i" + std::to_string(n), "Müller^Jörg", "1.1", "1.1.2", n});
    folder.add({"b/i" + std::to_string(n), "Wang^Xiaodong=王^小东", "1.2", "1.2.1", n});
  }
}

/// Returns the number of listed images by series UID.
std::map<std::string, int> imagesBySeries(const Index& index) {
  std::map<std::string, int> images;
  for (const IndexedStudy& study : studiesIn(index))
    for (const IndexedSeries& series : seriesIn(index, study.id)) images[series.seriesUid] += series.images;
  return images;
}

void touch(const std::string& path, std::int64_t seconds) {
  const timespec times[2] = {{seconds, 0}, {seconds, 0}};
  QCOMPARE(utimensat(AT_FDCWD, path.c_str(), times, 0), 0);
}

}  // namespace

Q_DECLARE_METATYPE(Change)

class TestIndexImport : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void saysWhatInfoSays_data();
  void saysWhatInfoSays();
  void changesAreNoticed_data();
  void changesAreNoticed();
  void nothingChangedReadsNothing();
  void movedFilesKeepTheirStudy_data();
  void movedFilesKeepTheirStudy();
  void absentFolderIsOffline();
  void sameUidOtherBytesIsKept();
  void patientsOfOneUidStayApart();
  void whatIsNoFolderIsRefused_data();
  void whatIsNoFolderIsRefused();
  void linksAreFollowedOnce();
  void namesThatAreNoText();
  void cancelledAndResumed();
};

void TestIndexImport::saysWhatInfoSays_data() {
  QTest::addColumn<QString>("name");
  for (const char* name : {"ct-chest-lidc0314-138", "dicom-2d", "dicom-geometry", "dicom-pydicom", "pet-ct",
                           "mr-head-siemens-gap-175", "nifti-meta", "nrrd-format-tests"})
    QTest::newRow(name) << QString::fromLatin1(name);
}

// Volumes, images, warnings and files of every series are the same, whatever batches it was read in.
void TestIndexImport::saysWhatInfoSays() {
  QFETCH(QString, name);
  const std::string path = dataPath(name.toStdString());
  NEED_DATA(dataPath());
  const IndexFolder folder;
  Index index = folder.open();
  const Result<ImportReport> report = index.import({path});
  QVERIFY2(report.ok(), report.ok() ? "" : report.message().c_str());
  const Result<Study> study = openStudy(fs::canonical(path).string());
  QVERIFY(study.ok());
  std::set<std::string> refused, others;  // includes pictures left out of series
  for (const Refused& file : study->refused) refused.insert(file.path);
  for (const Other& file : study->other) others.insert(file.path);
  for (const Series& volume : study->volumes)
    for (const Unread& file : volume.unread)
      if (!others.contains(file.path)) refused.insert(file.path);
  QCOMPARE(report->refused.size(), refused.size());
  QCOMPARE(report->files, report->added + report->notImages + int(refused.size()));
  std::set<std::string> volumes, frames, warnings, indexed, indexedVolumes, told;
  for (const Series& volume : study->volumes) {
    volumes.insert(volume.seriesUid);
    for (const std::string& file : volume.files) frames.insert(file);
    for (const Warning& warning : volume.warnings) warnings.insert(warning.sentence);
  }
  for (const Image& image : study->images) frames.insert(image.path);
  for (const DerivedObject& object : study->derived) frames.insert(object.path);
  for (const IndexedStudy& s : studiesIn(index))
    for (const IndexedSeries& series : seriesIn(index, s.id)) {
      if (series.isVolume) indexedVolumes.insert(series.seriesUid);
      QVERIFY(!series.offline);
      told.insert(series.warnings.begin(), series.warnings.end());
      for (const std::string& file : filesIn(index, s.id, series.id)) indexed.insert(file);
    }
  QCOMPARE(indexedVolumes, volumes);
  for (const std::string& file : frames) QVERIFY2(indexed.contains(file), file.c_str());
  for (const std::string& warning : warnings) QVERIFY2(told.contains(warning), warning.c_str());
}

void TestIndexImport::changesAreNoticed_data() {
  QTest::addColumn<Change>("change");
  QTest::addColumn<QList<int>>("counts");  // new, changed, unchanged, gone
  QTest::addColumn<QList<int>>("images");  // number in series 1.1.1, 1.1.2, 1.2.1
  const auto row = [](const char* name, Change change, QList<int> counts, QList<int> images) {
    QTest::newRow(name) << change << counts << images;
  };
  row("nothing", [](const IndexFolder&) {}, {0, 0, 12, 0}, {4, 4, 4});
  row("a file more",
      [](const IndexFolder& f) {
        f.add({"b/i4", "Wang^Xiaodong=王^小东", "1.2", "1.2.1", 4});
      },
      {1, 0, 12, 0}, {4, 4, 5});
  row("a file more in another folder",
      [](const IndexFolder& f) {
        f.add({"c/d/i4", "Wang^Xiaodong=王^小东", "1.2", "1.2.1", 4});
      },
      {1, 0, 12, 0}, {4, 4, 5});
  row("a file of another series in its place",
      [](const IndexFolder& f) {
        f.add({"a/s1/i3", "Müller^Jörg", "1.1", "1.1.2", 9});
      },
      {0, 1, 11, 0}, {3, 5, 4});
  row("other bytes, same size and time",
      [](const IndexFolder& f) {
        struct stat before {};
        QCOMPARE(stat(f.data("a/s1/i3").c_str(), &before), 0);
        f.add({"a/s1/i3", "Müller^Jörg", "1.1", "1.1.2", 9});
        const timespec times[2] = {before.st_atim, before.st_mtim};
        QCOMPARE(utimensat(AT_FDCWD, f.data("a/s1/i3").c_str(), times, 0), 0);
        QCOMPARE(fs::file_size(f.data("a/s1/i3")), std::uintmax_t(before.st_size));
      },
      {0, 1, 11, 0}, {3, 5, 4});
  row("only its time", [](const IndexFolder& f) { touch(f.data("b/i0"), 1000); }, {0, 1, 11, 0}, {4, 4, 4});
  row("a file renamed", [](const IndexFolder& f) { fs::rename(f.data("b/i0"), f.data("b/z0")); },
      {0, 0, 12, 0}, {4, 4, 4});
  row("a folder moved", [](const IndexFolder& f) { fs::rename(f.data("a/s1"), f.data("moved")); },
      {0, 0, 12, 0}, {4, 4, 4});
  row("a file copied", [](const IndexFolder& f) { fs::copy_file(f.data("b/i0"), f.data("b/z0")); },
      {1, 0, 12, 0}, {4, 4, 5});
  row("a file deleted", [](const IndexFolder& f) { fs::remove(f.data("b/i0")); }, {0, 0, 11, 1}, {4, 4, 3});
  row("all files of a series deleted",
      [](const IndexFolder& f) {
        for (int n = 0; n < 4; ++n) fs::remove(f.data("a/s2/i" + std::to_string(n)));
      },
      {0, 0, 8, 4}, {4, 0, 4});
  row("a file cut off",
      [](const IndexFolder& f) { fs::resize_file(f.data("b/i0"), fs::file_size(f.data("b/i0")) - 9); },
      {0, 0, 11, 0}, {4, 4, 3});
}

void TestIndexImport::changesAreNoticed() {
  QFETCH(Change, change);
  QFETCH(QList<int>, counts);
  QFETCH(QList<int>, images);
  const IndexFolder folder;
  makeStudies(folder);
  QCOMPARE(folder.import().added, 12);
  change(folder);
  const ImportReport report = folder.import();
  QCOMPARE((QList<int>{report.added, report.changed, report.unchanged, report.gone}), counts);
  const Index index = folder.open();
  std::map<std::string, int> found = imagesBySeries(index);
  QCOMPARE((QList<int>{found["1.1.1"], found["1.1.2"], found["1.2.1"]}), images);
  // A new index of the folder has the same contents.
  Result<Index> another = Index::open(folder.index() + "2");
  QVERIFY(another.ok() && another->import({folder.data()}).ok());
  QCOMPARE(contentsOf(index), contentsOf(*another));
}

void TestIndexImport::nothingChangedReadsNothing() {
  const IndexFolder folder;
  makeStudies(folder);
  folder.import();
  Index index = folder.open();
  bool read = false;
  const auto report = index.import({folder.data()}, [&](const char* what, std::size_t, std::size_t) {
    read |= std::string(what) == "reading headers";
  });
  QCOMPARE(report->unchanged, 12);
  QVERIFY(!read);
}

void TestIndexImport::movedFilesKeepTheirStudy_data() {
  QTest::addColumn<bool>("copied");  // copied as between disks, so that inodes change
  QTest::addColumn<bool>("importedBetween");
  QTest::newRow("renamed") << false << false;
  QTest::newRow("copied and deleted") << true << false;
  QTest::newRow("seen to be gone first") << true << true;
}

void TestIndexImport::movedFilesKeepTheirStudy() {
  QFETCH(bool, copied);
  QFETCH(bool, importedBetween);
  const IndexFolder folder;
  for (int n = 0; n < 4; ++n) folder.add({"a/i" + std::to_string(n), "A", "1.1", "1.1.1", n});
  folder.import();
  Index index = folder.open();
  const IndexedStudy before = studiesIn(index).at(0);
  QVERIFY(index.opened(before.id).ok());
  fs::create_directories(folder.data("elsewhere"));
  if (copied) fs::copy(folder.data("a"), folder.index() + "-kept");
  for (int n = 0; n < 4; ++n) {
    const std::string name = "/i" + std::to_string(n);
    if (copied)
      fs::remove(folder.data("a") + name);
    else
      fs::rename(folder.data("a") + name, folder.data("elsewhere") + name);
  }
  if (importedBetween) {
    folder.import();
    QCOMPARE(studiesIn(index).size(), std::size_t(0));
  }
  if (copied) fs::copy(folder.index() + "-kept", folder.data("elsewhere"));
  folder.import();
  QCOMPARE(studiesIn(index).size(), std::size_t(1));
  const IndexedStudy after = studiesIn(index).at(0);
  QCOMPARE(after.id, before.id);
  QVERIFY(!after.openedAt.empty());
  QCOMPARE(after.images, 4);
  for (const std::string& file : filesIn(index, after.id))
    QVERIFY(file.starts_with(folder.data("elsewhere/")));
}

void TestIndexImport::absentFolderIsOffline() {
  const IndexFolder folder;
  makeStudies(folder);
  folder.import();
  fs::rename(folder.data("b"), folder.index() + "-removed");
  const ImportReport report = folder.import();
  QCOMPARE(report.gone, 0);
  const Index index = folder.open();
  QCOMPARE(imagesBySeries(index)["1.2.1"], 4);
  for (const IndexedStudy& study : studiesIn(index)) QCOMPARE(study.offline, study.studyUid == "1.2");
  fs::rename(folder.index() + "-removed", folder.data("b"));
  QCOMPARE(folder.import().unchanged, 12);
  for (const IndexedStudy& study : studiesIn(index)) QVERIFY(!study.offline);
}

void TestIndexImport::sameUidOtherBytesIsKept() {
  const IndexFolder folder;
  for (int n = 0; n < 3; ++n) folder.add({"a/i" + std::to_string(n), "A", "1.1", "1.1.1", n});
  folder.add({"b/other", "A", "1.1", "1.1.1", 2, "another description"});
  folder.import();
  const Index index = folder.open();
  const std::vector<IndexedSeries> series = seriesIn(index, studiesIn(index).at(0).id);
  QCOMPARE(series.size(), std::size_t(1));
  QCOMPARE(series[0].images, 4);
  const bool told = std::ranges::any_of(series[0].warnings, [](const std::string& w) {
    return w.find("has the SOP Instance UID of") != std::string::npos && w.ends_with("both are kept.");
  });
  QVERIFY(told);
}

void TestIndexImport::patientsOfOneUidStayApart() {
  const IndexFolder folder;
  folder.add({"a/i", "A", "1.1", "1.1.1", 0});
  folder.import();
  folder.add({"b/i", "B", "1.1", "1.1.1", 1});
  folder.import();
  const Index index = folder.open();
  QCOMPARE(studiesIn(index).size(), std::size_t(2));
}

void TestIndexImport::whatIsNoFolderIsRefused_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<QString>("says");
  QTest::newRow("nothing there") << QStringLiteral("/nowhere/at/all")
                                 << QStringLiteral("no such file or folder");
  QTest::newRow("a phantom") << QStringLiteral("phantom:cube") << QStringLiteral("not imported");
  QTest::newRow("a zip archive") << QStringLiteral("zip") << QStringLiteral("unpack it");
}

void TestIndexImport::whatIsNoFolderIsRefused() {
  QFETCH(QString, path);
  QFETCH(QString, says);
  const IndexFolder folder;
  folder.add({"a/i", "A", "1.1", "1.1.1", 0});
  std::string at = path.toStdString();
  if (at == "zip") writeAll(at = folder.data("x.zip"), {'P', 'K', 3, 4, 0, 0, 0, 0});
  Index index = folder.open();
  const auto report = index.import({folder.data("a"), at});
  QVERIFY(!report.ok());
  QVERIFY2(report.message().find(says.toStdString()) != std::string::npos, report.message().c_str());
  QCOMPARE(studiesIn(index).size(), std::size_t(0));
}

void TestIndexImport::linksAreFollowedOnce() {
  const IndexFolder folder;
  folder.add({"a/i", "A", "1.1", "1.1.1", 0});
  fs::create_directory_symlink(folder.data("a"), folder.data("a/loop"));
  fs::create_directory_symlink(folder.data("a"), folder.index() + "-link");
  QCOMPARE(folder.import().added, 1);
  Index index = folder.open();
  const auto again = index.import({folder.index() + "-link"});
  QCOMPARE(again->unchanged, 1);
  QCOMPARE(again->added, 0);
  QCOMPARE(studiesIn(index).at(0).images, 1);
}

void TestIndexImport::namesThatAreNoText() {
  const IndexFolder folder;
  folder.add({"a/i", "A", "1.1", "1.1.1", 0});
  const std::string odd = folder.data("a/\xff\xfe%_'\"\n");
  fs::rename(folder.data("a/i"), odd);
  QCOMPARE(folder.import().added, 1);
  QCOMPARE(folder.import().unchanged, 1);
  const Index index = folder.open();
  QCOMPARE(filesIn(index, studiesIn(index).at(0).id).at(0), odd);
  QVERIFY(openFiles(filesIn(index, studiesIn(index).at(0).id))->volumes.size() == 1);
  fs::remove(odd);  // QTemporaryDir cannot remove it
}

// Stops at every progress report in turn. Each import resumes where the last one ended.
void TestIndexImport::cancelledAndResumed() {
  const IndexFolder folder;
  for (int n = 0; n < 700; ++n)
    folder.add({"f" + std::to_string(n / 100) + "/i" + std::to_string(n), "A", "1.1",
                "1.1." + std::to_string(n % 3), n});
  Result<Index> undisturbed = Index::open(folder.index() + "2");
  QVERIFY(undisturbed->import({folder.data()}).ok());
  Index index = folder.open();
  int added = 0, imports = 0;
  for (int stopAt = 2;; stopAt += 3, ++imports) {
    const CancelToken cancel;
    int reports = 0;
    const auto report = index.import(
        {folder.data()},
        [&](const char*, std::size_t, std::size_t) {
          if (++reports == stopAt) cancel.cancel();
        },
        cancel);
    QVERIFY(report.ok());
    added += report->added;
    if (!report->cancelled) break;
  }
  QVERIFY(imports > 1);
  QCOMPARE(added, 700);
  QCOMPARE(contentsOf(index), contentsOf(*undisturbed));
}

VOLUMEN_TEST(TestIndexImport);
#include "tst_index_import.moc"
