// Guards design.md 8: a session finds its series wherever their files lie, in an archive or spread over
// folders.
#include <archive.h>
#include <archive_entry.h>

#include <QDirIterator>

#include "io/export/dicom_series.h"
#include "io/open.h"
#include "io/zip_archive.h"
#include "tests/fixtures/program.h"
#include "tests/ui/session_folder.h"
#include "tests/unit/suite.h"
#include "ui/controller/open_session.h"
#include "viewer/phantoms/phantoms.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

/// Writes a series of 16 slices, i0 ... in `folder`.
bool writeSlices(const QString& folder, const char* phantom = "cube:16") {
  const Result<VolumePtr> volume = makePhantom(phantom);
  DicomSeriesTags tags;
  tags.patientName = "Doe";
  return volume && QDir().mkpath(QFileInfo(folder).path()) &&
         writeDicomSeries(**volume, tags, folder.toStdString());
}

QStringList filesBelow(const QString& folder) {
  QStringList files;
  for (QDirIterator it(folder, QDir::Files, QDirIterator::Subdirectories); it.hasNext();) files << it.next();
  files.sort();
  return files;
}

bool zip(const QString& folder, const QString& file) {
  archive* a = archive_write_new();
  archive_write_set_format_zip(a);
  bool written = archive_write_open_filename(a, file.toUtf8().constData()) == ARCHIVE_OK;
  for (const QString& path : filesBelow(folder)) {
    const QByteArray bytes = contentsOf(path);
    archive_entry* entry = archive_entry_new();
    archive_entry_set_pathname(entry, path.mid(folder.size() + 1).toUtf8().constData());
    archive_entry_set_filetype(entry, AE_IFREG);
    archive_entry_set_perm(entry, 0644);
    archive_entry_set_size(entry, bytes.size());
    written = written && archive_write_header(a, entry) == ARCHIVE_OK &&
              archive_write_data(a, bytes.constData(), std::size_t(bytes.size())) == bytes.size();
    archive_entry_free(entry);
  }
  return archive_write_free(a) == ARCHIVE_OK && written;
}

/// Returns a workspace that shows the first series of these files.
Workspace showing(const QStringList& files) {
  std::vector<std::string> paths;
  for (const QString& file : files) paths.push_back(file.toStdString());
  const Result<Study> study = openFiles(paths);
  return study && !study->volumes.empty() ? withSeries({}, sceneViewId, study->volumes[0], {}) : Workspace{};
}

}  // namespace

class TestSessionsFound : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void inAnArchive();
  void inAnArchiveThatWasMoved();
  void overSeveralFolders();
  void overFoldersOfAnArchive();
};

void TestSessionsFound::inAnArchive() {
  const SessionFolder folder;
  QVERIFY(writeSlices(folder.at("study/ct")));
  QVERIFY(zip(folder.at("study"), folder.at("study.zip")));
  QVERIFY(QDir(folder.at("study")).removeRecursively());
  Journey w({folder.at("study.zip")});
  QVERIFY(w.settle());
  const Workspace saved = w.window.session().workspace();
  QVERIFY(folder.save(w));
  const QByteArray text = contentsOf(folder.at("s.volumen"));
  QVERIFY2(text.contains(folder.at("study.zip/ct").toUtf8()), text);
  QVERIFY2(!text.contains("archives"), "no path that goes with the program");
  w.window.session().show(nullptr);
  QVERIFY(folder.open(w));
  QVERIFY(w.window.session().workspace() == saved);
  // Another program unpacks the archive itself.
  const Outcome drawn = runProgram(
      QStringLiteral("render %1 --size 16x16 -o %2").arg(folder.at("s.volumen"), folder.at("a.png")));
  QVERIFY2(drawn.status == 0, drawn.err);
}

