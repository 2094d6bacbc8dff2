#include "ui/controller/open_session.h"

#include <QDir>
#include <QFileInfo>
#include <algorithm>
#include <map>
#include <set>

#include "io/archive/fetched_studies.h"
#include "io/files/output_file.h"
#include "io/files/session_file.h"
#include "io/paths/open_path.h"
#include "io/open.h"
#include "io/zip_archive.h"
#include "results/segments/segment_maps.h"
#include "results/text/text.h"
#include "ui/controller/find_saved.h"
#include "ui/controller/segment_files.h"
#include "ui/data/picture_stacks.h"
#include "ui/workspace/session_json.h"

namespace volumen {

namespace {

std::string folderOf(const std::string& path) {
  return QFileInfo(QString::fromStdString(path)).absolutePath().toStdString();
}

// Searches for series and objects that refer to pictures, and opens each path once.
class Search {
 public:
  Search(std::string folder, const std::vector<SavedSeries>& all, const Progress& progress,
         const CancelToken& cancel)
      : folder_(std::move(folder)), progress_(progress), cancel_(cancel) {
    for (const SavedSeries& saved : all)
      for (const std::string& path : placesOf(saved.relativePath, saved.series.path)) {
        Wanted& wanted = wanted_[path];
        wanted.whole |= saved.folders.empty();
        for (const SavedFolder& part : saved.folders) wanted.folders.insert(part.path);
      }
  }

  std::shared_ptr<const Series> operator()(const SavedSeries& saved) {
    const Series* changed = nullptr;
    for (const std::string& path : placesOf(saved.relativePath, saved.series.path)) {
      const std::vector<Series>& all = placeAt(path).series;
      if (const Series* found = findSaved(all, saved)) return std::make_shared<const Series>(*found);
      if (!changed) changed = namesakeOf(all, saved);
    }
    tell(problemOf(saved, changed));
    return nullptr;
  }

  std::optional<DerivedKey> findObject(const SavedObject& saved) {
    const std::vector<std::string> paths = placesOf(saved.relativePath, saved.key.path);
    // The object may lie in a folder that is open already.
    for (const std::string& path : paths)
      for (const auto& [opened, place] : places_)
        if (const DerivedObject* found = place.study ? findSaved(*place.study, saved) : nullptr)
          if (lastingPath(found->path) == path) return keyOf(*found);
    for (const std::string& path : paths)
      if (const Place& place = placeAt(path); place.study)
        if (const DerivedObject* found = findSaved(*place.study, saved)) return keyOf(*found);
    tell(problemOf(saved));
    return {};
  }

  std::vector<std::pair<std::string, std::shared_ptr<const Study>>> studies() const {
    std::vector<std::pair<std::string, std::shared_ptr<const Study>>> opened;
    for (const auto& [path, place] : places_)
      if (!place.series.empty() || (place.study && !place.study->derived.empty()))
        opened.emplace_back(path, place.study);
    return opened;
  }

  QStringList problems;

 private:
  struct Place {
    std::shared_ptr<const Study> study;
    std::vector<Series> series;
  };

  // The scope of the search in a path: everything below it, or files directly in folders.
  struct Wanted {
    bool whole = false;
    std::set<std::string> folders;
  };

  std::vector<std::string> placesOf(const std::string& relativePath, const std::string& path) const {
    std::vector<std::string> places;
    if (!relativePath.empty())
      places.push_back(QDir::cleanPath(QString::fromStdString(folder_ + "/" + relativePath)).toStdString());
    if (places.empty() || places.front() != path) places.push_back(path);
    return places;
  }

  // The place is empty if nothing is there.
  const Place& placeAt(const std::string& path) {
    const auto [at, isNew] = places_.try_emplace(path);
    Place& place = at->second;
    if (!isNew || cancel_.cancelled()) return place;
    if (Result<Study> study = opened(path)) {
      useFetched(*study);
      place.series = allSeriesOf(*study);
      place.study = std::make_shared<const Study>(withPictureStacks(std::move(*study)));
    }
    return place;
  }

  Result<Study> opened(const std::string& path) const {
    const auto wanted = wanted_.find(path);
    if (wanted == wanted_.end() || wanted->second.whole) return openPath(path, progress_, cancel_);
    const std::set<std::string>& folders = wanted->second.folders;
    return openFolders(path, {folders.begin(), folders.end()}, progress_, cancel_);
  }

  // Each sentence is kept once, because volumes of one series would repeat it.
  void tell(const QString& problem) {
    if (!problems.contains(problem)) problems << problem;
  }

  static QString problemOf(const SavedSeries& saved, const Series* changed) {
    const QString name = tr("%1 (%2)").arg(seriesText(saved.series), pathText(saved.series.path));
    if (!changed) return tr("%1 was not found: its views stay empty until it is opened.").arg(name);
    const QString how = QString::fromStdString(changeText(saved.proof, proofOf(*changed)));
    return tr("%1 has changed since the session was saved, %2: its views stay empty until it is opened.")
        .arg(name, how);
  }

  static QString problemOf(const SavedObject& saved) {
    const QString path = pathText(saved.key.path);
    switch (saved.kind) {
      case DerivedKind::contours:
        return tr("The contours of %1 were not found: they are not shown until it is opened.").arg(path);
      case DerivedKind::segmentation:
        return tr("The segmentation %1 was not found: it is not shown until it is opened.").arg(path);
      default:
        return tr("The presentation state %1 was not found: its pictures are shown without it.").arg(path);
    }
  }

