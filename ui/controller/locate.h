#pragma once

#include <QStringList>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "io/study/progress.h"
#include "ui/workspace/session_json.h"
#include "viewer/volume/cancel.h"

namespace volumen {

struct Study;

/// Objects of a workspace that were not found.
struct MissingObjects {
  std::vector<SavedSeries> series;
  std::vector<SavedObject> derived;

  bool empty() const { return series.empty() && derived.empty(); }
};

/// Returns the missing objects. `open` are the open objects that refer to pictures.
MissingObjects missingOf(const Workspace& workspace, const std::vector<DerivedObjectPtr>& open);

/// The objects found in a folder.
struct Located {
  std::string folder;
  std::shared_ptr<const Study> study;  ///< everything in the folder
  std::vector<std::pair<SeriesKey, Series>> series;
  std::vector<std::pair<DerivedKey, DerivedKey>> derived;
  QStringList problems;  ///< a sentence for each object not found there
};

/// Searches for the missing objects in a folder and its subfolders. The Error names the folder.
Result<Located> locate(const MissingObjects& missing, const std::string& folder,
                       const Progress& progress = {}, const CancelToken& cancel = {});

/// Returns the workspace with the found objects in place of the missing ones.
Workspace withLocated(Workspace workspace, const Located& located);

}  // namespace volumen
