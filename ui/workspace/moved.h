#pragma once

#include "ui/workspace/workspace.h"

namespace volumen {

/// Moves a series that was found elsewhere to its new key, with everything shown of it and made on it. Does
/// nothing if the workspace does not know the series.
Workspace withSeriesMoved(Workspace workspace, const SeriesKey& from, const Series& to);

/// Does the same for an object that refers to pictures.
Workspace withObjectMoved(Workspace workspace, const DerivedKey& from, const DerivedKey& to);

/// An object in use that refers to pictures, and its kind.
struct UsedObject {
  DerivedKey key;
  DerivedKind kind = DerivedKind::presentation;
  bool operator==(const UsedObject&) const = default;
};

/// Returns the presentation states in use, and the structure sets and segmentations over views, each once.
std::vector<UsedObject> derivedObjectsOf(const Workspace& workspace);

}  // namespace volumen
