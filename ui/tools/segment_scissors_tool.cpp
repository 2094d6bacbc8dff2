#include <glm/geometric.hpp>

#include "ui/tools/tool.h"

namespace volumen {

namespace {

// Cuts along the normal of the slice. Ctrl at the start of the outline removes the outside.
SegmentCut cutInSlice(const SlicePress& drawnIn, const std::vector<glm::dvec3>& outline) {
  const SlicePress press = ofPainted(drawnIn);
  SegmentCut cut{keyOf(press.series->series)};
  cut.inSlice = true;
  cut.onFrame = press.frame.has_value();
  if (cut.onFrame) return cut;
  cut.lasso.origin = press.plane.centre;
  cut.lasso.right = press.plane.right;
  cut.lasso.down = press.plane.down;
  cut.lasso.inside = !(press.keys & Qt::ControlModifier);
  for (const glm::dvec3& place : outline) {
    const glm::dvec3 d = place - drawnIn.plane.centre;
    cut.lasso.points.emplace_back(glm::dot(d, drawnIn.plane.right), glm::dot(d, drawnIn.plane.down));
  }
  return cut;
}

}  // namespace

std::unique_ptr<Drag> beginSegmentScissors(const SlicePress& press) {
  if (!press.cutSegment) return nullptr;
  return drawOutline(press, [press](const std::vector<glm::dvec3>& outline) {
    press.cutSegment(cutInSlice(press, outline));
  });
}

std::unique_ptr<SceneDrag> beginSceneSegmentScissors(const ScenePress& press) {
  return drawLasso(press, [press](const Lasso& lasso) {
    press.cutSegment({keyOf(press.series->series), lasso});
  });
}

}  // namespace volumen
