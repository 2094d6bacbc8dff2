#pragma once

#include "tests/fixtures/fixtures.h"
#include "tests/ui/journey.h"
#include "ui/workspace/flat_plane.h"

namespace volumen::tests {

/// Series open in the usual layout of their modality while it lives.
struct UsualLayouts {
  UsualLayouts() { openAlone(false); }
  ~UsualLayouts() { openAlone(); }
};

/// "ct", "pet": of one study.
inline QString fusedFolder(const char* name) {
  return QString::fromStdString(dataPath(std::string("pet-ct/sts019-") + name));
}

/// A window that says what of a PET and a CT it shows.
struct PetCtWindow : Journey {
  using Journey::Journey;

  const Workspace& workspace() { return window.session().workspace(); }
  const FlatLook look(ViewId id) { return flatLookOf(workspace().view(id)); }
  std::string modality(const SeriesKey& key) {
    return key.empty() ? "" : workspace().series.at(key).series->modality;
  }
  /// The PET in 3D, and in all planes over the CT.
  bool isFused() {
    const auto hasBoth = [this](ViewId id) {
      return modality(workspace().view(id).series) == "CT" && modality(look(id).overlay) == "PT";
    };
    return modality(workspace().view(sceneViewId).series) == "PT" && hasBoth(axialViewId) &&
           hasBoth(coronalViewId) && hasBoth(sagittalViewId);
  }
};

}  // namespace volumen::tests
