#include "io/presentation.h"

#include <algorithm>

namespace volumen {
namespace {

// Returns the first part that applies to a frame.
template <class Part>
const Part* partFor(const std::vector<Part>& parts, const std::string& sopInstanceUid, int frame) {
  const auto found = std::ranges::find_if(
      parts, [&](const Part& part) { return part.of.empty() || namesFrame(part.of, sopInstanceUid, frame); });
  return found == parts.end() ? nullptr : &*found;
}

}  // namespace

bool namesFrame(const std::vector<ReferencedPicture>& pictures, const std::string& sopInstanceUid,
                int frame) {
  return std::ranges::any_of(pictures, [&](const ReferencedPicture& p) {
    return p.sopInstanceUid == sopInstanceUid &&
           (p.frames.empty() || std::ranges::binary_search(p.frames, frame));
  });
}

const std::vector<NamedGrey>* greysFor(const Presentation& presentation, const std::string& sopInstanceUid,
                                       int frame) {
  const auto* part = partFor(presentation.greys, sopInstanceUid, frame);
  return part ? &part->greys : nullptr;
}

FramePresentation presentationOf(const Presentation& presentation, const std::string& sopInstanceUid,
                                 int frame, glm::ivec2 size) {
  FramePresentation how;
  how.turn = presentation.turn;
  how.layers = presentation.layers;
  if (const auto* part = partFor(presentation.areas, sopInstanceUid, frame)) {
    how.area = part->area;
    // Some programs count from 0 instead of 1: this is the whole image.
    if (part->area == PixelBox{{-1, -1}, size - 1}) how.area = PixelBox{{0, 0}, size - 1};
  }
  for (const Presentation::Annotations& part : presentation.annotations) {
    if (!part.of.empty() && !namesFrame(part.of, sopInstanceUid, frame)) continue;
    how.graphics.insert(how.graphics.end(), part.graphics.begin(), part.graphics.end());
    how.texts.insert(how.texts.end(), part.texts.begin(), part.texts.end());
  }
  return how;
}

}  // namespace volumen
