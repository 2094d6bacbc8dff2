#pragma once

#include <optional>
#include <string>

#include "ui/workspace/session_fields.h"
#include "ui/workspace/session_words.h"
#include "ui/workspace/workspace.h"

namespace volumen {

// Lists of the fields of segments and their grids in sessions (session_fields.h), used by session_json.cpp.

inline bool isChecksum(const std::string& text) {
  return text.size() == 40 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// Returns whether the axes span space, as Volume::make requires.
inline bool spansSpace(const VoxelGeometry& geometry) {
  const glm::dvec3 mm = geometry.spacing();
  return geometry.voxelVolume() / (mm.x * mm.y * mm.z) > 1e-9;
}

inline void fields(SessionFields& f, VoxelGeometry& g) {
  constexpr Limits counts{1, 1e6};
  f("sizeI", g.size.x, counts);
  f("sizeJ", g.size.y, counts);
  f("sizeK", g.size.z, counts);
  f("stepI", g.patientFromVoxelStep[0], mmLimits);
  f("stepJ", g.patientFromVoxelStep[1], mmLimits);
  f("stepK", g.patientFromVoxelStep[2], mmLimits);
  f("origin", g.origin, mmLimits);
  f("calibrated", g.calibrated);
}

inline void fields(SessionFields& f, ValueRange& range) {
  f("low", range.low, valueLimits);
  f("high", range.high, valueLimits);
}

inline void fields(SessionFields& f, CurveSpan& span) {
  f("number", span.number, {0, 1000});
  f("of", span.of, {1, 1000});
}

inline void fields(SessionFields& f, Code& code) {
  f("value", code.value);
  f("scheme", code.scheme);
  f("meaning", code.meaning);
}

inline void fields(SessionFields& f, AnatomicStructure& structure) {
  f("code", structure.code);
  f.unless({}, "modifier", structure.modifier);
}

inline void fields(SessionFields& f, AlgorithmIdentity& algorithm) {
  f.unless({}, "family", algorithm.family);
  f.unless({}, "nameCode", algorithm.nameCode);
  f("name", algorithm.name);
  f("version", algorithm.version);
  f("parameters", algorithm.parameters);
  f("source", algorithm.source);
}

inline void fields(SessionFields& f, Segment& s) {
  bool coloured = s.colour.has_value();
  glm::dvec3 colour(s.colour.value_or(glm::u8vec3(0)));
  f("number", s.number, {1, 255});
  f("label", s.label);
  f("description", s.description);
  f.onceText("category", s.category, s.category.meaning);
  f.onceText("type", s.type, s.type.meaning);
  f.unless({}, "modifier", s.modifier);
  f.unless({}, "region", s.region);
  f.unless({}, "regionModifier", s.regionModifier);
  f.unless({}, "structures", s.structures);
  f.unless({}, "algorithmType", s.algorithmType, algorithmWords);
  f("algorithm", s.algorithm);
  f.unless({}, "algorithms", s.algorithms);
  f("trackingId", s.trackingId);
  f.unless({}, "trackingUid", s.trackingUid);
  f("coloured", coloured);
  f("colour", colour, {0, 255});
  f("range", s.range);
  f.unlessNone("span", s.span);
  f("visible", s.visible);
  f("locked", s.locked);
  f("opacity", s.opacity, {0, 1});
  if (coloured) s.colour = glm::u8vec3(colour);
}

inline void fields(SessionFields& f, TissueShown& tissue) {
  f("where", tissue.where, tissueWords);
  f("marginMm", tissue.marginMm, {0, mostTissueMarginMm});
}

// The labels themselves are in a file named by their checksum.
inline void fields(SessionFields& f, SegmentMap& map) {
  SavedLabels saved = savedLabelsOf(map);
  f("series", map.series);
  f("number", map.number, {0, 1e6});
  f("labels", saved.checksum);
  f("geometry", saved.geometry);
  f("segments", map.segments);
  f("current", map.current, {0, 255});
  f("in3d", map.in3d);
  f.unless({}, "tissueIn3d", map.tissue);
  stepsField(f, map.series, map.number, "steps", map.steps);
  f.require("labels", isChecksum(saved.checksum), "must be 40 hexadecimal digits");
  f.require("geometry", spansSpace(saved.geometry), "must have axes that span space");
  if (!map.labels) map.missing = saved;
}

}  // namespace volumen
