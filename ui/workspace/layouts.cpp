#include <algorithm>
#include <iterator>
#include <numeric>

#include "ui/workspace/flat_plane.h"
#include "ui/workspace/workspace.h"

namespace volumen {

namespace {

struct LayoutEntry {
  Layout layout;
  std::string name;
  std::vector<ViewId> views;  // empty: the view in focus
};

std::vector<ViewId> cellsFrom(ViewId first, Layout grid) {
  std::vector<ViewId> views(std::size_t(grid.rows * grid.columns));
  std::iota(views.begin(), views.end(), first);
  return views;
}

LayoutEntry gridEntry(int rows, int columns) {
  const Layout layout{Layout::Kind::grid, rows, columns};
  const std::string name = layout == Layout::two    ? "two"
                           : layout == Layout::four ? "four"
                                                    : std::to_string(rows) + "x" + std::to_string(columns);
  return {layout, name, cellsFrom(firstComparedId, layout)};
}

std::vector<LayoutEntry> layoutTable() {
  std::vector<LayoutEntry> table{
      {Layout::one, "one", {}},
      {Layout::planes, "planes", {axialViewId, sagittalViewId, coronalViewId, sceneViewId}},
      {Layout::besidePlanes, "besidePlanes", {sceneViewId, axialViewId, coronalViewId, sagittalViewId}}};
  for (int rows = 1; rows <= Layout::mostRows; ++rows)
    for (int columns = 1; columns <= Layout::mostColumns; ++columns)
      table.push_back(gridEntry(rows, columns));
  return table;
}

const std::vector<LayoutEntry>& layouts() {
  static const std::vector<LayoutEntry> table = layoutTable();
  return table;
}

// Returns the group's view of the plane of acquisition.
ViewId acquiredViewOf(const Workspace& workspace) {
  const Series* series = seriesIn(workspace, axialViewId);
  const ViewKind kind = series ? acquiredKind(series->acquired) : ViewKind::axial;
  ViewId id = axialViewId;
  while (usualKind(id) != kind) ++id;
  return id;
}

}  // namespace

const std::vector<Layout>& allLayouts() {
  static const std::vector<Layout> all = [] {
    std::vector<Layout> every;
    for (const LayoutEntry& entry : layouts()) every.push_back(entry.layout);
    return every;
  }();
  return all;
}

const char* layoutName(Layout layout) {
  return std::ranges::find(layouts(), layout, &LayoutEntry::layout)->name.c_str();
}

std::optional<Layout> layoutNamed(const std::string& name) {
  for (const LayoutEntry& entry : layouts())
    if (name == entry.name) return entry.layout;
  return {};
}

std::vector<ViewId> viewsInMain(const Workspace& workspace) {
  const auto& views = std::ranges::find(layouts(), workspace.layout, &LayoutEntry::layout)->views;
  const ViewId first = views.empty() ? mainFocusOf(workspace) : views.front();
  if (first < firstComparedId && showsFrames(workspace, first)) return {axialViewId};
  if (views.empty()) return {first};
  // Acquired slices come first.
  std::vector<ViewId> ordered = views;
  const auto flat = std::ranges::find(ordered, axialViewId);
  if (flat != ordered.end()) std::swap(*flat, *std::ranges::find(ordered, acquiredViewOf(workspace)));
  return ordered;
}

std::vector<ViewId> viewsInSecond(const Workspace& workspace) {
  const SecondWindow& second = workspace.second;
  return second.shown ? cellsFrom(firstSecondId, second.layout) : std::vector<ViewId>();
}

std::vector<ViewId> viewsBeside(const Workspace& workspace, ViewId view) {
  return isInSecond(view) ? viewsInSecond(workspace) : viewsInMain(workspace);
}

std::vector<ViewId> viewsOnScreen(const Workspace& workspace) {
  std::vector<ViewId> views = viewsInMain(workspace);
  std::ranges::copy(viewsInSecond(workspace), std::back_inserter(views));
  return views;
}

std::vector<SeriesKey> seriesIn3d(const Workspace& workspace) {
  std::vector<SeriesKey> all;
  for (const ViewId id : viewsOnScreen(workspace)) {
    const ViewState& view = workspace.view(id);
    if (showsScene(view.kind) && std::ranges::find(all, view.series) == all.end()) all.push_back(view.series);
  }
  return all;
}

std::vector<ViewId> focusFirst(const Workspace& workspace, std::vector<ViewId> views) {
  std::stable_partition(views.begin(), views.end(), [&](ViewId id) { return id == workspace.focus; });
  return views;
}

Layout layoutOf(const Workspace& workspace, ViewId view) {
  return isInSecond(view) ? workspace.second.layout : workspace.layout;
}

ViewId mainFocusOf(const Workspace& workspace) {
  return isInSecond(workspace.focus) ? workspace.second.mainFocus : workspace.focus;
}

Workspace withFocus(Workspace workspace, ViewId view) {
  workspace.second.mainFocus = isInSecond(view) ? mainFocusOf(workspace) : SecondWindow().mainFocus;
  workspace.focus = view;
  return workspace;
}

Workspace withFocusOf(Workspace workspace, const Workspace& other) {
  workspace.focus = other.focus;
  workspace.second.mainFocus = other.second.mainFocus;
  return workspace;
}

Workspace withSecondLayout(Workspace workspace, Layout layout) {
  workspace.second.layout = comparesSeries(layout) ? layout : SecondWindow().layout;
  const std::vector<ViewId> views = viewsInSecond(workspace);
  const bool isLost = isInSecond(workspace.focus) && std::ranges::find(views, workspace.focus) == views.end();
  return isLost ? withFocus(std::move(workspace), firstSecondId) : workspace;
}

Workspace withSecondShown(Workspace workspace, bool shown) {
  workspace.second.shown = shown;
  if (shown) return withFocus(std::move(workspace), firstSecondId);
  const ViewId focus = mainFocusOf(workspace);
  return withFocus(std::move(workspace), focus);
}

Layout usualLayout(const Series& series) {
  constexpr int fewest = 8;  // fewest slices for which reformatted planes are useful
  const glm::ivec3 n = series.acquired.size;
  return std::min({n.x, n.y, n.z}) < fewest ? Layout::one : Layout::planes;
}

Workspace withUsualLayout(Workspace workspace, const Series& series) {
  workspace = withLayout(std::move(workspace), usualLayout(series));
  if (workspace.layout == Layout::one && workspace.focus < firstComparedId)
    workspace.focus = acquiredViewOf(workspace);
  return workspace;
}

Workspace withSlicesInFocus(Workspace workspace) {
  const std::vector<ViewId> views = viewsInMain(workspace);
  const ViewId slices = acquiredViewOf(workspace);
  if (workspace.focus < firstComparedId && std::ranges::find(views, slices) != views.end())
    workspace.focus = slices;
  return workspace;
}

bool comparesSeries(Layout layout) { return layout.kind == Layout::Kind::grid; }

}  // namespace volumen
