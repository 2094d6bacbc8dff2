#include "ui/controller/open_session.h"

#include <QDir>
#include <QFileInfo>
#include <algorithm>
#include <iterator>
#include <map>

#include "io/files/output_file.h"
#include "io/files/session_file.h"
#include "ui/data/frame_series.h"
#include "ui/workspace/session_json.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

std::string folderOf(const std::string& path) {
  return QFileInfo(QString::fromStdString(path)).absolutePath().toStdString();
}

bool hasName(const Series& series, const Series& name) {
  return series.id == name.id || (!name.seriesUid.empty() && series.seriesUid == name.seriesUid);
}

// The series that is what it was; ids may have changed with what lies beside it. Null: none is.
const Series* sameSeries(const std::vector<Series>& all, const SavedSeries& saved) {
  const Series* found = nullptr;
  for (const Series& series : all) {
    if (!hasName(series, saved.series) || proofOf(series) != saved.proof) continue;
    if (series.id == saved.series.id) return &series;
    if (!found) found = &series;
  }
  return found;
}

const Series* namesake(const std::vector<Series>& all, const SavedSeries& saved) {
  for (const Series& series : all)
    if (hasName(series, saved.series)) return &series;
  return nullptr;
}

// Looks for series, opening each path once.
class Search {
 public:
  Search(std::string folder, const Progress& progress, const CancelToken& cancel)
      : folder_(std::move(folder)), progress_(progress), cancel_(cancel) {}

  std::shared_ptr<const Series> operator()(const SavedSeries& saved) {
    const Series* changed = nullptr;
    for (const std::string& place : placesOf(saved)) {
      const std::vector<Series>& all = seriesAt(place);
      if (const Series* found = sameSeries(all, saved)) return std::make_shared<const Series>(*found);
      if (!changed) changed = namesake(all, saved);
    }
    problems.push_back(problemOf(saved, changed));
    return nullptr;
  }

  std::vector<std::pair<std::string, std::shared_ptr<const Study>>> studies() const {
    std::vector<std::pair<std::string, std::shared_ptr<const Study>>> opened;
    for (const auto& [path, place] : places_)
      if (!place.series.empty()) opened.emplace_back(path, place.study);
    return opened;
  }

  QStringList problems;

 private:
  struct Place {
    std::shared_ptr<const Study> study;
    std::vector<Series> series;
  };

  std::vector<std::string> placesOf(const SavedSeries& saved) const {
    std::vector<std::string> places;
    if (!saved.relativePath.empty())
      places.push_back(
          QDir::cleanPath(QString::fromStdString(folder_ + "/" + saved.relativePath)).toStdString());
    if (places.empty() || places.front() != saved.series.path) places.push_back(saved.series.path);
    return places;
  }

  // Volumes, and frames of what is none; empty: nothing is there.
  const std::vector<Series>& seriesAt(const std::string& path) {
    const auto [at, isNew] = places_.try_emplace(path);
    Place& place = at->second;
    if (!isNew || cancel_.cancelled()) return place.series;
    if (Result<Study> study = openStudy(path, progress_, cancel_)) {
      place.series = study->volumes;
      std::ranges::move(frameSeries(*study), std::back_inserter(place.series));
      place.study = std::make_shared<const Study>(std::move(*study));
    }
    return place.series;
  }

  static QString problemOf(const SavedSeries& saved, const Series* changed) {
    const QString name = tr("%1 (%2)").arg(seriesText(saved.series), pathText(saved.series.path));
    if (!changed) return tr("%1 was not found: its views stay empty until it is opened.").arg(name);
    const QString how = QString::fromStdString(changeText(saved.proof, proofOf(*changed)));
    return tr("%1 has changed since the session was saved, %2: its views stay empty until it is opened.")
        .arg(name, how);
  }

  const std::string folder_;
  const Progress& progress_;
  const CancelToken& cancel_;
  std::map<std::string, Place> places_;
};

}  // namespace

Result<OpenedSession> openSession(const std::string& path, const Progress& progress,
                                  const CancelToken& cancel) {
  const auto text = sessionText(path);
  if (!text) return text.error();
  // Nothing is looked for before all of it is known to be right.
  if (const auto right = sessionFromJson(*text, {}); !right) return Error{path + ": " + right.message()};
  Search search(folderOf(path), progress, cancel);
  auto session = sessionFromJson(*text, std::ref(search));
  if (cancel.cancelled()) return Error{path + ": interrupted."};
  if (!session) return Error{path + ": " + session.message()};
  return OpenedSession{std::move(session->workspace), session->savedAs, search.studies(), search.problems};
}

Status saveSession(const std::string& path, const Workspace& workspace, const std::string& savedAs) {
  const auto text = sessionToJson(workspace, folderOf(path), savedAs);
  if (!text) return Error{"Cannot write " + path + ": " + text.message()};
  auto file = OutputFile::create(path);
  if (!file) return file.error();
  if (Status s = file->write(*text); !s) return s;
  return file->commit();
}

}  // namespace volumen
