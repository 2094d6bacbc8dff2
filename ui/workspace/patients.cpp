#include "ui/workspace/patients.h"

#include <algorithm>

#include "results/series/series_facts.h"

namespace volumen {

namespace {

bool namesPatient(const Series& series) {
  return series.format == "DICOM" || !series.patientName.empty() || !series.patientId.empty();
}

// Returns the series in a view and its overlay.
std::vector<const Series*> picturesIn(const Workspace& workspace, ViewId view) {
  std::vector<const Series*> found{seriesIn(workspace, view)};
  const auto overlay = workspace.series.find(flatLookOf(workspace.view(view)).overlay);
  if (overlay != workspace.series.end()) found.push_back(overlay->second.series.get());
  std::erase(found, nullptr);
  return found;
}

}  // namespace

std::vector<const Series*> patientsOnScreen(const Workspace& workspace) {
  std::vector<const Series*> patients;
  for (const ViewId view : viewsOnScreen(workspace))
    for (const Series* series : picturesIn(workspace, view)) {
      const auto isSame = [&](const Series* other) { return areOfOnePatient(*series, *other); };
      if (namesPatient(*series) && std::ranges::none_of(patients, isSame)) patients.push_back(series);
    }
  return patients;
}

Workspace withoutOtherPatients(Workspace workspace, const Series& series) {
  for (ViewId id = 0; id < viewCount; ++id) {
    const std::vector<const Series*> shown = picturesIn(workspace, id);
    if (std::ranges::all_of(shown, [&](const Series* other) { return areOfOnePatient(*other, series); }))
      continue;
    ViewState& view = workspace.editView(id);
    view.series = {};
    if (showsFrames(view.kind) || id >= firstComparedId) view.kind = usualKind(id);
  }
  const bool isGroup = workspace.focus < firstComparedId;
  if (isGroup && workspace.view(workspace.focus).series.empty()) workspace.focus = sceneViewId;
  return workspace;
}

}  // namespace volumen
