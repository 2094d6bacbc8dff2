#include "ui/workspace/workspace.h"

#include <algorithm>
#include <array>

namespace volumen {

namespace {

struct LayoutEntry {
  Layout layout;
  const char* name;
  std::vector<ViewId> views;  // empty: the one in focus
};

const std::vector<LayoutEntry>& layouts() {
  static const std::vector<LayoutEntry> table{
      {Layout::one, "one", {}},
      {Layout::planes, "planes", {axialViewId, sagittalViewId, coronalViewId, sceneViewId}},
      {Layout::besidePlanes, "besidePlanes", {sceneViewId, axialViewId, coronalViewId, sagittalViewId}},
      {Layout::two, "two", {firstComparedId, firstComparedId + 1}},
      {Layout::four,
       "four",
       {firstComparedId, firstComparedId + 1, firstComparedId + 2, firstComparedId + 3}},
  };
  return table;
}

bool inGroup(ViewId view) { return view < firstComparedId; }

void put(Workspace& workspace, ViewId id, const Series& series, const SceneLook& first) {
  ViewState& view = workspace.view(id);
  view.series = keyOf(series);
  if (view.kind == ViewKind::volume)
    view.scenes.try_emplace(view.series, first);
  else
    view.flats.try_emplace(view.series);
}

}  // namespace

Workspace::Workspace() : views(std::size_t(viewCount)) {
  view(axialViewId).kind = ViewKind::axial;
  view(coronalViewId).kind = ViewKind::coronal;
  view(sagittalViewId).kind = ViewKind::sagittal;
  for (ViewId id = firstComparedId; id < viewCount; ++id) view(id).kind = ViewKind::axial;
}

const char* layoutName(Layout layout) {
  return std::ranges::find(layouts(), layout, &LayoutEntry::layout)->name;
}

std::optional<Layout> layoutNamed(const std::string& name) {
  for (const LayoutEntry& entry : layouts())
    if (name == entry.name) return entry.layout;
  return {};
}

std::vector<ViewId> viewsOnScreen(const Workspace& workspace) {
  const auto& views = std::ranges::find(layouts(), workspace.layout, &LayoutEntry::layout)->views;
  return views.empty() ? std::vector{workspace.focus} : views;
}

ViewId sceneViewOf(const Workspace& workspace) {
  if (workspace.view(workspace.focus).kind == ViewKind::volume) return workspace.focus;
  if (inGroup(workspace.focus)) return sceneViewId;
  for (const ViewId id : viewsOnScreen(workspace))
    if (workspace.view(id).kind == ViewKind::volume) return id;
  return sceneViewId;
}

FlatLook flatLookOf(const ViewState& view) {
  const auto look = view.flats.find(view.series);
  return look == view.flats.end() ? FlatLook{} : look->second;
}

std::string frameOfReference(const Series& series) {
  return series.frameOfReferenceUid.empty() ? series.path + '\n' + series.id : series.frameOfReferenceUid;
}

Workspace withFound(Workspace workspace, const Series& series) {
  const auto state = workspace.series.find(keyOf(series));
  if (state == workspace.series.end() || !state->second.missing) return workspace;
  state->second.series = std::make_shared<const Series>(series);
  state->second.missing.reset();
  return workspace;
}

Workspace withSeries(Workspace workspace, ViewId view, const Series& series, const SceneLook& first) {
  const auto [state, isNew] = workspace.series.try_emplace(keyOf(series));
  if (isNew) state->second.series = std::make_shared<const Series>(series);
  workspace = withFound(std::move(workspace), series);
  if (!inGroup(view)) {
    put(workspace, view, series, first);
    return workspace;
  }
  for (ViewId id = 0; id < firstComparedId; ++id) put(workspace, id, series, first);
  return workspace;
}

Workspace withLayout(Workspace workspace, Layout layout) {
  const SeriesKey shown = workspace.view(workspace.focus).series;
  workspace.layout = layout;
  const std::vector<ViewId> views = viewsOnScreen(workspace);
  if (std::ranges::find(views, workspace.focus) == views.end()) workspace.focus = views.front();
  ViewState& first = workspace.view(views.front());
  if (first.series.empty()) {
    first.series = shown;
    first.flats.try_emplace(shown);
  }
  return workspace;
}

Workspace without(Workspace workspace, const SeriesKey& key) {
  workspace.series.erase(key);
  for (ViewState& view : workspace.views) {
    if (view.series == key) view.series = {};
    view.scenes.erase(key);
    view.flats.erase(key);
  }
  return workspace;
}

}  // namespace volumen