  const std::string folder_;
  const Progress& progress_;
  const CancelToken& cancel_;
  std::map<std::string, Wanted> wanted_;
  std::map<std::string, Place> places_;
};

QString problemOf(const UnreadSteps& unread, const Workspace& workspace) {
  const QString series = seriesText(*workspace.series.at(unread.series).series);
  const bool isOneOfSeveral = segmentMapsOf(workspace, unread.series).size() > 1;
  return tr("How the segments of %1 were made cannot be read: %2 They count as made by hand.")
      .arg(isOneOfSeveral ? tr("%1 (%2)").arg(series, mapName(unread.map)) : series, shownText(unread.why));
}

// Returns the workspace of a session file, restricted to series that were found already.
std::optional<Workspace> workspaceIn(const std::string& path, const Workspace& found, Search& search) {
  const auto text = path.empty() ? Result<std::string>(Error{}) : sessionText(path);
  if (!text) return {};
  std::vector<Series> all;
  for (const auto& [key, state] : found.series) all.push_back(*state.series);
  const auto find = [&](const SavedSeries& saved) {
    const Series* series = findSaved(all, saved);
    return series ? std::make_shared<const Series>(*series) : nullptr;
  };
  auto saved =
      sessionFromJson(*text, find, [&](const SavedObject& object) { return search.findObject(object); });
  if (!saved) return {};
  for (const SegmentMap& map : found.segmentMaps)
    saved->workspace.segmentMaps.editIf(
        [&](const SegmentMap& other) {
          return other.missing && map.labels && *other.missing == savedLabelsOf(map);
        },
        [&](SegmentMap& other) {
          other.labels = map.labels;
          other.missing.reset();
        });
  return std::move(saved->workspace);
}

std::vector<SavedPatient> patientsOf(const Workspace& workspace) {
  std::vector<SavedPatient> patients;
  for (const auto& [key, state] : workspace.series) {
    const SavedPatient patient{state.series->patientName, state.series->patientId};
    if (patient != SavedPatient() && std::ranges::find(patients, patient) == patients.end())
      patients.push_back(patient);
  }
  return patients;
}

// Returns the maps that are in `saved` as they are.
std::vector<ExportedMap> exportedOf(const Workspace& workspace, const HandWork& saved) {
  std::vector<ExportedMap> exported;
  for (const SegmentMap& map : workspace.segmentMaps) {
    HandWork work;
    work.segmentMaps = {map};
    if (without(work, saved).empty()) exported.push_back({map.series, map.number});
  }
  return exported;
}

// Returns the maps whose labels were read.
HandWork workOf(const std::vector<ExportedMap>& exported, const Workspace& workspace) {
  HandWork work;
  for (const SegmentMap& map : workspace.segmentMaps)
    if (map.labels && std::ranges::count(exported, ExportedMap{map.series, map.number}) > 0)
      work.segmentMaps.push_back(map);
  return work;
}

Status writeSession(const std::string& path, const Result<std::string>& text, const Workspace& workspace,
                    LabelFiles labels) {
  if (!text) return Error{"Cannot write " + path + ": " + text.message()};
  std::vector<std::string> before = segmentMapsNamedBy(path);
  if (Status s = writeSegmentMaps(path, workspace, labels); !s) return s;
  if (Status s = writeWholeFile(path, *text); !s) return s;
  const std::vector<std::string> released = releasedBases(path, workspace);
  before.insert(before.end(), released.begin(), released.end());
  removeSegmentMaps(path, before, workspace);
  return {};
}

}  // namespace

Result<std::optional<FrameRelation>> relationInSession(const std::string& path, const std::string& from,
                                                       const std::string& to) {
  const auto text = sessionText(path);
  if (!text) return text.error();
  const auto session =
      sessionFromJson(*text, [](const SavedSeries&) { return std::shared_ptr<const Series>(); });
  if (!session) return Error{path + ": " + session.message()};
  return relationOf(session->workspace, from, to);
}

Result<OpenedSession> openSession(const std::string& path, const Progress& progress,
                                  const CancelToken& cancel) {
  const auto text = sessionText(path);
  if (!text) return text.error();
  // The file is checked completely before the search begins.
  std::vector<SavedSeries> all;
  const auto list = [&](const SavedSeries& saved) {
    all.push_back(saved);
    return std::shared_ptr<const Series>();
  };
  if (const auto right = sessionFromJson(*text, list); !right) return Error{path + ": " + right.message()};
  Search search(folderOf(path), all, progress, cancel);
  auto session = sessionFromJson(*text, std::ref(search),
                                 [&](const SavedObject& saved) { return search.findObject(saved); });
  if (cancel.cancelled()) return Error{path + ": interrupted."};
  if (!session) return Error{path + ": " + session.message()};
  for (const UnreadSteps& unread : session->unreadSteps)
    search.problems << problemOf(unread, session->workspace);
  Workspace workspace =
      withSegmentMaps(std::move(session->workspace), path, search.problems, progress, cancel);
  const bool areWhole = session->unreadSteps.empty() &&
                        std::ranges::none_of(workspace.segmentMaps,
                                             [](const SegmentMap& map) { return map.missing.has_value(); });
  const std::optional<Workspace> saved = workspaceIn(session->savedAs, workspace, search);
  HandWork exported = workOf(session->exported, workspace);
  return OpenedSession{std::move(workspace), session->savedAs, search.studies(),
                       search.problems,      areWhole,         saved,
                       std::move(exported)};
}

Status saveSession(const std::string& path, const Workspace& workspace) {
  return writeSession(path, sessionToJson(workspace, folderOf(path)), workspace, LabelFiles::whole);
}

Status keepSession(const std::string& path, const Workspace& workspace, const std::string& savedAs,
                   const HandWork& saved) {
  const auto text =
      sessionToJson(workspace, folderOf(path), savedAs, patientsOf(workspace), exportedOf(workspace, saved));
  return writeSession(path, text, workspace, LabelFiles::changes);
}

}  // namespace volumen
