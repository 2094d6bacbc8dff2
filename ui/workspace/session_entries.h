#pragma once

#include <string>
#include <vector>

#include "ui/workspace/session_json.h"

namespace volumen {

/// The curve of a curved reformat.
struct SavedCurve {
  std::string name;
  CurvedRecipe recipe;
};

/// A series of a session: how to find it again, and its state.
struct SeriesEntry {
  SavedSeries saved;                ///< the series itself, or the source of a curved reformat
  std::optional<SavedCurve> curve;  ///< for a curved reformat; empty: the series is one of files
  SeriesState state;
};

/// Returns a path relative to a folder.
std::string relativeTo(const std::string& folder, const std::string& path);

/// Names the objects in use by paths under which they are found another day (lastingPath).
Workspace withLastingObjects(Workspace workspace);

/// Returns the entry of a series in a session that is stored in `folder`.
SeriesEntry entryOf(const SeriesState& state, const std::string& folder);

/// Returns the state of a series in a session: of the series that is found, else as missing.
SeriesState stateOf(SeriesEntry entry, const FindSeries& find);

/// Gives the objects in use that are found their present paths. `listed` are the session's entries for them,
/// with paths relative to it.
Workspace withObjectsFound(Workspace workspace, const std::vector<SavedObject>& listed,
                           const FindObject& find);

}  // namespace volumen
