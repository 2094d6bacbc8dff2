#include "ui/workspace/workspace.h"

#include <algorithm>
#include <cmath>

#include "io/curved.h"
#include "results/segments/segment_record.h"
#include "results/series/time_points.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/series_segments.h"

namespace volumen {

namespace {

bool inGroup(ViewId view) { return view < firstComparedId; }

ViewId& editMainFocus(Workspace& workspace) {
  return isInSecond(workspace.focus) ? workspace.second.mainFocus : workspace.focus;
}

// Returns the slice of a series at its cursor; the middle one without a cursor.
int sliceAtCursor(const Workspace& workspace, const Series& series) {
  const int last = series.acquired.size.z - 1;
  const auto crosshair = workspace.crosshairs.find(frameOfReference(series));
  if (crosshair == workspace.crosshairs.end()) return last / 2;
  return int(
      std::clamp(std::round(series.acquired.voxelFromPatient(crosshair->second.at).z), 0.0, double(last)));
}

// Returns to slices. The cursor goes to the frame that was shown.
void leaveFrames(Workspace& workspace, ViewId id) {
  if (!showsFrames(workspace.view(id).kind)) return;
  ViewState& view = workspace.editView(id);
  const Series* series = seriesIn(workspace, id);
  if (series && series->notVolume.empty() && series->acquired.calibrated) {
    const glm::dvec3 middle = glm::dvec3(series->acquired.size - 1) * 0.5;
    const bool isNew = workspace.crosshairs.add(frameOfReference(*series), {});
    glm::dvec3& at = workspace.crosshairs.edit(frameOfReference(*series)).at;
    glm::dvec3 pVoxel = isNew ? middle : series->acquired.voxelFromPatient(at);
    pVoxel.z = flatLookOf(view).frame;
    at = series->acquired.patientFromVoxel(pVoxel);
  }
  view.kind = usualKind(id);
  ViewId& focus = editMainFocus(workspace);
  if (workspace.layout == Layout::one && focus == axialViewId) focus = sceneViewId;
}

// Returns whether it is the closed series, opened by any path.
bool isSame(const Series& closed, const Series& opened) {
  if (keyOf(closed) == keyOf(opened)) return true;
  return !opened.seriesUid.empty() && closed.seriesUid == opened.seriesUid &&
         !opened.sopInstanceUids.empty() && closed.sopInstanceUids == opened.sopInstanceUids;
}

// Restores the work on a series from before it was closed, if it was.
void takeBack(Workspace& workspace, const Series& series) {
  const auto isIt = [&](const ClosedSeries& c) { return isSame(*c.series, series); };
  const auto found = std::ranges::find_if(workspace.closed, isIt);
  if (found == workspace.closed.end()) return;
  const ClosedSeries closed = *found;
  std::set<int> ids{0};
  for (const Measurement& m : workspace.measurements) ids.insert(m.id);
  for (Measurement m : closed.measurements) {
    m.series = keyOf(series);
    if (ids.contains(m.id)) m.id = *ids.rbegin() + 1;
    ids.insert(m.id);
    workspace.measurements.push_back(std::move(m));
  }
  for (KeyImage image : closed.keyImages) {
    image.series = keyOf(series);
    workspace.keyImages.push_back(std::move(image));
  }
  for (const SegmentMap& map : closed.segmentMaps)
    workspace.segmentMaps.push_back(asMapOf(workspace, keyOf(series), map));
  workspace.closed.erase(found);
}

void remember(Workspace& workspace, const Series& series) {
  if (workspace.series.contains(keyOf(series))) return;
  workspace.series.editOrAdd(keyOf(series)).series = std::make_shared<const Series>(series);
  takeBack(workspace, series);
}

// Removes a series from a view, which becomes empty if it shows it.
void leaveSeries(Workspace& workspace, ViewId id, const SeriesKey& key) {
  ViewState& view = workspace.editView(id);
  if (view.series == key) {
    leaveFrames(workspace, id);
    view.kind = usualKind(id);
    view.series = {};
  }
  view.scenes.erase(key);
  view.flats.erase(key);
  view.flats.editIf([&](const auto& entry) { return entry.second.overlay == key; },
                    [](FlatLook& look) { look.overlay = {}; });
}

void put(Workspace& workspace, ViewId id, const Series& series, const SceneLook& first) {
  ViewState& view = workspace.editView(id);
  const bool wereFrames = showsFrames(view.kind) && view.series == keyOf(series);
  const bool another = view.series != keyOf(series) || wereFrames;
  leaveFrames(workspace, id);
  view.series = keyOf(series);
  view.wanted.clear();
  if (another && !inGroup(id) && showsSlices(view.kind)) view.kind = acquiredKind(series.acquired);
  if (wereFrames) makeWhole(view.flats.editOrAdd(view.series));
  if (showsScene(view.kind))
    view.scenes.add(view.series, first);
  else
    view.flats.add(view.series, {});
}

}  // namespace

Workspace::Workspace() : views(std::size_t(viewCount)) {
  for (ViewId id = 0; id < viewCount; ++id) editView(id).kind = usualKind(id);
}

ViewKind usualKind(ViewId view) {
  constexpr ViewKind ofGroup[] = {ViewKind::volume, ViewKind::axial, ViewKind::coronal, ViewKind::sagittal};
  return inGroup(view) ? ofGroup[view] : ViewKind::axial;
}

ViewId sceneViewOf(const Workspace& workspace) {
  if (showsScene(workspace.view(workspace.focus).kind)) return workspace.focus;
  if (inGroup(workspace.focus)) return sceneViewId;
  for (const std::vector<ViewId>& views : {viewsBeside(workspace, workspace.focus), viewsOnScreen(workspace)})
    for (const ViewId id : views)
      if (showsScene(workspace.view(id).kind)) return id;
  return sceneViewId;
}

bool sceneIsOfFocus(const Workspace& workspace) {
  const ViewId scene = sceneViewOf(workspace);
  if (scene == workspace.focus || (inGroup(scene) && inGroup(workspace.focus))) return true;
  const Series *drawn = seriesIn(workspace, scene), *seen = seriesIn(workspace, workspace.focus);
  return drawn && seen && (keyOf(*drawn) == keyOf(*seen) || areTimePoints(*drawn, *seen));
}

bool showsOther(const Workspace& before, const Workspace& after) {
  return before.layout != after.layout || before.second != after.second || before.focus != after.focus ||
         before.views != after.views || before.series != after.series;
}

const Series* seriesIn(const Workspace& workspace, ViewId view) {
  const auto state = workspace.series.find(workspace.view(view).series);
  return state == workspace.series.end() ? nullptr : state->second.series.get();
}

ViewId framesViewOf(ViewId view) { return inGroup(view) ? axialViewId : view; }

bool showsFrames(const Workspace& workspace, ViewId view) {
  return showsFrames(workspace.view(framesViewOf(view)).kind);
}

FlatLook flatLookOf(const ViewState& view) {
  const auto look = view.flats.find(view.series);
  return look == view.flats.end() ? FlatLook{} : look->second;
}

std::string frameOfReference(const Series& series) {
  return series.frameOfReferenceUid.empty() ? series.path + '\n' + series.id : series.frameOfReferenceUid;
}

Workspace withFound(Workspace workspace, const Series& series) {
  // Also finds the curved reformats of the series.
  workspace.series.editIf(
      [&](const auto& entry) {
        const SeriesState& state = entry.second;
        return state.missing && keyOf(sourceOf(*state.series)) == keyOf(series) &&
               madeLike(*state.series, series);
      },
      [&](SeriesState& state) {
        state.series = std::make_shared<const Series>(*madeLike(*state.series, series));
        state.missing.reset();
      });
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
  if (!inGroup(view) && isFlat(workspace.view(view).kind)) planes.push_back(view);
  if (!inGroup(view)) return planes;
  for (ViewId id = 0; id < firstComparedId; ++id)
    if (isFlat(workspace.view(id).kind)) planes.push_back(id);
  return planes;
}

Workspace withFlatLooks(Workspace workspace, ViewId view, const std::function<void(FlatLook&)>& change) {
  for (const ViewId id : planesOf(workspace, view)) {
    if (workspace.view(id).series.empty()) continue;
    ViewState& state = workspace.editView(id);
    change(state.flats.editOrAdd(state.series));
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
  for (const ViewId id : planesOf(workspace, axialViewId)) workspace.editView(id).series = keyOf(under);
  return withFlatLooks(std::move(workspace), axialViewId, [&](FlatLook& look) { look.overlay = over; });
}

void turnFurther(FlatLook& look, PictureTurn by) {
  glm::dvec3 right{1, 0, 0}, down{0, 1, 0};
  turnAxes(by, right, down);
  look.turn = composed(look.turn, by);
  look.panMm = {glm::dot(look.panMm, glm::dvec2(right)), glm::dot(look.panMm, glm::dvec2(down))};
}

void makeWhole(FlatLook& look) { look.panMm = {0, 0}, look.zoom = 1, look.turn = {}, look.slabMm = 0; }

Workspace withFrames(Workspace workspace, ViewId view, const Series& series) {
  remember(workspace, series);
  workspace = withFound(std::move(workspace), series);
  const ViewId shown = framesViewOf(view);
  const SeriesKey key = keyOf(series);
  ViewState& frames = workspace.editView(shown);
  const bool wereSlices = frames.series == key && !showsFrames(frames.kind);
  for (ViewId id = 0; inGroup(view) && id < firstComparedId; ++id) workspace.editView(id).series = key;
  frames.series = key;
  frames.wanted.clear();
  frames.kind = ViewKind::frames;
  FlatLook& look = frames.flats.editOrAdd(key);
  if (wereSlices) makeWhole(look), look.frame = sliceAtCursor(workspace, series);
  ViewId& focus = isInSecond(view) ? workspace.focus : editMainFocus(workspace);
  if (focus == view || (inGroup(focus) && !isInSecond(view))) focus = shown;
  return workspace;
}

Workspace withLayout(Workspace workspace, Layout layout) {
  ViewId& focus = editMainFocus(workspace);
  // Takes the planes of a fused group, whichever of its views is in focus.
  const bool isFusedGroup = inGroup(focus) && !flatLookOf(workspace.view(axialViewId)).overlay.empty();
  const ViewState from = workspace.view(isFusedGroup ? axialViewId : focus);
  const SeriesKey shown = from.series;
  const bool asFrames = showsFrames(workspace, focus);
  workspace.layout = layout;
  const std::vector<ViewId> views = viewsInMain(workspace);
  if (std::ranges::find(views, focus) == views.end()) focus = views.front();
  if (workspace.view(views.front()).series.empty()) {
    ViewState& first = workspace.editView(views.front());
    first.series = shown;
    first.wanted.clear();
    first.flats.add(shown, {});
    if (const FlatLook look = flatLookOf(from); !look.overlay.empty()) {
      FlatLook& fused = first.flats.edit(shown);
      fused.overlay = look.overlay;
      fused.overlayColours = look.overlayColours;
      fused.overlayOpacity = look.overlayOpacity;
    }
    const Series* series = seriesIn(workspace, views.front());
    first.kind =
        series && !inGroup(views.front()) ? acquiredKind(series->acquired) : usualKind(views.front());
    if (asFrames) first.kind = ViewKind::frames;
  }
  return workspace;
}

bool canChangeKind(ViewId view) { return !inGroup(view); }

Workspace withKind(Workspace workspace, ViewId view, ViewKind kind, const SceneLook& first) {
  if (!canChangeKind(view) || workspace.view(view).series.empty()) return workspace;
  leaveFrames(workspace, view);
  ViewState& state = workspace.editView(view);
  const bool another = std::exchange(state.kind, kind) != kind;
  if (showsScene(kind))
    state.scenes.add(state.series, first);
  else if (!state.flats.add(state.series, {}) && another)
    state.flats.edit(state.series).turn = {};
  return workspace;
}

Workspace without(Workspace workspace, const SeriesKey& key) {
  ClosedSeries closed;
  if (const auto state = workspace.series.find(key); state != workspace.series.end())
    closed.series = state->second.series;
  const auto move = [&](auto& from, auto& to) {
    for (const auto& made : from)
      if (made.series == key) to.push_back(made);
    from.eraseIf([&](const auto& made) { return made.series == key; });
  };
  move(workspace.measurements, closed.measurements);
  move(workspace.keyImages, closed.keyImages);
  move(workspace.segmentMaps, closed.segmentMaps);
  if (std::ranges::find(closed.measurements, workspace.selected, &Measurement::id) !=
      closed.measurements.end())
    workspace.selected = 0;
  if (closed.series && !closed.holdsNothing()) workspace.closed.push_back(std::move(closed));
  for (ViewId id = 0; id < viewCount; ++id) leaveSeries(workspace, id, key);
  workspace.series.erase(key);
  return workspace;
}

Workspace withSegmentMap(Workspace workspace, const SegmentMap& map) {
  const auto isIt = [&](const SegmentMap& other) {
    return other.series == map.series && other.number == map.number;
  };
  const auto isOfOtherGrid = [&](const SegmentMap& other) {
    return other.series == map.series && other.labels && map.labels &&
           other.labels->geometry() != map.labels->geometry();
  };
  if (map.segments.empty()) {
    workspace.segmentMaps.eraseIf(isIt);
    return workspace;
  }
  if (segmentMapOf(workspace, map.series, map.number))
    workspace.segmentMaps.editIf(isIt, [&](SegmentMap& other) {
      other = withEditedMarked(other, withLetGo(other, withHandMade(other, map)));
    });
  else
    workspace.segmentMaps.push_back(map);
  workspace.segmentMaps.eraseIf(isOfOtherGrid);
  return workspace;
}

const SegmentMap* segmentMapOf(const Workspace& workspace, const SeriesKey& series) {
  const auto found = std::ranges::find(workspace.segmentMaps, series, &SegmentMap::series);
  return found == workspace.segmentMaps.end() ? nullptr : &*found;
}

const SegmentMap* segmentMapOf(const Workspace& workspace, const SeriesKey& series, int number) {
  const auto found = std::ranges::find_if(workspace.segmentMaps, [&](const SegmentMap& map) {
    return map.series == series && map.number == number;
  });
  return found == workspace.segmentMaps.end() ? nullptr : &*found;
}

std::vector<const SegmentMap*> segmentMapsOf(const Workspace& workspace, const SeriesKey& series) {
  std::vector<const SegmentMap*> maps;
  for (const SegmentMap& map : workspace.segmentMaps)
    if (map.series == series) maps.push_back(&map);
  std::ranges::sort(maps, {}, &SegmentMap::number);
  return maps;
}

Workspace withClosed(Workspace workspace) {
  while (!workspace.closed.empty()) {
    const Series series = *workspace.closed.front().series;
    workspace.unlisted.edit().series.erase(keyOf(series));
    if (workspace.series.contains(keyOf(series)))
      takeBack(workspace, series);
    else
      remember(workspace, series);
  }
  return workspace;
}

Workspace replacedBy(Workspace workspace, Workspace next) {
  const SharedMap<SeriesKey, SeriesState> before = workspace.series;
  for (const auto& [key, state] : before)
    if (!next.series.contains(key)) workspace = without(std::move(workspace), key);
  next.closed = std::move(workspace.closed);
  next.unlisted = std::move(workspace.unlisted);
  for (const auto& [key, state] : next.series) next.unlisted.edit().series.erase(key);
  return next;
}

}  // namespace volumen
