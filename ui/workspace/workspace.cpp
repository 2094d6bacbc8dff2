#include "ui/workspace/workspace.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ui/workspace/flat_plane.h"

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

bool isOfSlices(ViewKind kind) { return kind != ViewKind::volume && kind != ViewKind::frames; }

// The group's view of the plane that its slices were acquired in.
ViewId acquiredViewOf(const Workspace& workspace) {
  const Series* series = seriesIn(workspace, axialViewId);
  const ViewKind kind = series ? acquiredKind(series->acquired) : ViewKind::axial;
  return kind == ViewKind::coronal    ? coronalViewId
         : kind == ViewKind::sagittal ? sagittalViewId
                                      : axialViewId;
}

ViewKind firstKind(ViewId id) {
  return id == sceneViewId      ? ViewKind::volume
         : id == coronalViewId  ? ViewKind::coronal
         : id == sagittalViewId ? ViewKind::sagittal
                                : ViewKind::axial;
}

// The slice of a series at its cursor; the one in the middle where there is none.
int sliceAtCursor(const Workspace& workspace, const Series& series) {
  const int last = series.acquired.size.z - 1;
  const auto crosshair = workspace.crosshairs.find(frameOfReference(series));
  if (crosshair == workspace.crosshairs.end()) return last / 2;
  return int(
      std::clamp(std::round(series.acquired.voxelFromPatient(crosshair->second.at).z), 0.0, double(last)));
}

// Slices again; the cursor goes to the frame that was shown.
void leaveFrames(Workspace& workspace, ViewId id) {
  ViewState& view = workspace.view(id);
  if (view.kind != ViewKind::frames) return;
  const Series* series = seriesIn(workspace, id);
  if (series && series->notVolume.empty() && series->acquired.calibrated) {
    const glm::dvec3 middle = glm::dvec3(series->acquired.size - 1) * 0.5;
    const auto [crosshair, isNew] = workspace.crosshairs.try_emplace(frameOfReference(*series));
    glm::dvec3& at = crosshair->second.at;
    glm::dvec3 pVoxel = isNew ? middle : series->acquired.voxelFromPatient(at);
    pVoxel.z = flatLookOf(view).frame;
    at = series->acquired.patientFromVoxel(pVoxel);
  }
  view.kind = firstKind(id);
  if (workspace.layout == Layout::one && workspace.focus == axialViewId) workspace.focus = sceneViewId;
}

// Whether it is the series that was closed, opened by whatever path.
bool isSame(const Series& closed, const Series& opened) {
  if (keyOf(closed) == keyOf(opened)) return true;
  return !opened.seriesUid.empty() && closed.seriesUid == opened.seriesUid &&
         !opened.sopInstanceUids.empty() && closed.sopInstanceUids == opened.sopInstanceUids;
}

// What was made on it before it was closed, where it was.
void takeBack(Workspace& workspace, const Series& series) {
  const auto closed = std::ranges::find_if(workspace.closed,
                                           [&](const ClosedSeries& c) { return isSame(*c.series, series); });
  if (closed == workspace.closed.end()) return;
  std::set<int> ids{0};
  for (const Measurement& m : workspace.measurements) ids.insert(m.id);
  for (Measurement& m : closed->measurements) {
    m.series = keyOf(series);
    if (ids.contains(m.id)) m.id = *ids.rbegin() + 1;
    ids.insert(m.id);
    workspace.measurements.push_back(std::move(m));
  }
  for (KeyImage& image : closed->keyImages) {
    image.series = keyOf(series);
    workspace.keyImages.push_back(std::move(image));
  }
  workspace.closed.erase(closed);
}

void remember(Workspace& workspace, const Series& series) {
  const auto [state, isNew] = workspace.series.try_emplace(keyOf(series));
  if (!isNew) return;
  state->second.series = std::make_shared<const Series>(series);
  takeBack(workspace, series);
}

void put(Workspace& workspace, ViewId id, const Series& series, const SceneLook& first) {
  ViewState& view = workspace.view(id);
  const bool wereFrames = view.kind == ViewKind::frames && view.series == keyOf(series);
  const bool another = view.series != keyOf(series) || wereFrames;
  leaveFrames(workspace, id);
  view.series = keyOf(series);
  if (another && !inGroup(id) && isOfSlices(view.kind)) view.kind = acquiredKind(series.acquired);
  if (wereFrames) makeWhole(view.flats[view.series]);
  if (view.kind == ViewKind::volume)
    view.scenes.try_emplace(view.series, first);
  else
    view.flats.try_emplace(view.series);
}

}  // namespace

