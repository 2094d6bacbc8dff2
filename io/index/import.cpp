#include "io/index/import.h"

#include <QDateTime>
#include <algorithm>

namespace volumen {
namespace {

// Number of files that are read before they are written. Whole folders are joined up to `smallBatch`; larger
// ones are split at `largeBatch`.
constexpr std::size_t smallBatch = 512, largeBatch = 4096;

using Batch = std::vector<FileOnDisk>;

std::vector<Batch> batches(const std::vector<FileOnDisk>& files) {
  std::vector<Batch> all;
  for (std::size_t n = 0; n < files.size(); ++n) {
    const bool newFolder = n == 0 || files[n].folder != files[n - 1].folder;
    if (all.empty() || all.back().size() >= largeBatch || (newFolder && all.back().size() >= smallBatch))
      all.emplace_back();
    all.back().push_back(files[n]);
  }
  return all;
}

std::vector<std::string> pathsOf(const Batch& batch) {
  std::vector<std::string> paths;
  for (const FileOnDisk& file : batch) paths.push_back(file.path());
  return paths;
}

}  // namespace

Result<ImportReport> Import::run(const std::vector<ImportRoot>& roots) {
  if (Status done = purge(); !done) return done.error();
  for (const ImportRoot& root : roots)
    if (Status done = importBelow(root); !done) return done.error();
  if (Status done = readStale(); !done) return done.error();
  report_.cancelled = cancel_.cancelled();
  if (Status done = readInstitutions(); !done) return done.error();
  return std::move(report_);
}

Status Import::importBelow(const ImportRoot& root) {
  if (cancel_.cancelled()) return {};
  if (progress_) progress_("looking for files", 0, 0);
  // Known files come first: files that another program adds meanwhile are then not taken for deleted.
  learn(root.path);
  Result<FilesBelow> below = filesBelow(root, indexFolder_, cancel_);
  if (!below) return below.error();
  if (cancel_.cancelled()) return db_.takeStatus();
  report_.files += int(below->files.size() + below->unreadable.size());
  if (below->files.empty() && below->unreadable.empty()) report_.empty.push_back(root.path);
  for (const UnreadableOnDisk& file : below->unreadable)
    report_.refused.push_back({file.entry.path(), file.reason});
  const Compared compared = compare(below->files);
  if (Status written = writeCompared(compared); !written) return written;
  if (Status read = readNew(compared.toRead); !read) return read;
  if (cancel_.cancelled()) return {};
  if (Status written = writeUnreadable(*below); !written) return written;
  return writeGone();
}

void Import::learn(const std::string& root) {
  known_.clear();
  const std::size_t slash = root.find_last_of('/');
  const std::string folder = slash == 0 ? "/" : root.substr(0, slash), name = root.substr(slash + 1);
  // Paths below a folder begin with it and "/"; "0" is the next character after "/".
  const std::string below = root == "/" ? root : root + "/", behind = root == "/" ? "0" : root + "0";
  for (Rows rows = db_.run(
           "SELECT d.path, f.name, f.id, f.series_id, s.study_id, d.device, f.size, f.mtime_ns, f.ctime_ns,"
           " f.inode, f.device, f.reason, f.program, t.forgotten_at <> '', f.no_image FROM folder d JOIN "
           "file f ON"
           " f.folder_id = d.id LEFT JOIN series s ON s.id = f.series_id LEFT JOIN study t ON t.id ="
           " s.study_id WHERE d.path = ? OR (d.path >= ? AND d.path < ?) OR (d.path = ? AND f.name = ?)",
           Blob{root}, Blob{below}, Blob{behind}, Blob{folder}, Blob{name});
       rows.next();) {
    Known known{rows.number(2),
                rows.number(3),
                rows.number(4),
                rows.number(5),
                {rows.number(6), rows.number(7), rows.number(8), rows.number(9), rows.number(10)},
                rows.text(11),
                rows.text(12),
                rows.number(14) != 0,
                rows.number(13) != 0,
                false,
                rows.bytes(0)};
    const FileOnDisk file{known.folder, rows.bytes(1), {}};
    known_.emplace(file.path(), std::move(known));
  }
}

// Sorts files by their records in the index: new and changed ones are read, moved ones only recorded.
Import::Compared Import::compare(const std::vector<FileOnDisk>& files) {
  Compared compared;
  for (const FileOnDisk& file : files) {
    const auto known = known_.find(file.path());
    if (known == known_.end()) {
      if (const std::int64_t moved = movedFrom(file))
        compared.moved.emplace_back(moved, file);
      else
        compared.toRead.push_back(file);
      continue;
    }
    known->second.seen = true;
    const Known& was = known->second;
    if (was.state != file.state || (!was.reason.empty() && (again_ || was.program != VOLUMEN_VERSION))) {
      compared.toRead.push_back(file);
      continue;
    }
    if (was.forgotten) compared.comeBack.insert(was.study);
    if (was.series)
      ++(was.forgotten ? report_.added : report_.unchanged);
    else if (was.reason.empty() || was.noImage)
      ++report_.notImages;
    if (!was.reason.empty())
      (was.noImage ? report_.lacking : report_.refused).push_back({file.path(), was.reason});
  }
  return compared;
}

// Returns the indexed file that moved here: its old path no longer exists. 0: none.
std::int64_t Import::movedFrom(const FileOnDisk& file) {
  for (Rows rows = db_.run("SELECT f.id, d.path, f.name FROM file f JOIN folder d ON d.id = f.folder_id JOIN "
                           "series s ON s.id ="
                           " f.series_id JOIN study t ON t.id = s.study_id WHERE f.inode = ? AND f.device = "
                           "? AND f.size = ? AND"
                           " f.mtime_ns = ? AND t.forgotten_at = ''",
                           file.state.inode, file.state.device, file.state.size, file.state.modifiedNs);
       rows.next();) {
    const std::string before = FileOnDisk{rows.bytes(1), rows.bytes(2), {}}.path();
    if (exists(before)) continue;  // another hard link
    if (const auto known = known_.find(before); known != known_.end()) known->second.seen = true;
    return rows.number(0);
  }
  return 0;
}

Status Import::writeCompared(const Compared& compared) {
  if (compared.moved.empty() && compared.comeBack.empty()) return db_.takeStatus();
  db_.begin();
  for (const std::int64_t study : compared.comeBack)
    db_.run("UPDATE study SET forgotten_at = '', imported_at = ? WHERE id = ?", timeNow(), study);
  for (const auto& [id, file] : compared.moved) writer_.move(id, file);
  writer_.finish();
  report_.unchanged += int(compared.moved.size());
  return db_.commit();
}

Status Import::readNew(const std::vector<FileOnDisk>& files) {
  std::size_t done = 0;
  for (const Batch& batch : batches(files)) {
    if (cancel_.cancelled()) return {};
    if (Status read = readBatch(batch, done, files.size()); !read) return read;
    done += batch.size();
  }
  return {};
}

Status Import::readBatch(const Batch& batch, std::size_t done, std::size_t total) {
  const Progress progress = [&](const char* what, std::size_t n, std::size_t) {
    if (progress_) progress_(what, done + n, total);
  };
  const Result<ReadFiles> read = readFiles(pathsOf(batch), progress, cancel_);
  if (!read) return {};  // cancelled: nothing of the batch is written
  db_.begin();
  writer_.write(batch, *read);
  writer_.finish();
  if (Status written = db_.commit(); !written) return written;
  count(batch, *read);
  return {};
}

void Import::count(const Batch& batch, const ReadFiles& read) {
  std::size_t images = 0;
  for (const ReadSeries& series : read.series) {
    images += series.files.size();
    for (const FoundFile& file : series.files) {
      const auto known = known_.find(file.path);
      const bool isNew = known == known_.end() || known->second.series == 0;
      ++(isNew ? report_.added : report_.changed);
    }
  }
  report_.refused.insert(report_.refused.end(), read.refused.begin(), read.refused.end());
  report_.lacking.insert(report_.lacking.end(), read.lacking.begin(), read.lacking.end());
  report_.notImages += std::max(0, int(batch.size()) - int(images + read.refused.size()));
}

// Records existing entries that could not be read.
Status Import::writeUnreadable(const FilesBelow& below) {
  db_.begin();
  for (const auto& [entry, reason, elsewhere] : below.unreadable) {
    if (elsewhere) continue;
    const auto known = known_.find(entry.path());
    if (known == known_.end() || known->second.reason.empty()) writer_.writeOther(entry, reason, true);
    if (known != known_.end()) known->second.seen = true;
  }
  writer_.finish();
  return db_.commit();
}

// Removes files that are no longer in their folder. If the folder is missing, a disk may have been removed:
// its files stay, offline.
Status Import::writeGone() {
  db_.begin();
  for (const auto& [path, known] : known_) {
    const bool stays = known.reason.empty() && exists(path);  // a refused entry may be a folder by now
    if (known.seen || stays || !isOnline(known.folder, known.folderDevice)) continue;
    writer_.remove(known.id);
    if (known.series && !known.forgotten) ++report_.gone;
  }
  writer_.finish();
  return db_.commit();
}

// Returns the files of a series and those refused beside them, which its warnings may name.
std::vector<FileOnDisk> Import::filesOf(std::int64_t series) {
  std::vector<FileOnDisk> files;
  for (Rows rows =
           db_.run("SELECT d.path, f.name, f.size, f.mtime_ns, f.ctime_ns, f.inode, f.device FROM "
                   "file f JOIN folder d ON"
                   " d.id = f.folder_id WHERE f.series_id = ? OR (f.reason <> '' AND f.folder_id IN"
                   " (SELECT folder_id FROM series_folder WHERE series_id = ?)) ORDER BY d.path, f.name",
                   series, series);
       rows.next();) {
    FileOnDisk file{rows.bytes(0),
                    rows.bytes(1),
                    {rows.number(2), rows.number(3), rows.number(4), rows.number(5), rows.number(6)}};
    if (exists(file.path())) files.push_back(std::move(file));
  }
  return files;
}

// Reads again, as a whole, series that were written in parts, now or by an import that was stopped.
Status Import::readStale() {
  std::vector<std::int64_t> stale;
  for (Rows rows = db_.run("SELECT s.id FROM series s JOIN study t ON t.id = s.study_id WHERE s.stale = 1 AND"
                           " t.forgotten_at = ''");
       rows.next();)
    stale.push_back(rows.number(0));
  Batch batch;
  std::set<std::string> taken;
  for (std::size_t n = 0; n < stale.size() && !cancel_.cancelled(); ++n) {
    for (const FileOnDisk& file : filesOf(stale[n]))
      if (taken.insert(file.path()).second) batch.push_back(file);
    if (batch.empty() || (batch.size() < smallBatch && n + 1 < stale.size())) continue;
    const Result<ReadFiles> read = readFiles(pathsOf(batch), progress_, cancel_);
    if (!read) return db_.takeStatus();
    db_.begin();
    writer_.write(batch, *read);
    writer_.finish();
    if (Status written = db_.commit(); !written) return written;
    batch.clear();
    taken.clear();
  }
  return db_.takeStatus();
}

// Reads the institutions of studies that were imported without one. A stopped run continues with the next
// import.
Status Import::readInstitutions() {
  std::vector<std::int64_t> studies;
  for (Rows rows =
           db_.run("SELECT id FROM study WHERE institution IS NULL AND forgotten_at = '' AND empty_at = ''");
       rows.next();)
    studies.push_back(rows.number(0));
  std::vector<std::pair<std::int64_t, std::string>> known;  // study and institution
  for (std::size_t n = 0; n < studies.size() && !cancel_.cancelled(); ++n) {
    if (progress_) progress_(readingInstitutions, n, studies.size());
    if (std::optional<std::string> institution = institutionOf(studies[n]))
      known.emplace_back(studies[n], std::move(*institution));
    if (known.size() < smallBatch) continue;
    if (Status written = writeInstitutions(known); !written) return written;
    known.clear();
  }
  return writeInstitutions(known);
}

// Returns the institution from one file of each series; empty if no file names it, nothing if some cannot be
// read now.
std::optional<std::string> Import::institutionOf(std::int64_t study) {
  std::vector<std::int64_t> series;  // DICOM only; others have no institution
  for (Rows rows = db_.run("SELECT id FROM series WHERE study_id = ? AND uid <> ''", study); rows.next();)
    series.push_back(rows.number(0));
  bool areAllRead = true;
  for (const std::int64_t each : series) {
    const std::optional<FileOnDisk> file = oneFileOf(each);
    const Result<FurtherIdentity> further =
        file ? furtherIdentity(file->path()) : Result<FurtherIdentity>(Error{"It is not there."});
    if (further && !further->institution.empty()) return further->institution;
    areAllRead = areAllRead && further.ok();
  }
  return areAllRead ? std::optional<std::string>("") : std::nullopt;
}

// Returns nothing if the file is missing or has changed.
std::optional<FileOnDisk> Import::oneFileOf(std::int64_t series) {
  Rows rows = db_.run(
      "SELECT d.path, f.name, d.device, f.size, f.mtime_ns, f.inode, f.device FROM file f JOIN folder d ON"
      " d.id = f.folder_id WHERE f.series_id = ? LIMIT 1",
      series);
  if (!rows.next() || !isOnline(rows.bytes(0), rows.number(2))) return {};
  FileOnDisk file{rows.bytes(0), rows.bytes(1), {}};
  const std::optional<FileState> now = fileState(file.path());
  const bool isSame = now && now->size == rows.number(3) && now->modifiedNs == rows.number(4) &&
                      now->inode == rows.number(5) && now->device == rows.number(6);
  return isSame ? std::optional(std::move(file)) : std::nullopt;
}

Status Import::writeInstitutions(const std::vector<std::pair<std::int64_t, std::string>>& ofStudies) {
  if (ofStudies.empty()) return db_.takeStatus();
  db_.begin();
  for (const auto& [study, institution] : ofStudies) writer_.setInstitution(study, institution);
  writer_.finish();
  return db_.commit();
}

// Deletes studies that were forgotten, or have had no files, for more than a day.
Status Import::purge() {
  const std::string yesterday =
      QDateTime::currentDateTimeUtc().addDays(-1).toString(Qt::ISODateWithMs).toStdString();
  db_.begin();
  db_.run(
      "DELETE FROM study WHERE (forgotten_at <> '' AND forgotten_at < ?) OR (empty_at <> '' AND empty_at < "
      "?)",
      yesterday, yesterday);
  db_.run("DELETE FROM folder WHERE NOT EXISTS (SELECT * FROM file WHERE file.folder_id = folder.id)");
  return db_.commit();
}

}  // namespace volumen
