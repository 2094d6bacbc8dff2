#include "io/index/index.h"

#include <sys/stat.h>

#include <QBuffer>
#include <QByteArray>
#include <QCryptographicHash>
#include <QFile>
#include <QStandardPaths>
#include <filesystem>
#include <set>

#include "io/files/private_folder.h"
#include "io/index/copies.h"
#include "io/index/import.h"
#include "io/index/query.h"
#include "io/index/schema.h"
#include "io/open.h"
#include "io/qt_application.h"
#include "io/thumbnail.h"

namespace volumen {

struct Index::Private {
  std::string folder, notice;
  std::unique_ptr<Database> db, thumbnails;  // thumbnails: opened on first use
};

namespace {

constexpr int thumbnailEdge = 128;  // pixels of the longer side

Result<std::vector<ImportRoot>> rootsOf(const std::vector<std::string>& paths) {
  std::vector<ImportRoot> roots;
  for (const std::string& path : paths) {
    Result<ImportRoot> root = importRoot(path);
    if (!root) return root.error();
    roots.push_back(std::move(*root));
  }
  return roots;
}

// Returns a hash of a series' files: other files need another thumbnail.
std::string fingerprint(Database& db, std::int64_t series) {
  QCryptographicHash hash(QCryptographicHash::Sha1);
  hash.addData(QByteArray(VOLUMEN_VERSION));
  for (Rows rows = db.run(
           "SELECT size, mtime_ns FROM file WHERE series_id = ? ORDER BY position, size, mtime_ns", series);
       rows.next();)
    hash.addData(QByteArray::number(qlonglong(rows.number(0))) + ' ' +
                 QByteArray::number(qlonglong(rows.number(1))));
  return hash.result().toStdString();
}

// Returns a key of a series that stays the same in a rebuilt index.
std::string lastingKey(Database& db, std::int64_t series) {
  Rows rows =
      db.run("SELECT t.key, s.key FROM series s JOIN study t ON t.id = s.study_id WHERE s.id = ?", series);
  return rows.next() ? rows.bytes(0) + rows.bytes(1) : std::string();
}

// Finds copies that moved together with their index: folders below its "studies" with old paths.
Status findMovedCopies(Database& db, const std::string& folder) {
  const std::string below = "/studies/";
  std::error_code ignored;
  const std::string here = std::filesystem::canonical(folder, ignored).string();
  std::vector<std::pair<std::int64_t, std::string>> moved;
  for (Rows rows = db.run("SELECT id, path FROM folder"); rows.next();) {
    const std::string path = rows.bytes(1);
    const std::size_t at = path.rfind(below);
    if (at == std::string::npos || path.starts_with(here + below) || exists(path)) continue;
    const std::string now = here + path.substr(at);
    if (exists(now)) moved.emplace_back(rows.number(0), now);
  }
  if (moved.empty()) return {};
  db.begin();
  for (const auto& [id, path] : moved) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) continue;
    db.run("UPDATE OR IGNORE folder SET path = ?, device = ? WHERE id = ?", Blob{path},
           std::int64_t(status.st_dev), id);
  }
  return db.commit();
}

// Makes a thumbnail of a file's contents. The Error: they are not an image, or cannot be read.
Result<Thumbnail> makeThumbnail(const std::string& file) {
  const Result<Study> study = openFiles({file});
  if (!study) return study.error();
  if (study->volumes.empty() && study->images.empty()) return Error{file + ": it holds no picture."};
  const Result<QImage> image = study->volumes.empty() ? thumbnailOf(study->images[0], thumbnailEdge)
                                                      : thumbnailOf(study->volumes[0], thumbnailEdge);
  if (!image) return image.error();
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  if (!image->save(&buffer, "PNG")) return Error{"The thumbnail cannot be written as PNG."};
  return Thumbnail(bytes.begin(), bytes.end());
}

}  // namespace

Index::Index(std::unique_ptr<Private> p) : p_(std::move(p)) {}
Index::Index(Index&&) noexcept = default;
Index::~Index() = default;

Result<Index> Index::open(const std::string& folder) {
  return made(folder, [](const std::string& at) { return openIndexDatabase(at); });
}

Result<Index> Index::openAsItIs(const std::string& folder) { return made(folder, openIndexAsItIs); }

Result<Index> Index::made(const std::string& folder,
                          Result<OpenedDatabase> (*openDatabase)(const std::string& folder)) {
  if (folder.empty())
    return Error{"There is no home folder to keep the index in: set HOME or XDG_DATA_HOME."};
  needQtApplication();
  Result<OpenedDatabase> opened = openDatabase(folder);
  if (!opened) return opened.error();
  auto p = std::make_unique<Private>();
  p->folder = folder;
  p->notice = std::move(opened->notice);
  p->db = std::move(opened->database);
  if (p->db->canWrite())
    if (Status found = findMovedCopies(*p->db, folder); !found) return found.error();
  return Index(std::move(p));
}

const std::string& Index::notice() const { return p_->notice; }

Result<ImportReport> Index::import(const std::vector<std::string>& paths, const Progress& progress,
                                   const CancelToken& cancel, bool again) {
  const Result<std::vector<ImportRoot>> roots = rootsOf(paths);
  if (!roots) return roots.error();
  return importBelow(*roots, progress, cancel, again);
}

Result<ImportReport> importIntoIndex(const std::string& indexFolder, const std::vector<std::string>& paths,
                                     const Progress& progress, const CancelToken& cancel) {
  Result<Index> index = Index::open(indexFolder);
  if (!index) return index.error();
  return index->import(paths, progress, cancel);
}

