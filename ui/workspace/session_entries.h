#pragma once

#include <string>
#include <vector>

#include "ui/workspace/session_json.h"

namespace volumen {

/// How a series lies along a curve.
struct SavedCurve {
  std::string name;
  CurvedRecipe recipe;
};

/// A series of a session: what finds it again, and its state.
struct SeriesEntry {
  SavedSeries saved;                ///< of one along a curve: its source
  std::optional<SavedCurve> curve;  ///< that it lies along; none: it is one of files
  SeriesState state;
};

/// A path as it is told from a folder.
std::string relativeTo(const std::string& folder, const std::string& path);

/// With the objects in use named by paths under which they are found another day (lastingPath).
Workspace withLastingObjects(Workspace workspace);

/// How a session that is to lie in `folder` names a series.
SeriesEntry entryOf(const SeriesState& state, const std::string& folder);

/// The state of a series that a session names: of the one that is found, else as missing.
SeriesState stateOf(SeriesEntry entry, const FindSeries& find);

/// With the objects in use that are found where they are now. `listed`: what the session says of their places
/// beside it.
Workspace withObjectsFound(Workspace workspace, const std::vector<SavedObject>& listed,
                           const FindObject& find);

}  // namespace volumen
