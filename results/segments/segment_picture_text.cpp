#include "results/segments/segment_picture_text.h"

#include <algorithm>

#include "viewer/scene/number_text.h"
#include "viewer/scene/scene.h"

namespace volumen {

namespace {

// Returns a single line, whatever the name is.
std::string lineOf(const Segment& segment) {
  std::string line = segment.label;
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < ' '; }, ' ');
  return segment.opacity < 1 ? line + ", opacity " + numberText(segment.opacity) : line;
}

std::string tissueText(const TissueShown& tissue) {
  const bool isInside = tissue.where == TissueShown::Where::inside;
  std::string text =
      isInside ? "only inside the segments that are shown" : "not inside the segments that are shown";
  if (tissue.marginMm > 0)
    text += (isInside ? " and within " : " nor within ") + numberText(tissue.marginMm) + " mm of them";
  return text;
}

}  // namespace

SegmentsInPicture segmentsInPicture(std::span<const SegmentInScene> drawn, const TissueShown& tissue) {
  SegmentsInPicture segments{{}, tissue};
  for (const SegmentInScene& one : drawn) {
    Scene alone;
    alone.segments = {surfaceOf(*one.segment, one.field)};
    if (!shownSegments(alone).empty()) segments.drawn.push_back(lineOf(*one.segment));
  }
  return segments;
}

PictureText textOfSegments(const SegmentsInPicture& segments, bool areDrawn) {
  PictureText text;
  std::string lines;
  for (const std::string& line : segments.drawn) lines += (lines.empty() ? "" : "\n") + line;
  if (areDrawn && !lines.empty()) text.push_back({"volumen-segments", lines});
  if (segments.tissue.where != TissueShown::Where::everywhere)
    text.push_back({"volumen-tissue", tissueText(segments.tissue)});
  return text;
}

}  // namespace volumen
