#include "ui/controller/segment_editing.h"
#include "ui/controller/segment_parts.h"
#include "ui/tools/tool.h"

namespace volumen {

namespace {

void take(SegmentEditing& segments, const PartClick& click) {
  segments.change(partOf(segments.session(), segments.options(), click));
}

}  // namespace

// A component is selected at the press, so that there is no drag.

std::unique_ptr<Drag> beginPart(const SlicePress& pressed) {
  const SlicePress press = ofPainted(pressed);
  if (press.segments)
    take(*press.segments, {keyOf(press.series->series), press.patientAt(press.at), false, press.keys,
                           press.frame.has_value()});
  return nullptr;
}

std::unique_ptr<SceneDrag> beginScenePart(const ScenePress& press) {
  const std::optional<SurfacePoint> seen = press.surfaceAt(press.at);
  if (!seen)
    press.missed(press.at);
  else if (press.segments)
    take(*press.segments, {keyOf(press.series->series), seen->pPatient, true, press.keys});
  return nullptr;
}

}  // namespace volumen
