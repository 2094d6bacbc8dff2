#include "ui/controller/segment_recipes.h"

#include <algorithm>
#include <utility>

#include "ui/workspace/segments.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

Result<SegmentMap> withSegments(SegmentMap map, const Segmented& made, const BitMask* kept) {
  for (Segment segment : made.segments) {
    const auto number = freeNumber(map);
    if (!number) return Error{"There are 255 segments, and no more fit: remove one first."};
    BitMask mask = maskOf(made.labels, std::uint8_t(segment.number));
    if (kept) mask = intersected(std::move(mask), *kept);
    segment.number = *number;
    segment.label = freeName(map, segment.label);
    map = withSegment(std::move(map), std::move(segment));
    map = withMask(std::move(map), *number, mask);
  }
  return map;
}

}  // namespace

std::vector<const Recipe*> recipesFor(const std::string& modality) {
  std::vector<const Recipe*> found;
  for (const Recipe& recipe : builtInRecipes())
    if (std::ranges::find(recipe.modalities, modality) != recipe.modalities.end()) found.push_back(&recipe);
  return found;
}

SegmentWork workOf(const Recipe& recipe, const SeriesKey& series, VolumePtr volume, const Mask& mask) {
  SegmentWork work;
  work.series = series;
  work.volume = volume;
  work.text = tr("Recipe %1").arg(shownText(recipe.name));
  work.doing = tr("Following the recipe %1").arg(shownText(recipe.name));
  work.makeAll = [recipe, volume = std::move(volume), mask](const SegmentMap& map,
                                                            const CancelToken& cancel) -> Result<SegmentMap> {
    const Result<Segmented> made = follow(recipe, *volume, cancel);
    if (!made) return Error{recipe.name + ": " + made.message()};
    if (mask.empty()) return withSegments(map, *made, nullptr);
    const BitMask kept = keptVoxels(*volume, mask, cancel);
    return withSegments(map, *made, &kept);
  };
  return work;
}

}  // namespace volumen
