#include "io/dicom/object_check.h"

#include <algorithm>

#include "io/dicom/header_check.h"

namespace volumen::dicom {
namespace {

bool isMapping(const NamedGrey& grey) { return grey.mapping.window.width > 0; }

bool isShutter(const ShutterShape& s) {
  if (s.kind == ShutterShape::Kind::circle) return s.radius > 0;
  return s.kind == ShutterShape::Kind::rectangle || s.corners.size() >= 3;
}

bool isGraphic(const Graphic& g) {
  switch (g.type) {
    case GraphicType::point:
      return g.points.size() == 1;
    case GraphicType::circle:
      return g.points.size() == 2;
    case GraphicType::ellipse:
      return g.points.size() == 4;
    case GraphicType::polyline:
    case GraphicType::interpolated:
      break;
  }
  return g.points.size() >= 2;
}

bool isDescribed(const Frame& f) {
  return isPictureSize(f.size.x, f.size.y) && f.pixel.mm.x > 0 && f.pixel.mm.y > 0 &&
         std::ranges::all_of(f.greys, isMapping);
}

}  // namespace

bool isConsistent(const Frame& f) {
  if (!isDescribed(f)) return false;
  const std::size_t pixels = std::size_t(f.size.x) * std::size_t(f.size.y);
  const bool grey = f.values.size() == pixels && f.rgb.empty() && !f.greys.empty();
  const bool colour = f.rgb.size() == 3 * pixels && f.values.empty();
  return (grey || colour) && (f.shutter.empty() || f.shutter.size() == pixels) &&
         std::ranges::all_of(f.overlays, [&](const FrameOverlay& o) { return o.mask.size() == pixels; });
}

bool isConsistent(const std::vector<Frame>& framesWithoutPixels) {
  return std::ranges::all_of(framesWithoutPixels, [](const Frame& f) {
    return isDescribed(f) && f.values.empty() && f.rgb.empty() && f.shutter.empty() && f.overlays.empty();
  });
}

bool isConsistent(const Presentation& p) {
  const auto areMappings = [](const Presentation::Greys& g) {
    return std::ranges::all_of(g.greys, isMapping);
  };
  const auto areGraphics = [](const Presentation::Annotations& a) {
    return std::ranges::all_of(a.graphics, isGraphic);
  };
  return p.turn.quarters >= 0 && p.turn.quarters <= 3 && std::ranges::all_of(p.greys, areMappings) &&
         std::ranges::all_of(p.shutter.shapes, isShutter) && std::ranges::all_of(p.annotations, areGraphics);
}

bool isConsistent(const Segmentation& s) {
  if (!isPictureSize(s.size.x, s.size.y)) return false;
  const std::uint64_t bits = std::uint64_t(s.size.x) * std::uint64_t(s.size.y) * s.frames.size();
  return s.bits.size() >= (bits + 7) / 8 && s.mm.x > 0 && s.mm.y > 0 && s.thickness > 0 &&
         std::ranges::all_of(s.frames, [&](const SegmentFrame& f) { return f.segment < s.segments.size(); });
}

}  // namespace volumen::dicom