Workspace::Workspace() : views(std::size_t(viewCount)) {
  for (ViewId id = 0; id < viewCount; ++id) view(id).kind = firstKind(id);
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
  const ViewId first = views.empty() ? workspace.focus : views.front();
  if (inGroup(first) && showsFrames(workspace, first)) return {axialViewId};
  if (views.empty()) return {workspace.focus};
  // Acquired slices come first.
  std::vector<ViewId> ordered = views;
  const auto flat = std::ranges::find(ordered, axialViewId);
  if (flat != ordered.end()) std::swap(*flat, *std::ranges::find(ordered, acquiredViewOf(workspace)));
  return ordered;
}

ViewId sceneViewOf(const Workspace& workspace) {
  if (workspace.view(workspace.focus).kind == ViewKind::volume) return workspace.focus;
  if (inGroup(workspace.focus)) return sceneViewId;
  for (const ViewId id : viewsOnScreen(workspace))
    if (workspace.view(id).kind == ViewKind::volume) return id;
  return sceneViewId;
}

const Series* seriesIn(const Workspace& workspace, ViewId view) {
  const auto state = workspace.series.find(workspace.view(view).series);
  return state == workspace.series.end() ? nullptr : state->second.series.get();
}

ViewId framesViewOf(ViewId view) { return inGroup(view) ? axialViewId : view; }

bool showsFrames(const Workspace& workspace, ViewId view) {
  return workspace.view(framesViewOf(view)).kind == ViewKind::frames;
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
  remember(workspace, series);
  workspace = withFound(std::move(workspace), series);
  if (!inGroup(view)) {
    put(workspace, view, series, first);
    return workspace;
  }
  for (ViewId id = 0; id < firstComparedId; ++id) put(workspace, id, series, first);
  return workspace;
}

std::vector<ViewId> planesOf(const Workspace& workspace, ViewId view) {
  std::vector<ViewId> planes;
  if (!inGroup(view) && workspace.view(view).kind != ViewKind::volume) planes.push_back(view);
  if (!inGroup(view)) return planes;
  for (ViewId id = 0; id < firstComparedId; ++id)
    if (workspace.view(id).kind != ViewKind::volume) planes.push_back(id);
  return planes;
}

Workspace withFlatLooks(Workspace workspace, ViewId view, const std::function<void(FlatLook&)>& change) {
  for (const ViewId id : planesOf(workspace, view)) {
    ViewState& state = workspace.view(id);
    if (!state.series.empty()) change(state.flats[state.series]);
  }
  return workspace;
}

Workspace withOverlay(Workspace workspace, ViewId view, const Series* overlay) {
  if (overlay) remember(workspace, *overlay);
  return withFlatLooks(std::move(workspace), view,
                       [&](FlatLook& look) { look.overlay = overlay ? keyOf(*overlay) : SeriesKey{}; });
}

Workspace fusedWith(Workspace workspace, const Series& under) {
  const SeriesKey over = workspace.view(sceneViewId).series;
  remember(workspace, under);
  for (const ViewId id : planesOf(workspace, axialViewId)) workspace.view(id).series = keyOf(under);
  return withFlatLooks(std::move(workspace), axialViewId, [&](FlatLook& look) { look.overlay = over; });
}

Layout usualLayout(const Series& series) {
  constexpr int fewest = 8;  // slices that make planes across them worth a look
  const glm::ivec3 n = series.acquired.size;
  return std::min({n.x, n.y, n.z}) < fewest ? Layout::one : Layout::planes;
}

Workspace withUsualLayout(Workspace workspace, const Series& series) {
  workspace = withLayout(std::move(workspace), usualLayout(series));
  if (workspace.layout == Layout::one && inGroup(workspace.focus))
    workspace.focus = acquiredViewOf(workspace);
  return workspace;
}

Workspace withSlicesInFocus(Workspace workspace) {
  const std::vector<ViewId> views = viewsOnScreen(workspace);
  const ViewId slices = acquiredViewOf(workspace);
  if (inGroup(workspace.focus) && std::ranges::find(views, slices) != views.end()) workspace.focus = slices;
  return workspace;
}

bool comparesSeries(Layout layout) { return layout == Layout::two || layout == Layout::four; }

