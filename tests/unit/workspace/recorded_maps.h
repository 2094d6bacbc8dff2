#pragma once

#include <QString>
#include <algorithm>
#include <stdexcept>

#include "results/segments/segment_record.h"
#include "results/segments/segments.h"
#include "viewer/recipe/step_names.h"

namespace volumen::tests {

/// Returns a map of the volume without segments.
inline SegmentMap emptyMap(const Volume& volume) {
  return {{"/data/ct", "1"}, {}, std::make_shared<const LabelMap>(volume.geometry()), {}};
}

/// Returns the recipe of a map's record, passed through its JSON.
inline Recipe readAgain(const SegmentMap& map) {
  const auto again = readRecipe(recipeJson(recordedRecipe(map, "CT").recipe));
  if (!again) throw std::runtime_error(again.message());
  return *again;
}

/// Returns how the recorded recipe's result differs from the map; empty if only by segments that the recipe
/// lacks.
inline QString difference(const SegmentMap& map, const Volume& volume) {
  const RecordedRecipe recorded = recordedRecipe(map, "CT");
  if (recorded.recipe.segments.empty()) return {};
  const auto made = follow(readAgain(map), volume);
  if (!made) return QString::fromStdString(made.message());
  for (const auto& [number, name] : namesInRecipe(map)) {
    const auto segment = std::ranges::find(made->segments, name, &Segment::label);
    if (segment == made->segments.end()) {
      if (std::ranges::count(recorded.missing, name) != 1) return QStringLiteral("a segment is lost");
      continue;
    }
    if (maskOf(made->labels, std::uint8_t(segment->number)) != maskOf(*map.labels, std::uint8_t(number)))
      return QString::fromStdString("other voxels: " + name + "\n" + recipeJson(recorded.recipe));
  }
  return {};
}

/// Adds another segment "A" without voxels.
inline SegmentMap withAnother(SegmentMap map) {
  Segment segment;
  segment.number = *freeNumber(map);
  segment.label = "A";  // the same name as others
  map = withSegment(std::move(map), segment);
  return withRecorded(std::move(map), {{"empty", stepNameOf(segment.number)}});
}

}  // namespace volumen::tests
