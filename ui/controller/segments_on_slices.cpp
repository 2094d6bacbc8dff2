#include "ui/controller/segments_on_slices.h"

#include <algorithm>
#include <memory>

#include "io/export/segments_file.h"
#include "io/load.h"
#include "io/study/series.h"
#include "results/segments/segment_record.h"
#include "viewer/segment/labels_on.h"

namespace volumen {

namespace {

// Returns the segment made by the repeated steps; null if it differs from the map's.
const Segment* madeAgain(const Segmented& made, const std::string& name, const BitMask& mask) {
  const auto found = std::ranges::find(made.segments, name, &Segment::label);
  if (found == made.segments.end()) return nullptr;
  return maskOf(made.labels, std::uint8_t(found->number)) == mask ? &*found : nullptr;
}

// Returns whether a segment still has the voxels with which it was imported.
bool isAsImported(const SegmentMap& map, std::uint8_t label, const BitMask& mask,
                  const AcquiredSlices& slices) {
  return map.imported && !mask.empty() &&
         areSameVoxels(map.imported->onSlices.labels.geometry(), slices.volume->geometry()) &&
         maskOf(map.imported->drawn, label) == mask;
}

std::shared_ptr<const AcquiredLabels> acquiredOf(const SegmentMap& map, const Volume& drawn,
                                                 const AcquiredSlices& slices, const CancelToken& cancel) {
  const Result<Segmented> made = follow(recordedRecipe(map, {}).recipe, drawn, cancel, slices);
  const auto names = namesInRecipe(map);
  AcquiredLabels all{LabelMap(slices.volume->geometry())};
  for (const Segment& segment : map.segments) {
    const auto label = std::uint8_t(segment.number);
    const BitMask mask = maskOf(*map.labels, label);
    if (isAsImported(map, label, mask, slices)) {
      const AcquiredLabels& came = map.imported->onSlices;
      all.labels = withLabel(all.labels, label, maskOf(came.labels, label));
      if (came.interpolated.contains(segment.number)) all.interpolated.insert(segment.number);
      continue;
    }
    const Segment* again = made ? madeAgain(*made, names.at(segment.number), mask) : nullptr;
    const BitMask placed =
        again ? maskOf(made->acquired->labels, std::uint8_t(again->number)) : onAcquired(mask, slices);
    all.labels = withLabel(all.labels, label, placed);
    if (!again || made->acquired->interpolated.contains(again->number))
      all.interpolated.insert(segment.number);
  }
  return std::make_shared<const AcquiredLabels>(std::move(all));
}

}  // namespace

std::vector<Segmented> segmentedOf(const std::vector<SegmentMap>& maps) {
  std::vector<Segmented> all;
  for (const SegmentMap& map : maps) {
    Segmented& made = all.emplace_back(Segmented{{}, *map.labels});
    for (const Segment& segment : map.segments) made.segments.push_back(withStepsNamed(segment, map));
  }
  return all;
}

Result<std::vector<Segmented>> segmentedOnSlices(const std::vector<SegmentMap>& maps, const Series& series,
                                                 const CancelToken& cancel) {
  std::vector<Segmented> all = segmentedOf(maps);
  if (!series.regular) return all;
  const auto loaded = loadSeries(series, {}, cancel);
  if (!loaded) return loaded.error();
  const AcquiredSlices slices = acquiredSlicesOf(*loaded);
  if (!slices.volume) return all;
  for (std::size_t n = 0; n < maps.size(); ++n)
    all[n].acquired = acquiredOf(maps[n], *loaded->drawn, slices, cancel);
  if (cancel.cancelled()) return Error{"Cancelled."};
  return all;
}

}  // namespace volumen
