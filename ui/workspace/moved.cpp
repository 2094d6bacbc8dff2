#include "ui/workspace/moved.h"

#include <algorithm>

namespace volumen {

namespace {

template <class Key, class T>
void renameKey(std::map<Key, T>& map, const Key& from, const Key& to) {
  if (from == to) return;
  auto node = map.extract(from);
  if (node.empty()) return;
  node.key() = to;
  map.insert(std::move(node));
}

}  // namespace

Workspace withSeriesMoved(Workspace w, const SeriesKey& from, const Series& to) {
  const auto known = w.series.find(from);
  if (known == w.series.end()) return w;
  const std::string frameBefore = frameOfReference(*known->second.series), frame = frameOfReference(to);
  const SeriesKey key = keyOf(to);
  known->second.series = std::make_shared<const Series>(to);
  known->second.missing.reset();
  renameKey(w.series, from, key);
  const auto rename = [&](SeriesKey& named) {
    if (named == from) named = key;
  };
  for (ViewState& view : w.views) {
    rename(view.series);
    renameKey(view.scenes, from, key);
    renameKey(view.flats, from, key);
    for (auto& [series, look] : view.flats) rename(look.overlay);
    renameKey(view.crosshairs, frameBefore, frame);
  }
  renameKey(w.crosshairs, frameBefore, frame);
  for (FrameLink& link : w.frameLinks)
    for (std::string* end : {&link.from, &link.to})
      if (*end == frameBefore) *end = frame;
  for (Measurement& m : w.measurements) rename(m.series);
  for (KeyImage& image : w.keyImages) rename(image.series);
  return w;
}

Workspace withReferenceMoved(Workspace w, const ReferenceKey& from, const ReferenceKey& to) {
  renameKey(w.regions, from, to);
  for (ViewState& view : w.views)
    for (auto& [series, look] : view.flats)
      if (look.presentation == from) look.presentation = to;
  return w;
}

std::vector<UsedReference> referencesOf(const Workspace& workspace) {
  std::vector<UsedReference> used;
  for (const ViewState& view : workspace.views)
    for (const auto& [series, look] : view.flats)
      if (!look.presentation.empty()) used.push_back({look.presentation, ReferenceKind::presentation});
  for (const auto& [key, look] : workspace.regions) used.push_back({key, look.kind});
  std::ranges::sort(used, {}, &UsedReference::key);
  const auto isSame = [](const UsedReference& a, const UsedReference& b) { return a.key == b.key; };
  used.erase(std::unique(used.begin(), used.end(), isSame), used.end());
  return used;
}

}  // namespace volumen
