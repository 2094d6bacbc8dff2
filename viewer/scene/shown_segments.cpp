#include "viewer/scene/scene.h"

namespace volumen {

std::vector<const SegmentSurface*> shownSegments(const Scene& scene) {
  std::vector<const SegmentSurface*> shown;
  for (const SegmentSurface& s : scene.segments)
    if (s.opacity > 0 && !s.field->values.empty()) shown.push_back(&s);
  return shown;
}

}  // namespace volumen
