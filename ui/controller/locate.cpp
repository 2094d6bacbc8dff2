#include "ui/controller/locate.h"

#include <QFileInfo>
#include <algorithm>

#include "io/curved.h"
#include "io/paths/open_path.h"
#include "results/text/text.h"
#include "ui/controller/find_saved.h"
#include "ui/data/picture_stacks.h"
#include "ui/workspace/moved.h"

namespace volumen {

MissingObjects missingOf(const Workspace& workspace, const std::vector<DerivedObjectPtr>& open) {
  MissingObjects missing;
  for (const auto& [key, state] : workspace.series)
    if (state.missing)
      missing.series.push_back({*state.series, {}, state.missing->folders, state.missing->proof});
  for (const UsedObject& used : derivedObjectsOf(workspace)) {
    const auto isIt = [&](const DerivedObjectPtr& object) { return keyOf(*object) == used.key; };
    if (std::ranges::none_of(open, isIt)) missing.derived.push_back({used.key, {}, used.kind});
  }
  return missing;
}

Result<Located> locate(const MissingObjects& missing, const std::string& folder, const Progress& progress,
                       const CancelToken& cancel) {
  Result<Study> study = openPath(folder, progress, cancel);
  if (!study) return study.error();
  const std::vector<Series> all = allSeriesOf(*study);
  Located located{folder, std::make_shared<const Study>(withPictureStacks(std::move(*study))), {}, {}, {}};
  const auto tellMissing = [&](const QString& name) {
    located.problems << tr("%1 was not found in %2.").arg(name, pathText(folder));
  };
  for (const SavedSeries& saved : missing.series)
    if (const Series* found = findSaved(all, saved)) {
      if (const Result<Series> made = madeLike(saved.series, *found))
        located.series.emplace_back(keyOf(saved.series), *made);
      else
        located.problems << tr("%1 cannot be laid out along its curve: %2")
                                .arg(seriesText(saved.series), QString::fromStdString(made.message()));
    } else {
      tellMissing(seriesText(saved.series));
    }
  for (const SavedObject& saved : missing.derived)
    if (const DerivedObject* found = findSaved(*located.study, saved))
      located.derived.emplace_back(saved.key, keyOf(*found));
    else
      tellMissing(QFileInfo(pathText(saved.key.path)).fileName());
  located.problems.removeDuplicates();
  return located;
}

Workspace withLocated(Workspace workspace, const Located& located) {
  for (const auto& [from, to] : located.series) workspace = withSeriesMoved(std::move(workspace), from, to);
  for (const auto& [from, to] : located.derived) workspace = withObjectMoved(std::move(workspace), from, to);
  return workspace;
}

}  // namespace volumen
