#pragma once

#include "ui/workspace/workspace.h"

namespace volumen {

/// With a series, all that is shown of it and all that was made on it under another key: it was found
/// elsewhere. Nothing changes where the workspace does not know it.
Workspace withSeriesMoved(Workspace workspace, const SeriesKey& from, const Series& to);

/// The same for an object that refers to pictures.
Workspace withObjectMoved(Workspace workspace, const DerivedKey& from, const DerivedKey& to);

/// An object that refers to pictures and is in use, and what it is.
struct UsedObject {
  DerivedKey key;
  DerivedKind kind = DerivedKind::presentation;
  bool operator==(const UsedObject&) const = default;
};

/// The presentation states that pictures are shown by, and the structure sets and segmentations over views;
/// each once.
std::vector<UsedObject> derivedObjectsOf(const Workspace& workspace);

}  // namespace volumen