void makeWhole(FlatLook& look) { look.panMm = {0, 0}, look.zoom = 1, look.slabMm = 0; }

Workspace withFrames(Workspace workspace, ViewId view, const Series& series) {
  remember(workspace, series);
  workspace = withFound(std::move(workspace), series);
  const ViewId shown = framesViewOf(view);
  const SeriesKey key = keyOf(series);
  ViewState& frames = workspace.view(shown);
  const bool wereSlices = frames.series == key && frames.kind != ViewKind::frames;
  for (ViewId id = 0; inGroup(view) && id < firstComparedId; ++id) workspace.view(id).series = key;
  frames.series = key;
  frames.kind = ViewKind::frames;
  FlatLook& look = frames.flats[key];
  if (wereSlices) makeWhole(look), look.frame = sliceAtCursor(workspace, series);
  if (workspace.focus == view || inGroup(workspace.focus)) workspace.focus = shown;
  return workspace;
}

Workspace withLayout(Workspace workspace, Layout layout) {
  const SeriesKey shown = workspace.view(workspace.focus).series;
  const bool asFrames = showsFrames(workspace, workspace.focus);
  workspace.layout = layout;
  const std::vector<ViewId> views = viewsOnScreen(workspace);
  if (std::ranges::find(views, workspace.focus) == views.end()) workspace.focus = views.front();
  ViewState& first = workspace.view(views.front());
  if (first.series.empty()) {
    first.series = shown;
    first.flats.try_emplace(shown);
    const Series* series = seriesIn(workspace, views.front());
    first.kind =
        series && !inGroup(views.front()) ? acquiredKind(series->acquired) : firstKind(views.front());
    if (asFrames) first.kind = ViewKind::frames;
  }
  return workspace;
}

bool canChangeKind(ViewId view) { return !inGroup(view); }

Workspace withKind(Workspace workspace, ViewId view, ViewKind kind, const SceneLook& first) {
  ViewState& state = workspace.view(view);
  if (!canChangeKind(view) || state.series.empty()) return workspace;
  leaveFrames(workspace, view);
  state.kind = kind;
  if (kind == ViewKind::volume)
    state.scenes.try_emplace(state.series, first);
  else
    state.flats.try_emplace(state.series);
  return workspace;
}

Workspace without(Workspace workspace, const SeriesKey& key) {
  ClosedSeries closed;
  if (const auto state = workspace.series.find(key); state != workspace.series.end())
    closed.series = state->second.series;
  const auto move = [&](auto& from, auto& to) {
    for (const auto& made : from)
      if (made.series == key) to.push_back(made);
    std::erase_if(from, [&](const auto& made) { return made.series == key; });
  };
  move(workspace.measurements, closed.measurements);
  move(workspace.keyImages, closed.keyImages);
  if (std::ranges::find(closed.measurements, workspace.selected, &Measurement::id) !=
      closed.measurements.end())
    workspace.selected = 0;
  if (closed.series && (!closed.measurements.empty() || !closed.keyImages.empty()))
    workspace.closed.push_back(std::move(closed));
  for (ViewId id = 0; id < viewCount; ++id) {
    ViewState& view = workspace.view(id);
    if (view.series == key) {
      leaveFrames(workspace, id);
      view.kind = firstKind(id);
      view.series = {};
    }
    view.scenes.erase(key);
    view.flats.erase(key);
    for (auto& [series, look] : view.flats)
      if (look.overlay == key) look.overlay = {};
  }
  workspace.series.erase(key);
  return workspace;
}

Workspace withClosed(Workspace workspace) {
  while (!workspace.closed.empty()) {
    const Series series = *workspace.closed.front().series;
    workspace.unlisted.series.erase(keyOf(series));
    if (workspace.series.contains(keyOf(series)))
      takeBack(workspace, series);
    else
      remember(workspace, series);
  }
  return workspace;
}

Workspace replacedBy(Workspace workspace, Workspace next) {
  const std::map<SeriesKey, SeriesState> before = workspace.series;
  for (const auto& [key, state] : before)
    if (!next.series.contains(key)) workspace = without(std::move(workspace), key);
  next.closed = std::move(workspace.closed);
  next.unlisted = std::move(workspace.unlisted);
  for (const auto& [key, state] : next.series) next.unlisted.series.erase(key);
  return next;
}

}  // namespace volumen
