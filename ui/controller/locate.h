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

/// What a workspace shows and that was not found.
struct MissingObjects {
  std::vector<SavedSeries> series;
  std::vector<SavedObject> derived;

  bool empty() const { return series.empty() && derived.empty(); }
};

/// `open`: the objects that refer to pictures and are open.
MissingObjects missingOf(const Workspace& workspace, const std::vector<DerivedObjectPtr>& open);

/// What was found of it in a folder.
struct Located {
  std::string folder;
  std::shared_ptr<const Study> study;  ///< all that it holds
  std::vector<std::pair<SeriesKey, Series>> series;
  std::vector<std::pair<DerivedKey, DerivedKey>> derived;
  QStringList problems;  ///< a sentence for each that was not found there
};

/// Looks for all of it in a folder and below. The Error names the folder.
Result<Located> locate(const MissingObjects& missing, const std::string& folder,
                       const Progress& progress = {}, const CancelToken& cancel = {});

/// With what was found in its place.
Workspace withLocated(Workspace workspace, const Located& located);

}  // namespace volumen
