#include "ui/workspace/session_entries.h"

#include <algorithm>
#include <filesystem>

#include "io/curved.h"
#include "io/zip_archive.h"
#include "ui/workspace/moved.h"

namespace volumen {

std::string relativeTo(const std::string& folder, const std::string& path) {
  return std::filesystem::path(path).lexically_relative(folder).string();
}

SeriesEntry entryOf(const SeriesState& state, const std::string& folder) {
  const Series& series = sourceOf(*state.series);
  const MissingSeries known = state.missing.value_or(MissingSeries{proofOf(series), foldersOf(series)});
  SeriesEntry entry{{series, {}, known.folders, known.proof}, {}, state};
  if (const auto& curved = state.series->curved) entry.curve = {curved->name, curved->recipe};
  if (series.format == "phantom") return entry;
  std::string& path = entry.saved.series.path;
  path = lastingPath(path);
  entry.saved.relativePath = relativeTo(folder, path);
  return entry;
}

Workspace withLastingObjects(Workspace workspace) {
  for (const UsedObject& used : derivedObjectsOf(workspace)) {
    const std::string path = lastingPath(used.key.path);
    if (path != used.key.path)
      workspace = withObjectMoved(std::move(workspace), used.key, {path, used.key.id});
  }
  return workspace;
}

Workspace withObjectsFound(Workspace workspace, const std::vector<SavedObject>& listed,
                           const FindObject& find) {
  for (const UsedObject& used : derivedObjectsOf(workspace)) {
    SavedObject saved{used.key, {}, used.kind};
    const auto entry = std::ranges::find(listed, used.key, &SavedObject::key);
    if (entry != listed.end()) saved.relativePath = entry->relativePath;
    if (const auto found = find(saved)) workspace = withObjectMoved(std::move(workspace), used.key, *found);
  }
  return workspace;
}

SeriesState stateOf(SeriesEntry entry, const FindSeries& find) {
  entry.saved.series.acquired = entry.saved.proof.geometry;
  entry.saved.series.valueType = entry.saved.proof.valueType;
  const auto along = [&](const Series& source) {
    return entry.curve ? curvedSeries(source, entry.curve->recipe, entry.curve->name) : source;
  };
  if (const auto found = find ? find(entry.saved) : nullptr)
    if (Result<Series> series = along(*found)) {
      entry.state.series = std::make_shared<const Series>(std::move(*series));
      return entry.state;
    }
  entry.state.missing = {entry.saved.proof, entry.saved.folders};
  const Result<Series> series = along(entry.saved.series);
  entry.state.series = std::make_shared<const Series>(series ? *series : entry.saved.series);
  return entry.state;
}

}  // namespace volumen