Result<ImportReport> Index::importBelow(const std::vector<ImportRoot>& roots, const Progress& progress,
                                        const CancelToken& cancel, bool again) {
  const auto import = [&] { return Import(*p_->db, p_->folder, progress, cancel, again).run(roots); };
  Result<ImportReport> report = import();
  if (report || !p_->db->wasDamaged()) return report;
  // The quick check did not find this damage.
  p_->db.reset();
  Result<OpenedDatabase> mended = openIndexDatabase(p_->folder, Check::full);
  if (!mended) return mended.error();
  p_->notice = std::move(mended->notice);
  p_->db = std::move(mended->database);
  return import();
}

Result<ImportReport> Index::importCopies(const std::vector<std::string>& paths,
                                         const std::string& managedFolder, const Progress& progress,
                                         const CancelToken& cancel) {
  const Result<std::vector<ImportRoot>> roots = rootsOf(paths);
  if (!roots) return roots.error();
  if (Status made = makePrivateFolder(managedFolder); !made) return made.error();
  const Copies copies = copyStudies(*roots, p_->folder, managedFolder, progress, cancel);
  // Copied files are indexed even if copying ended early.
  std::set<std::string> folders;
  for (const std::string& file : copies.files) folders.insert(file.substr(0, file.find_last_of('/')));
  const Result<std::vector<ImportRoot>> copied = rootsOf({folders.begin(), folders.end()});
  if (!copied) return copied.error();
  Result<ImportReport> report = importBelow(*copied, progress, cancel, false);
  if (!copies.status) return copies.status.error();
  if (!report) return report;
  report->files += int(copies.refused.size()) + copies.notImages;
  report->notImages += copies.notImages;
  report->refused.insert(report->refused.end(), copies.refused.begin(), copies.refused.end());
  report->lacking.insert(report->lacking.end(), copies.lacking.begin(), copies.lacking.end());
  report->empty = copies.empty;
  return report;
}

Result<std::vector<IndexedStudy>> Index::studies(const StudyQuery& query) const {
  std::vector<IndexedStudy> found = findStudies(*p_->db, query);
  if (Status read = p_->db->takeStatus(); !read) return read.error();
  return found;
}

Result<std::vector<IndexedSeries>> Index::series(std::int64_t study) const {
  std::vector<IndexedSeries> found = findSeriesOf(*p_->db, study);
  if (Status read = p_->db->takeStatus(); !read) return read.error();
  return found;
}

Result<std::vector<std::string>> Index::files(std::int64_t study, std::int64_t series) const {
  std::vector<std::string> found = findFilesOf(*p_->db, study, series);
  if (Status read = p_->db->takeStatus(); !read) return read.error();
  return found;
}

Result<std::vector<std::string>> Index::refusedBeside(std::int64_t study, std::int64_t series) const {
  std::vector<std::string> found = findRefusedBeside(*p_->db, study, series);
  if (Status read = p_->db->takeStatus(); !read) return read.error();
  return found;
}

Result<Thumbnail> Index::thumbnail(std::int64_t series) {
  if (!p_->thumbnails) {
    Result<OpenedDatabase> opened = openThumbnailDatabase(p_->folder);
    if (!opened) return opened.error();
    p_->thumbnails = std::move(opened->database);
  }
  const std::string key = lastingKey(*p_->db, series), madeOf = fingerprint(*p_->db, series);
  const std::string file = middleFile(*p_->db, series);
  if (Status read = p_->db->takeStatus(); !read) return read.error();
  if (file.empty()) return Thumbnail{};
  if (Rows rows = p_->thumbnails->run("SELECT png FROM thumbnail WHERE key = ? AND made_of = ?", Blob{key},
                                      Blob{madeOf});
      rows.next()) {
    const std::string png = rows.bytes(0);
    return Thumbnail(png.begin(), png.end());
  }
  if (!exists(file)) return Thumbnail{};  // offline now, maybe online next time
  const Result<Thumbnail> made = makeThumbnail(file);
  const Thumbnail thumbnail = made ? *made : Thumbnail{};  // damaged pixels are not read again
  p_->thumbnails->run("INSERT OR REPLACE INTO thumbnail(key, made_of, png) VALUES(?, ?, ?)", Blob{key},
                      Blob{madeOf}, Blob{std::string(thumbnail.begin(), thumbnail.end())});
  (void)p_->thumbnails->takeStatus().ok();  // a thumbnail that cannot be kept is made again
  return thumbnail;
}

Status Index::opened(std::int64_t study) {
  p_->db->run("UPDATE study SET opened_at = ? WHERE id = ?", timeNow(), study);
  return p_->db->takeStatus();
}

Status Index::forget(const std::vector<std::int64_t>& studies) {
  const std::string now = timeNow();
  p_->db->begin();
  for (const std::int64_t study : studies)
    p_->db->run("UPDATE study SET forgotten_at = ? WHERE id = ?", now, study);
  return p_->db->commit();
}

Status Index::undoForget(const std::vector<std::int64_t>& studies) {
  p_->db->begin();
  for (const std::int64_t study : studies)
    p_->db->run("UPDATE study SET forgotten_at = '' WHERE id = ?", study);
  return p_->db->commit();
}

Result<std::vector<std::int64_t>> Index::lastForgotten() const {
  std::vector<std::int64_t> studies;
  for (Rows rows = p_->db->run("SELECT id FROM study WHERE forgotten_at <> '' AND forgotten_at = (SELECT"
                               " MAX(forgotten_at) FROM study) ORDER BY id");
       rows.next();)
    studies.push_back(rows.number(0));
  if (Status read = p_->db->takeStatus(); !read) return read.error();
  return studies;
}

std::string userIndexFolder() {
  const QString all = QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation);
  return all.isEmpty() ? std::string() : QFile::encodeName(all + QStringLiteral("/volumen")).toStdString();
}

}  // namespace volumen
