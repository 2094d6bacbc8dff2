#include "io/index/writer.h"

#include <sys/stat.h>

#include <QDateTime>
#include <QRandomGenerator>

#include "io/index/fold.h"
#include "io/regular_file.h"
#include "io/study/iso_date.h"

namespace volumen {
namespace {

std::string joined(std::initializer_list<std::string> parts) {
  std::string key;
  for (const std::string& part : parts) key += part + '\0';
  return key;
}

// Returns the key of a study. The UID alone is not enough, as other patients may have the same.
std::string studyKey(const SeriesIdentity& s) {
  if (!s.studyUid.empty()) return joined({s.patientName, s.patientId, s.studyUid});
  return joined({s.patientName, s.patientId, {}, s.studyDate, s.studyDescription});
}

// Returns a key for a series without a UID: it is found again by its files.
std::string newKey() { return "file " + std::to_string(QRandomGenerator::global()->generate64()); }

std::string orElse(const std::string& text, const std::string& other) { return text.empty() ? other : text; }

bool isThere(const std::string& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

}  // namespace

std::string timeNow() { return QDateTime::currentDateTimeUtc().toString(Qt::ISODateWithMs).toStdString(); }

std::int64_t Writer::folderId(const std::string& path) {
  const auto known = folders_.find(path);
  if (known != folders_.end()) return known->second;
  struct stat status {};
  const std::int64_t device = stat(path.c_str(), &status) == 0 ? std::int64_t(status.st_dev) : 0;
  const std::int64_t id = db_.number(
      "INSERT INTO folder(path, device) VALUES(?, ?) ON CONFLICT(path) DO UPDATE SET device = excluded.device"
      " RETURNING id",
      Blob{path}, device);
  return folders_[path] = id;
}

// Returns the series to which an indexed file belongs; 0: none.
std::int64_t Writer::knownSeries(const FileOnDisk& file) {
  return db_.number("SELECT series_id FROM file WHERE folder_id = ? AND name = ?", folderId(file.folder),
                    Blob{file.name});
}

std::int64_t Writer::studyId(const ReadSeries& series, std::int64_t known) {
  const SeriesIdentity& s = series.identity;
  std::string key = series.isDicom ? studyKey(s) : std::string();
  if (key.empty() && known)
    if (Rows rows = db_.run(
            "SELECT study.key FROM series JOIN study ON study.id = study_id WHERE series.id = ?", known);
        rows.next())
      key = rows.bytes(0);
  if (key.empty()) key = newKey();
  const std::string description =
      series.isDicom ? s.studyDescription : orElse(s.studyDescription, fileName(series.files[0].path));
  const std::int64_t id = db_.number(
      "INSERT INTO study(key, uid, patient_name, patient_id, birth_date, sex, date, time, description,"
      " accession, institution, imported_at) VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?) ON CONFLICT(key) DO"
      " UPDATE SET"
      " birth_date = IFNULL(NULLIF(excluded.birth_date, ''), birth_date),"
      " sex = IFNULL(NULLIF(excluded.sex, ''), sex), date = IFNULL(NULLIF(excluded.date, ''), date),"
      " time = IFNULL(NULLIF(excluded.time, ''), time),"
      " description = IFNULL(NULLIF(excluded.description, ''), description),"
      " accession = IFNULL(NULLIF(excluded.accession, ''), accession),"
      " institution = IFNULL(NULLIF(excluded.institution, ''), institution), forgotten_at = '' RETURNING id",
      Blob{key}, s.studyUid, s.patientName, s.patientId, series.further.birthDate, series.further.sex,
      s.studyDate, series.further.studyTime, description, series.further.accessionNumber,
      series.further.institution, timeNow());
  studies_.insert(id);
  return id;
}

std::int64_t Writer::seriesId(std::int64_t study, const ReadSeries& series, std::int64_t known) {
  const SeriesIdentity& s = series.identity;
  std::string key = s.seriesUid;
  if (key.empty() && known) {
    if (Rows rows =
            db_.run("SELECT key FROM series WHERE id = ? AND study_id = ? AND uid = ''", known, study);
        rows.next())
      key = rows.bytes(0);
  }
  if (key.empty()) key = newKey();
  const std::string description =
      series.isDicom ? s.description : orElse(s.description, fileName(series.files[0].path));
  return db_.number(
      "INSERT INTO series(study_id, key, uid, number, modality, description, date, time, label, is_volume)"
      " VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?) ON CONFLICT(study_id, key) DO UPDATE SET number ="
      " excluded.number, modality = excluded.modality, description = excluded.description, date ="
      " excluded.date, time = excluded.time, label = excluded.label, is_volume = excluded.is_volume"
      " RETURNING id",
      study, Blob{key}, s.seriesUid, s.seriesNumber, s.modality, description,
      orElse(series.further.seriesDate, s.studyDate), orElse(series.further.seriesTime, series.time),
      series.label, series.isVolume);
}

void Writer::writeFile(const FileOnDisk& file, std::int64_t series, const FoundFile& found, int position) {
  if (const std::int64_t before = knownSeries(file); before && before != series) lose(before);
  db_.run(
      "INSERT INTO file(folder_id, name, size, mtime_ns, ctime_ns, inode, device, series_id, sop_uid, volume,"
      " position, frames) VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?) ON CONFLICT(folder_id, name) DO UPDATE "
      "SET"
      " size = excluded.size, mtime_ns = excluded.mtime_ns, ctime_ns = excluded.ctime_ns, inode ="
      " excluded.inode, device = excluded.device, series_id = excluded.series_id, sop_uid = excluded.sop_uid,"
      " volume = excluded.volume, position = excluded.position, frames = excluded.frames, reason = '',"
      " program = '', no_image = 0",
      folderId(file.folder), Blob{file.name}, file.state.size, file.state.modifiedNs, file.state.changedNs,
      file.state.inode, file.state.device, RowId{series}, found.sopInstanceUid, found.volume, position,
      found.frames);
}

void Writer::writeOther(const FileOnDisk& file, const std::string& reason, bool isImage) {
  const std::int64_t folder = folderId(file.folder);
  const bool known = db_.number("SELECT COUNT(*) FROM file WHERE folder_id = ? AND name = ? AND reason = ?",
                                folder, Blob{file.name}, reason) > 0;
  writeFile(file, 0, {}, 0);
  if (reason.empty()) return;
  db_.run("UPDATE file SET reason = ?, program = ?, no_image = ? WHERE folder_id = ? AND name = ?", reason,
          VOLUMEN_VERSION, !isImage, folder, Blob{file.name});
  if (!known) tellAnew(folder);
}

void Writer::tellAnew(std::int64_t folder) {
  db_.run("UPDATE series SET stale = 1 WHERE id IN (SELECT series_id FROM series_folder WHERE folder_id = ?)",
          folder);
}

void Writer::writeSeries(const ReadSeries& series, const std::map<std::string, const FileOnDisk*>& onDisk) {
  const bool findByFile = !series.isDicom || series.identity.seriesUid.empty();
  const std::int64_t known = findByFile ? knownSeries(*onDisk.at(series.files[0].path)) : 0;
  const std::int64_t study = studyId(series, known);
  const std::int64_t id = seriesId(study, series, known);
  series_.insert(id);
  db_.run("DELETE FROM warning WHERE series_id = ?", id);
  for (std::size_t n = 0; n < series.warnings.size(); ++n)
    db_.run("INSERT INTO warning(series_id, position, sentence) VALUES(?, ?, ?)", id, int(n),
            series.warnings[n]);
  for (std::size_t n = 0; n < series.files.size(); ++n)
    writeFile(*onDisk.at(series.files[n].path), id, series.files[n], int(n));
  written_[id] += std::int64_t(series.files.size());
}

void Writer::write(const std::vector<FileOnDisk>& files, const ReadFiles& read) {
  std::map<std::string, const FileOnDisk*> onDisk, others;
  for (const FileOnDisk& file : files) onDisk[file.path()] = &file;
  others = onDisk;
  for (const ReadSeries& series : read.series) {
    writeSeries(series, onDisk);
    for (const FoundFile& file : series.files) others.erase(file.path);
  }
  const auto writeReasons = [&](const std::vector<Refused>& lost, bool isImage) {
    for (const Refused& lostFile : lost) {
      const auto file = others.find(lostFile.path);
      if (file == others.end()) continue;
      // A file that failed because of the machine stays unrecorded, so the next import reads it.
      if (!lostFile.again) writeOther(*file->second, lostFile.reason, isImage);
      others.erase(file);
    }
  };
  writeReasons(read.refused, true);
  writeReasons(read.lacking, false);
  for (const auto& [path, file] : others) writeOther(*file, {}, false);
}

void Writer::setInstitution(std::int64_t study, const std::string& institution) {
  db_.run("UPDATE study SET institution = ? WHERE id = ?", institution, study);
  studies_.insert(study);
}

void Writer::move(std::int64_t file, const FileOnDisk& to) {
  const std::int64_t series = db_.number("SELECT series_id FROM file WHERE id = ?", file);
  db_.run("DELETE FROM file WHERE folder_id = ? AND name = ? AND id <> ?", folderId(to.folder), Blob{to.name},
          file);
  db_.run("UPDATE file SET folder_id = ?, name = ?, ctime_ns = ? WHERE id = ?", folderId(to.folder),
          Blob{to.name}, to.state.changedNs, file);
  if (!series) return;
  series_.insert(series);
  // The series' warnings may name files.
  db_.run(
      "UPDATE series SET stale = 1 WHERE id = ? AND (uid = '' OR EXISTS (SELECT * FROM warning WHERE "
      "series_id"
      " = series.id))",
      series);
}

void Writer::remove(std::int64_t file) {
  const std::int64_t series = db_.number("SELECT series_id FROM file WHERE id = ?", file);
  if (Rows rows = db_.run("SELECT folder_id FROM file WHERE id = ? AND reason <> ''", file); rows.next())
    tellAnew(rows.number(0));
  db_.run("DELETE FROM file WHERE id = ?", file);
  if (series) lose(series);
}

void Writer::lose(std::int64_t series) {
  series_.insert(series);
  lost_.insert(series);
}

// Removes moved files of a SOP Instance UID that has several files.
void Writer::dropMoved(std::int64_t series) {
  std::vector<std::pair<std::int64_t, FileOnDisk>> several;
  for (Rows rows = db_.run(
           "SELECT f.id, d.path, f.name FROM file f JOIN folder d ON d.id = f.folder_id WHERE f.series_id = "
           "? AND"
           " f.sop_uid IN (SELECT sop_uid FROM file WHERE series_id = ? AND sop_uid <> '' GROUP BY sop_uid"
           " HAVING COUNT(*) > 1)",
           series, series);
       rows.next();)
    several.push_back({rows.number(0), {rows.bytes(1), rows.bytes(2), {}}});
  bool oneIsThere = false;
  for (const auto& [id, file] : several) oneIsThere = oneIsThere || isThere(file.path());
  if (!oneIsThere) return;
  for (const auto& [id, file] : several)
    if (!isThere(file.path())) db_.run("DELETE FROM file WHERE id = ?", id);
}

void Writer::finishSeries(std::int64_t series) {
  dropMoved(series);
  std::int64_t study = 0, files = 0, frames = 0;
  if (Rows rows = db_.run("SELECT study_id FROM series WHERE id = ?", series); rows.next())
    study = rows.number(0);
  if (!study) return;
  studies_.insert(study);
  if (Rows rows = db_.run("SELECT COUNT(*), TOTAL(frames) FROM file WHERE series_id = ?", series);
      rows.next())
    files = rows.number(0), frames = rows.number(1);
  if (files == 0) {
    db_.run("DELETE FROM series WHERE id = ?", series);
    return;
  }
  db_.run("UPDATE series SET images = ?, frames = ? WHERE id = ?", files, frames, series);
  const auto written = written_.find(series);
  if (written != written_.end() || lost_.contains(series))
    db_.run("UPDATE series SET stale = ? WHERE id = ?", written == written_.end() || written->second < files,
            series);
  db_.run("DELETE FROM series_folder WHERE series_id = ?", series);
  db_.run("INSERT INTO series_folder SELECT DISTINCT series_id, folder_id FROM file WHERE series_id = ?",
          series);
}

// Sets a study's search words, and the time when it lost its last file. It is kept for a while, as its files
// may turn up elsewhere.
void Writer::finishStudy(std::int64_t study) {
  std::string words;
  if (Rows rows = db_.run("SELECT patient_name, patient_id, date, description, accession, institution FROM "
                          "study WHERE id = ?",
                          study);
      rows.next())
    words = rows.text(0) + " " + rows.text(1) + " " + rows.text(2) + " " + isoDate(rows.text(2)) + " " +
            rows.text(3) + " " + rows.text(4) + " " + rows.text(5);
  std::set<std::string> ofSeries;
  std::int64_t count = 0;
  for (Rows rows = db_.run("SELECT modality, description FROM series WHERE study_id = ?", study); rows.next();
       ++count)
    ofSeries.insert({rows.text(0), rows.text(1)});
  for (const std::string& text : ofSeries) words += " " + text;
  db_.run("UPDATE study SET words = ?, empty_at = ? WHERE id = ?", folded(words),
          count ? std::string() : timeNow(), study);
}

void Writer::finish() {
  for (const std::int64_t series : series_) finishSeries(series);
  for (const std::int64_t study : studies_) finishStudy(study);
  series_.clear();
  studies_.clear();
  written_.clear();
  lost_.clear();
}

}  // namespace volumen
