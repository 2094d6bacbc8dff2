#include "io/index/query.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

#include "io/index/files_below.h"
#include "io/index/fold.h"
#include "io/index/named_day.h"

namespace volumen {
namespace {

std::string pathOf(const std::string& folder, const std::string& name) {
  return FileOnDisk{folder, name, {}}.path();
}

// The online state of folders; each is checked once.
class Folders {
 public:
  explicit Folders(Database& db) : db_(db) {}
  bool online(std::int64_t id) {
    const auto known = online_.find(id);
    if (known != online_.end()) return known->second;
    bool there = false;
    if (Rows rows = db_.run("SELECT path, device FROM folder WHERE id = ?", id); rows.next())
      there = isOnline(rows.bytes(0), rows.number(1));
    return online_[id] = there;
  }

 private:
  Database& db_;
  std::unordered_map<std::int64_t, bool> online_;
};

// Returns the words in their search form, and dates for those that name a day.
std::vector<std::string> datedWords(const std::string& words) {
  QStringList dated;
  for (const QString& word : QString::fromStdString(words).split(QLatin1Char(' '), Qt::SkipEmptyParts)) {
    const QDate day = namedDay(word, QDate::currentDate());
    dated << (day.isValid() ? day.toString(Qt::ISODate) : word);
  }
  return foldedWords(dated.join(QLatin1Char(' ')).toStdString());
}

// Returns the studies that contain all words, unsorted, with their numbers in the index.
std::vector<IndexedStudy> matching(Database& db, const std::string& words) {
  std::vector<std::string> patterns;
  for (const std::string& word : datedWords(words)) patterns.push_back(likePattern(word));
  std::vector<IndexedStudy> studies;
  // SQLite searches for the longest word; the others are searched for in its result.
  std::ranges::sort(patterns, {}, [](const std::string& p) { return -std::ptrdiff_t(p.size()); });
  const std::string first = patterns.empty() ? "%" : patterns[0];
  for (Rows rows = db.run(
           "SELECT id, patient_name, patient_id, birth_date, sex, uid, date, time, description, accession,"
           " imported_at, opened_at, institution FROM study WHERE words LIKE ? ESCAPE '\\' AND forgotten_at "
           "= '' AND "
           "empty_at = ''",
           first);
       rows.next();) {
    IndexedStudy s;
    s.id = rows.number(0);
    s.patientName = rows.text(1), s.patientId = rows.text(2), s.birthDate = rows.text(3),
    s.sex = rows.text(4);
    s.studyUid = rows.text(5), s.date = rows.text(6), s.time = rows.text(7), s.description = rows.text(8);
    s.accessionNumber = rows.text(9), s.importedAt = rows.text(10), s.openedAt = rows.text(11);
    s.institution = rows.text(12);
    studies.push_back(std::move(s));
  }
  for (std::size_t n = 1; n < patterns.size(); ++n)
    std::erase_if(studies, [&](const IndexedStudy& s) {
      return db.number("SELECT COUNT(*) FROM study WHERE id = ? AND words LIKE ? ESCAPE '\\'", s.id,
                       patterns[n]) == 0;
    });
  return studies;
}

// Combines the series of studies.
class Summary {
 public:
  // Reads all series at once for many studies, one study at a time for few.
  Summary(Database& db, const std::vector<IndexedStudy>& studies) : folders_(db) {
    constexpr std::size_t few = 50;
    if (studies.size() > few) {
      addSeries(
          db.run("SELECT study_id, id, modality, images, (SELECT COUNT(*) FROM warning WHERE series_id ="
                 " series.id) FROM series"));
      addFolders(
          db.run("SELECT DISTINCT s.study_id, f.folder_id FROM series s JOIN series_folder f ON"
                 " f.series_id = s.id"));
      return;
    }
    for (const IndexedStudy& study : studies) {
      addSeries(
          db.run("SELECT study_id, id, modality, images, (SELECT COUNT(*) FROM warning WHERE series_id ="
                 " series.id) FROM series WHERE study_id = ?",
                 study.id));
      addFolders(
          db.run("SELECT DISTINCT s.study_id, f.folder_id FROM series s JOIN series_folder f ON"
                 " f.series_id = s.id WHERE s.study_id = ?",
                 study.id));
    }
  }

  void addTo(IndexedStudy& study) {
    const Facts& facts = facts_[study.id];
    study.series = facts.series, study.images = facts.images, study.warnings = facts.warnings;
    for (const std::string& modality : facts.modalities)
      study.modalities += (study.modalities.empty() ? "" : ", ") + modality;
    study.offline = std::ranges::none_of(facts.folders, [&](std::int64_t id) { return folders_.online(id); });
  }

 private:
  struct Facts {
    int series = 0, images = 0, warnings = 0;
    std::set<std::string> modalities;
    std::vector<std::int64_t> folders;
  };

  void addSeries(Rows rows) {
    while (rows.next()) {
      Facts& facts = facts_[rows.number(0)];
      ++facts.series;
      if (std::string modality = rows.text(2); !modality.empty())
        facts.modalities.insert(std::move(modality));
      facts.images += int(rows.number(3));
      facts.warnings += int(rows.number(4));
    }
  }
  void addFolders(Rows rows) {
    while (rows.next()) facts_[rows.number(0)].folders.push_back(rows.number(1));
  }