void TestSessionsFound::inAnArchiveThatWasMoved() {
  const SessionFolder folder;
  QVERIFY(writeSlices(folder.at("study/ct")));
  QVERIFY(QDir().mkpath(folder.at("here")) && QDir().mkpath(folder.at("there")));
  QVERIFY(zip(folder.at("study"), folder.at("here/study.zip")));
  const Result<Study> study = openStudy(folder.at("here/study.zip").toStdString());
  QVERIFY(study && !study->volumes.empty());
  QVERIFY(saveSession(folder.at("here/s.volumen").toStdString(),
                      withSeries({}, sceneViewId, study->volumes[0], {})));
  for (const char* name : {"study.zip", "s.volumen"})
    QVERIFY(
        QFile::rename(folder.at("here/") + QLatin1String(name), folder.at("there/") + QLatin1String(name)));
  const Outcome drawn = runProgram(
      QStringLiteral("render %1 --size 16x16 -o %2").arg(folder.at("there/s.volumen"), folder.at("a.png")));
  QVERIFY2(drawn.status == 0, drawn.err);
}

// Files beside these folders are not read and do not change their contents.
void TestSessionsFound::overSeveralFolders() {
  const SessionFolder folder;
  QVERIFY(writeSlices(folder.at("data/a")) && QDir().mkpath(folder.at("data/b/deep")));
  const QStringList files = filesBelow(folder.at("data/a"));
  for (int n = 8; n < files.size(); ++n)
    QVERIFY(QFile::rename(files[n], folder.at("data/b/deep/") + QFileInfo(files[n]).fileName()));
  const Workspace saved = showing(filesBelow(folder.at("data")));
  QCOMPARE(saved.series.size(), std::size_t(1));
  QVERIFY(saveSession(folder.at("s.volumen").toStdString(), saved));
  QVERIFY(writeSlices(folder.at("data/other"), "cube:20"));
  QVERIFY(QFile::copy(filesBelow(folder.at("data/a"))[3], folder.at("data/b/a copy")));
  const Result<OpenedSession> opened = openSession(folder.at("s.volumen").toStdString());
  QVERIFY(opened.ok());
  QVERIFY2(opened->problems.isEmpty(), qPrintable(opened->problems.join(QLatin1Char(' '))));
  QVERIFY(opened->workspace == saved);
  QCOMPARE(opened->studies.size(), std::size_t(1));
  QCOMPARE(opened->studies[0].second->volumes.size(), std::size_t(1));
  // Missing data are saved and found again, because the session still lists the folders.
  QVERIFY(QDir().rename(folder.at("data"), folder.at("away")));
  const Result<OpenedSession> missing = openSession(folder.at("s.volumen").toStdString());
  QVERIFY(missing.ok());
  QCOMPARE(missing->problems.size(), 1);
  QVERIFY(saveSession(folder.at("s.volumen").toStdString(), missing->workspace));
  QVERIFY(QDir().rename(folder.at("away"), folder.at("data")));
  QVERIFY(openSession(folder.at("s.volumen").toStdString())->workspace == saved);
}

void TestSessionsFound::overFoldersOfAnArchive() {
  const SessionFolder folder;
  QVERIFY(writeSlices(folder.at("study/a")) && QDir().mkpath(folder.at("study/b")));
  const QStringList files = filesBelow(folder.at("study/a"));
  for (int n = 8; n < files.size(); ++n)
    QVERIFY(QFile::rename(files[n], folder.at("study/b/") + QFileInfo(files[n]).fileName()));
  QVERIFY(writeSlices(folder.at("study/c"), "cube:20"));
  QVERIFY(zip(folder.at("study"), folder.at("study.zip")));
  const Result<Study> study = openStudy(folder.at("study.zip").toStdString());
  QVERIFY(study.ok());
  const auto spread =
      std::ranges::find_if(study->volumes, [](const Series& series) { return series.acquired.size.z == 16; });
  QVERIFY(spread != study->volumes.end());
  const Workspace saved = withSeries({}, sceneViewId, *spread, {});
  QVERIFY(saveSession(folder.at("s.volumen").toStdString(), saved));
  const Result<OpenedSession> opened = openSession(folder.at("s.volumen").toStdString());
  QVERIFY(opened.ok());
  QVERIFY2(opened->problems.isEmpty(), qPrintable(opened->problems.join(QLatin1Char(' '))));
  QVERIFY(opened->workspace == saved);
}

VOLUMEN_TEST(TestSessionsFound);
#include "tst_sessions_found.moc"
