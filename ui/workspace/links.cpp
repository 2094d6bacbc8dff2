#include "ui/workspace/links.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>

#include "results/series/series_facts.h"
#include "results/text/value_text.h"
#include "ui/workspace/curved_links.h"
#include "ui/workspace/flat_plane.h"

namespace volumen {

namespace {

constexpr double nearlyParallel = 0.9;  // cosine of the angle between two normals

bool isOfSlices(const Workspace& workspace, ViewId view) {
  const Series* series = seriesIn(workspace, view);
  return showsSlices(workspace.view(view).kind) && series && series->acquired.calibrated;
}

std::vector<ViewId> slicesOnScreen(const Workspace& workspace) {
  std::vector<ViewId> views = viewsOnScreen(workspace);
  std::erase_if(views, [&](ViewId id) { return !isOfSlices(workspace, id); });
  return views;
}

std::string frameIn(const Workspace& workspace, ViewId view) {
  return frameOfReference(*seriesIn(workspace, view));
}

PlaneDirections turned(const PlaneDirections& plane, const glm::dmat3& rotation) {
  const auto unit = [&](glm::dvec3 v) { return glm::clamp(glm::normalize(rotation * v), -1.0, 1.0); };
  return {unit(plane.right), unit(plane.down)};
}

// The frames of reference that are linked to others.
std::set<std::string> linkedFrames(const Workspace& workspace) {
  std::set<std::string> frames;
  for (const FrameLink& link : workspace.frameLinks) frames.insert({link.from, link.to});
  return frames;
}

// Directions follow only if they were turned: planes linked by hand keep their orientation.
Workspace withPositionFollowed(Workspace workspace, const std::string& to, const Rigid& rigid,
                               const Crosshair& source, bool turns) {
  const auto known = workspace.crosshairs.find(to);
  const Crosshair now = known == workspace.crosshairs.end() ? Crosshair{} : known->second;
  Crosshair after = now;
  after.at = rigid(source.at);
  if (turns)
    after = {after.at, turned(source.axial, rigid.rotation), turned(source.coronal, rigid.rotation),
             turned(source.sagittal, rigid.rotation), source.byHand || rigid.rotation != glm::dmat3(1)};
  return withCrosshair(std::move(workspace), sceneViewId, to, now, after);
}

// Returns the crosshair of a frame of reference as its series on screen has it, the one in focus first.
Crosshair crosshairSeen(const Workspace& workspace, const std::string& frame) {
  for (const ViewId id : focusFirst(workspace, slicesOnScreen(workspace)))
    if (frameIn(workspace, id) == frame) return crosshairOf(workspace, id, *seriesIn(workspace, id));
  return workspace.crosshairs.at(frame);
}

// Moves linked frames of reference to the position of `from`, except those in `placed`.
Workspace withFrameFollowed(Workspace workspace, const std::string& from, std::set<std::string>& placed) {
  if (!placed.insert(from).second || !workspace.crosshairs.contains(from)) return workspace;
  const Crosshair seen = crosshairSeen(workspace, from);
  for (const std::string& to : linkedFrames(workspace))
    if (const auto relation = relationOf(workspace, from, to); relation && placed.insert(to).second)
      workspace =
          withPositionFollowed(std::move(workspace), to, relation->toFromFrom, seen, relation->registered);
  return workspace;
}

Workspace withPositionsFollowed(const Workspace& before, Workspace after) {
  if (!after.links.scroll) return after;
  const std::set<std::string> frames = linkedFrames(after);
  std::set<std::string> moved;
  for (const std::string& frame : frames) {
    const auto now = after.crosshairs.find(frame);
    const auto was = before.crosshairs.find(frame);
    const bool isNew = was == before.crosshairs.end();
    if (now != after.crosshairs.end() && (isNew || now->second != was->second)) moved.insert(frame);
  }
  for (const std::string& from : moved) {
    const Crosshair source = after.crosshairs.at(from);
    const auto was = before.crosshairs.find(from);
    Crosshair unturned = source;
    if (was != before.crosshairs.end()) unturned = was->second, unturned.at = source.at;
    const Crosshair seen = crosshairSeen(after, from);
    for (const std::string& to : frames)
      if (!moved.contains(to))
        if (const auto relation = relationOf(after, from, to))
          after = withPositionFollowed(std::move(after), to, relation->toFromFrom, seen, unturned != source);
  }
  return after;
}

SlicePlane planeIn(const Workspace& workspace, ViewId view, glm::ivec2 pixels) {
  const Series& series = *seriesIn(workspace, view);
  const ViewState& state = workspace.view(view);
  return flatPlane(state, flatLookOf(state), drawnGeometry(series), crosshairOf(workspace, view, series),
                   pixels);
}

// Returns whether a view shows the same kind of plane of the same series with another pan, zoom or turn.
bool isMoved(const Workspace& before, const Workspace& after, ViewId view) {
  const ViewState &from = before.view(view), &to = after.view(view);
  const FlatLook was = flatLookOf(from), is = flatLookOf(to);
  return from.series == to.series && from.kind == to.kind &&
         (was.zoom != is.zoom || was.panMm != is.panMm || was.turn != is.turn);
}

// Applies linked zoom and pan of one view to another if their planes are parallel.
void followLook(Workspace& workspace, ViewId from, ViewId to, const ViewSizes& sizes) {
  const SlicePlane source = planeIn(workspace, from, sizes.at(from));
  const SlicePlane target = planeIn(workspace, to, sizes.at(to));
  const auto relation = relationOf(workspace, frameIn(workspace, from), frameIn(workspace, to));
  const glm::dvec3 normal = relation ? relation->toFromFrom.rotation * source.normal() : source.normal();
  if (std::abs(glm::dot(normal, target.normal())) < nearlyParallel) return;
  ViewState& state = workspace.editView(to);
  FlatLook& look = state.flats.editOrAdd(state.series);
  if (workspace.links.zoom)
    look.zoom = std::clamp(look.zoom * target.mmPerPixel / source.mmPerPixel, leastZoom, mostZoom);
  if (!workspace.links.pan || !relation) return;
  const glm::dvec3 middle =
      relation->toFromFrom(source.centre) - drawnGeometry(*seriesIn(workspace, to)).centre();
  look.panMm = {glm::dot(middle, target.right), glm::dot(middle, target.down)};
}

// The changed view leads, or the view in focus if a link is new.
Workspace withLooksFollowed(const Workspace& before, Workspace after, const ViewSizes& sizes) {
  if (!after.links.zoom && !after.links.pan) return after;
  std::vector<ViewId> views = slicesOnScreen(after), changed;
  std::erase_if(views, [&](ViewId id) { return !sizes.contains(id); });
  for (const ViewId id : views)
    if (isMoved(before, after, id)) changed.push_back(id);
  const bool isNew = (after.links.zoom && !before.links.zoom) || (after.links.pan && !before.links.pan);
  if (isNew && std::ranges::find(views, after.focus) != views.end()) changed = {after.focus};
  if (changed.empty()) return after;
  for (const ViewId id : views)
    if (std::ranges::find(changed, id) == changed.end()) followLook(after, changed.front(), id, sizes);
  return after;
}

Workspace withWindowsFollowed(const Workspace& before, Workspace after) {
  if (!after.links.window) return after;
  const SeriesKey focus = after.view(after.focus).series;
  std::set<SeriesKey> shown;
  for (const ViewId id : slicesOnScreen(after))
    if (!flatLookOf(after.view(id)).windowAlone) shown.insert(after.view(id).series);
  const auto changed = [&](const SeriesKey& key) {
    const auto was = before.series.find(key);
    return was != before.series.end() && was->second.window != after.series.at(key).window;
  };
  auto source = std::ranges::find_if(shown, changed);
  if (!before.links.window) source = shown.find(focus);
  if (source == shown.end()) return after;
  const SeriesState from = after.series.at(*source);
  for (const SeriesKey& key : shown) {
    const SeriesState& to = after.series.at(key);
    const ValueScale scale = shownScale(*to.series);
    if (to.series->modality != from.series->modality || scale.unit != shownScale(*from.series).unit) continue;
    std::optional<Window> window = from.window;
    if (window && scale.factor != shownScale(*from.series).factor)
      window = storedWindow(shownWindow(*from.window, *from.series), *to.series);
    after.series.edit(key).window = window;
  }
  return after;
}

}  // namespace

std::optional<FrameRelation> relationOf(const Workspace& workspace, const std::string& from,
                                        const std::string& to) {
  std::vector<std::pair<std::string, FrameRelation>> reached{{from, {}}};
  for (std::size_t n = 0; n < reached.size(); ++n) {
    const auto [frame, relation] = reached[n];
    if (frame == to) return relation;
    for (const FrameLink& link : workspace.frameLinks) {
      if (link.from != frame && link.to != frame) continue;
      const std::string& next = link.from == frame ? link.to : link.from;
      if (std::ranges::find(reached, next, &std::pair<std::string, FrameRelation>::first) != reached.end())
        continue;
      const Rigid step = link.from == frame ? link.toFromFrom : link.toFromFrom.inverse();
      reached.push_back({next,
                         {step.after(relation.toFromFrom), relation.byHand || !link.registered,
                          relation.registered || link.registered}});
    }
  }
  return {};
}

std::optional<SeriesOver> seriesOver(const Workspace& workspace, const SeriesKey& under) {
  for (const ViewId id : focusFirst(workspace, viewsOnScreen(workspace))) {
    const ViewState& view = workspace.view(id);
    const auto over = workspace.series.find(flatLookOf(view).overlay);
    if (view.series != under || !showsSlices(view.kind) || over == workspace.series.end()) continue;
    const auto relation = relationOf(workspace, frameOfReference(*seriesIn(workspace, id)),
                                     frameOfReference(*over->second.series));
    if (relation) return SeriesOver{over->first, relation->toFromFrom};
  }
  return {};
}

Workspace withLinksFollowed(const Workspace& before, Workspace after, const ViewSizes& sizes) {
  after = withPositionsFollowed(before, std::move(after));
  after = withCurvesFollowed(before, std::move(after));
  // Follows positions that a curve moved.
  after = withPositionsFollowed(before, std::move(after));
  after = withLooksFollowed(before, std::move(after), sizes);
  return withWindowsFollowed(before, std::move(after));
}

Workspace withScrollLinked(Workspace workspace, bool linked) {
  if (workspace.links.scroll == linked) return workspace;
  std::vector<ViewId> views = slicesOnScreen(workspace);
  // The last view sets the position of a frame of reference, so the one in focus goes last.
  std::stable_partition(views.begin(), views.end(), [&](ViewId id) { return id != workspace.focus; });
  std::map<ViewId, Crosshair> now;
  for (const ViewId id : views) now[id] = crosshairOf(workspace, id, *seriesIn(workspace, id));
  workspace.links.scroll = linked;
  for (ViewId id = 0; id < viewCount; ++id) workspace.editView(id).crosshairs.clear();
  for (const ViewId id : views)
    workspace = withCrosshair(std::move(workspace), id, frameIn(workspace, id), now[id], now[id]);
  if (!linked) return workspace;
  std::set<std::string> placed;
  for (auto id = views.rbegin(); id != views.rend(); ++id)
    workspace = withFrameFollowed(std::move(workspace), frameIn(workspace, *id), placed);
  return workspace;
}

std::vector<ViewId> viewsOfOtherFrames(const Workspace& workspace) {
  std::vector<ViewId> views = slicesOnScreen(workspace);
  if (std::ranges::find(views, workspace.focus) == views.end()) return {};
  // A curved reformat has no rigid relation to anything.
  const auto isCurved = [&](ViewId id) { return seriesIn(workspace, id)->curved.has_value(); };
  if (isCurved(workspace.focus)) return {};
  const std::string own = frameIn(workspace, workspace.focus);
  std::erase_if(views, [&](ViewId id) { return frameIn(workspace, id) == own || isCurved(id); });
  return views;
}

bool canLock(const Workspace& workspace) {
  return std::ranges::any_of(viewsOfOtherFrames(workspace), [&](ViewId id) {
    return !relationOf(workspace, frameIn(workspace, workspace.focus), frameIn(workspace, id));
  });
}

bool canRegister(const Workspace& workspace) { return !viewsOfOtherFrames(workspace).empty(); }

bool canUnlock(const Workspace& workspace) {
  return std::ranges::any_of(viewsOfOtherFrames(workspace), [&](ViewId id) {
    return relationOf(workspace, frameIn(workspace, workspace.focus), frameIn(workspace, id)).has_value();
  });
}

Workspace lockedHere(Workspace workspace) {
  workspace = withScrollLinked(std::move(workspace), true);
  const ViewId focus = workspace.focus;
  const std::vector<ViewId> others = viewsOfOtherFrames(workspace);
  if (others.empty()) return workspace;
  const std::string own = frameIn(workspace, focus);
  const Crosshair from = crosshairOf(workspace, focus, *seriesIn(workspace, focus));
  workspace = withCrosshair(std::move(workspace), focus, own, from, from);
  for (const ViewId id : others) {
    const std::string frame = frameIn(workspace, id);
    if (relationOf(workspace, own, frame)) continue;
    const Crosshair to = crosshairOf(workspace, id, *seriesIn(workspace, id));
    workspace = withCrosshair(std::move(workspace), id, frame, to, to);
    workspace.frameLinks.push_back({own, frame, {glm::dmat3(1), to.at - from.at}, false});
  }
  return workspace;
}

Workspace withRegistration(Workspace workspace, const std::string& from, const std::string& to,
                           const Rigid& toFromFrom) {
  workspace = withScrollLinked(std::move(workspace), true);
  // Other links between them would contradict the registration.
  if (relationOf(workspace, from, to))
    workspace.frameLinks.eraseIf([&](const FrameLink& link) { return link.from == to || link.to == to; });
  workspace.frameLinks.push_back({from, to, toFromFrom, true});
  if (!workspace.crosshairs.contains(from)) return workspace;
  const Crosshair crosshair = crosshairSeen(workspace, from);
  return withPositionFollowed(std::move(workspace), to, toFromFrom, crosshair, true);
}

Workspace unlocked(Workspace workspace) {
  if (!canUnlock(workspace)) return workspace;
  std::set<std::string> shown;
  for (const ViewId id : slicesOnScreen(workspace)) shown.insert(frameIn(workspace, id));
  workspace.frameLinks.eraseIf(
      [&](const FrameLink& link) { return shown.contains(link.from) || shown.contains(link.to); });
  const auto frameOf = [&](const SeriesKey& key) {
    const auto state = workspace.series.find(key);
    return state == workspace.series.end() ? std::string() : frameOfReference(*state->second.series);
  };
  const auto isLost = [&](const auto& entry) {
    const auto& [series, look] = entry;
    return !look.overlay.empty() && !relationOf(workspace, frameOf(series), frameOf(look.overlay));
  };
  for (ViewId id = 0; id < viewCount; ++id)
    workspace.editView(id).flats.editIf(isLost, [](FlatLook& look) { look.overlay = {}; });
  return workspace;
}

}  // namespace volumen
