#pragma once

#include <QString>
#include <algorithm>
#include <stdexcept>

#include "ui/controller/segment_recipes.h"
#include "ui/workspace/segment_record.h"
#include "ui/workspace/segments.h"
#include "viewer/recipe/step_names.h"

namespace volumen::tests {

/// A map of the volume without segments.
inline SegmentMap emptyMap(const Volume& volume) {
  return {{"/data/ct", "1"}, {}, std::make_shared<const LabelMap>(volume.geometry()), {}};
}

/// The recipe of a map's record, by way of its JSON.
inline Recipe readAgain(const SegmentMap& map) {
  const auto again = readRecipe(recipeJson(recordedRecipe(map, "CT").recipe));
  if (!again) throw std::runtime_error(again.message());
  return *again;
}

/// What is different from the map; empty: nothing, but for what is missing.
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

/// With another segment "A", which has no voxels yet.
inline SegmentMap withAnother(SegmentMap map) {
  Segment segment;
  segment.number = *freeNumber(map);
  segment.label = "A";  // as others are called
  map = withSegment(std::move(map), segment);
  return withRecorded(std::move(map), {{"empty", stepNameOf(segment.number)}});
}

}  // namespace volumen::tests
