#include "ui/tools/tool.h"

namespace volumen {

// The click does it all; the panel decides what happens to the component.

std::unique_ptr<Drag> beginPart(const SlicePress& pressed) {
  const SlicePress press = ofPainted(pressed);
  if (press.takePart)
    press.takePart(
        {keyOf(press.series->series), press.patientAt(press.at), false, press.keys, press.frame.has_value()});
  return nullptr;
}

std::unique_ptr<SceneDrag> beginScenePart(const ScenePress& press) {
  const std::optional<SurfacePoint> seen = press.surfaceAt(press.at);
  if (!seen)
    press.missed(press.at);
  else if (press.takePart)
    press.takePart({keyOf(press.series->series), seen->pPatient, true, press.keys});
  return nullptr;
}

}  // namespace volumen
