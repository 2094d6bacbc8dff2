#include "ui/workspace/moved.h"

#include <algorithm>

#include "ui/workspace/series_segments.h"

namespace volumen {

namespace {

template <class Key, class T>
void renameKey(SharedMap<Key, T>& map, const Key& from, const Key& to) {
  const auto known = map.find(from);
  if (from == to || known == map.end()) return;
  const T value = known->second;
  map.erase(from);
  map.add(to, value);
}

}  // namespace

Workspace withSeriesMoved(Workspace w, const SeriesKey& from, const Series& to) {
  const auto known = w.series.find(from);
  if (known == w.series.end()) return w;
  const std::string frameBefore = frameOfReference(*known->second.series), frame = frameOfReference(to);
  const SeriesKey key = keyOf(to);
  SeriesState& state = w.series.edit(from);
  state.series = std::make_shared<const Series>(to);
  state.missing.reset();
  renameKey(w.series, from, key);
  for (ViewId id = 0; id < viewCount; ++id) {
    ViewState& view = w.editView(id);
    if (view.series == from) view.series = key;
    renameKey(view.scenes, from, key);
    renameKey(view.flats, from, key);
    view.flats.editIf([&](const auto& entry) { return entry.second.overlay == from; },
                      [&](FlatLook& look) { look.overlay = key; });
    renameKey(view.crosshairs, frameBefore, frame);
  }
  renameKey(w.crosshairs, frameBefore, frame);
  w.frameLinks.editIf([&](const FrameLink& link) { return link.from == frameBefore; },
                      [&](FrameLink& link) { link.from = frame; });
  w.frameLinks.editIf([&](const FrameLink& link) { return link.to == frameBefore; },
                      [&](FrameLink& link) { link.to = frame; });
  const auto isOfIt = [&](const auto& made) { return made.series == from; };
  const auto rename = [&](auto& made) { made.series = key; };
  w.measurements.editIf(isOfIt, rename);
  w.keyImages.editIf(isOfIt, rename);
  // The series may be there already, with segments of its own.
  if (from != key) w.segmentMaps.editIf(isOfIt, [&](SegmentMap& map) { map = asMapOf(w, key, map); });
  return w;
}

Workspace withObjectMoved(Workspace w, const DerivedKey& from, const DerivedKey& to) {
  renameKey(w.regions, from, to);
  for (ViewId id = 0; id < viewCount; ++id)
    w.editView(id).flats.editIf([&](const auto& entry) { return entry.second.presentation == from; },
                                [&](FlatLook& look) { look.presentation = to; });
  return w;
}

std::vector<UsedObject> derivedObjectsOf(const Workspace& workspace) {
  std::vector<UsedObject> used;
  for (const ViewState& view : workspace.views)
    for (const auto& [series, look] : view.flats)
      if (!look.presentation.empty()) used.push_back({look.presentation, DerivedKind::presentation});
  for (const auto& [key, look] : workspace.regions) used.push_back({key, look.kind});
  std::ranges::sort(used, {}, &UsedObject::key);
  const auto isSame = [](const UsedObject& a, const UsedObject& b) { return a.key == b.key; };
  used.erase(std::unique(used.begin(), used.end(), isSame), used.end());
  return used;
}

}  // namespace volumen