  Folders folders_;
  std::unordered_map<std::int64_t, Facts> facts_;  // keys: studies
};

// Returns the sort key of a study; the date breaks ties.
std::string sortKey(const IndexedStudy& s, StudyOrder order) {
  const std::string when = s.date + s.time;
  switch (order) {
    case StudyOrder::date:
      return when;
    case StudyOrder::patient:
      return folded(s.patientName) + '\0' + s.patientId + '\0' + when;
    case StudyOrder::modality:
      return s.modalities + '\0' + when;
    case StudyOrder::imported:
      return s.importedAt;
    case StudyOrder::opened:
      return s.openedAt;
  }
  return {};
}

void sortStudies(std::vector<IndexedStudy>& studies, const StudyQuery& query) {
  std::vector<std::pair<std::string, std::size_t>> keys;
  for (std::size_t n = 0; n < studies.size(); ++n) keys.emplace_back(sortKey(studies[n], query.order), n);
  const auto before = [&](const auto& a, const auto& b) {
    if (a.first != b.first) return query.ascending ? a.first < b.first : a.first > b.first;
    return studies[a.second].id < studies[b.second].id;
  };
  std::ranges::sort(keys, before);
  if (query.limit > 0 && keys.size() > std::size_t(query.limit)) keys.resize(std::size_t(query.limit));
  std::vector<IndexedStudy> sorted;
  for (const auto& [key, n] : keys) sorted.push_back(std::move(studies[n]));
  studies = std::move(sorted);
}

std::vector<std::string> warningsOf(Database& db, std::int64_t series) {
  std::vector<std::string> warnings;
  for (Rows rows = db.run("SELECT sentence FROM warning WHERE series_id = ? ORDER BY position", series);
       rows.next();)
    warnings.push_back(rows.text(0));
  return warnings;
}

// Sorts by series number, then by order of discovery.
bool before(const IndexedSeries& a, const IndexedSeries& b) {
  const long x = std::atol(a.number.c_str()), y = std::atol(b.number.c_str());
  return x != y ? x < y : a.id < b.id;
}

}  // namespace

std::vector<IndexedStudy> findStudies(Database& db, const StudyQuery& query) {
  std::vector<IndexedStudy> studies = matching(db, query.words);
  // Modalities are known only after all series were read. For other orders only the requested studies are
  // read.
  const bool byModality = query.order == StudyOrder::modality;
  if (!byModality) sortStudies(studies, query);
  Summary summary(db, studies);
  for (IndexedStudy& study : studies) summary.addTo(study);
  if (byModality) sortStudies(studies, query);
  return studies;
}

std::vector<IndexedSeries> findSeriesOf(Database& db, std::int64_t study) {
  std::vector<IndexedSeries> all;
  Folders folders(db);
  for (Rows rows = db.run("SELECT id, uid, number, modality, description, date, time, label, images, frames,"
                          " is_volume FROM series WHERE study_id = ?",
                          study);
       rows.next();) {
    IndexedSeries s;
    s.id = rows.number(0);
    s.seriesUid = rows.text(1), s.number = rows.text(2), s.modality = rows.text(3),
    s.description = rows.text(4);
    s.date = rows.text(5), s.time = rows.text(6), s.label = rows.text(7);
    s.images = int(rows.number(8)), s.frames = int(rows.number(9)), s.isVolume = rows.number(10) != 0;
    all.push_back(std::move(s));
  }
  for (IndexedSeries& s : all) {
    s.warnings = warningsOf(db, s.id);
    s.offline = true;
    for (Rows rows = db.run("SELECT folder_id FROM series_folder WHERE series_id = ?", s.id);
         s.offline && rows.next();)
      s.offline = !folders.online(rows.number(0));
  }
  std::ranges::sort(all, before);
  return all;
}

std::string middleFile(Database& db, std::int64_t series) {
  const std::int64_t volume =
      db.number("SELECT MIN(volume) FROM file WHERE series_id = ? AND volume > 0", series);
  const std::int64_t count = db.number(
      "SELECT COUNT(*) FROM file WHERE series_id = ? AND volume = ? AND frames > 0", series, volume);
  Rows rows = db.run(
      "SELECT d.path, f.name FROM file f JOIN folder d ON d.id = f.folder_id WHERE f.series_id = ? AND "
      "f.volume"
      " = ? AND f.frames > 0 ORDER BY f.position LIMIT 1 OFFSET ?",
      series, volume, count / 2);
  return rows.next() ? pathOf(rows.bytes(0), rows.bytes(1)) : std::string();
}

namespace {

// Returns paths from rows of a folder and a name.
std::vector<std::string> pathsOf(Rows rows) {
  std::vector<std::string> paths;
  while (rows.next()) paths.push_back(pathOf(rows.bytes(0), rows.bytes(1)));
  return paths;
}

}  // namespace

std::vector<std::string> findFilesOf(Database& db, std::int64_t study, std::int64_t series) {
  return pathsOf(
      db.run("SELECT d.path, f.name FROM file f JOIN folder d ON d.id = f.folder_id JOIN series s ON s.id ="
             " f.series_id WHERE s.study_id = ? AND (? = 0 OR s.id = ?) ORDER BY s.id, f.position, d.path, "
             "f.name",
             study, series, series));
}

std::vector<std::string> findRefusedBeside(Database& db, std::int64_t study, std::int64_t series) {
  return pathsOf(
      db.run("SELECT d.path, f.name FROM file f JOIN folder d ON d.id = f.folder_id WHERE f.reason <> '' AND"
             " f.folder_id IN (SELECT sf.folder_id FROM series_folder sf JOIN series s ON s.id = sf.series_id"
             " WHERE s.study_id = ? AND (? = 0 OR s.id = ?)) ORDER BY d.path, f.name",
             study, series, series));
}

}  // namespace volumen
