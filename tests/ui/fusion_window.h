#pragma once

#include "tests/fixtures/fixtures.h"
#include "tests/ui/journey.h"
#include "ui/workspace/flat_plane.h"

namespace volumen::tests {

/// Lets series open in the usual layout of their modality while it lives.
struct UsualLayouts {
  UsualLayouts() { openAlone(false); }
  ~UsualLayouts() { openAlone(); }
};

/// Returns the folder of "ct" or "pet" of one study.
inline QString fusedFolder(const char* name) {
  return QString::fromStdString(dataPath(std::string("pet-ct/sts019-") + name));
}

/// A window that tells which views show the PET and the CT.
struct PetCtWindow : Journey {
  using Journey::Journey;

  const Workspace& workspace() { return window.session().workspace(); }
  const FlatLook look(ViewId id) { return flatLookOf(workspace().view(id)); }
  std::string modality(const SeriesKey& key) {
    return key.empty() ? "" : workspace().series.at(key).series->modality;
  }
  /// Returns whether the PET is in 3D and over the CT in all planes.
  bool isFused() {
    const auto hasBoth = [this](ViewId id) {
      return modality(workspace().view(id).series) == "CT" && modality(look(id).overlay) == "PT";
    };
    return modality(workspace().view(sceneViewId).series) == "PT" && hasBoth(axialViewId) &&
           hasBoth(coronalViewId) && hasBoth(sagittalViewId);
  }
};

}  // namespace volumen::tests
