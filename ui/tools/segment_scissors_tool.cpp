#include <glm/geometric.hpp>

#include "ui/controller/segment_editing.h"
#include "ui/controller/segment_edits.h"
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

void make(SegmentEditing& segments, const SegmentCut& cut) {
  segments.change(cutOf(segments.session(), segments.options(), cut));
}

}  // namespace

std::unique_ptr<Drag> beginSegmentScissors(const SlicePress& press) {
  if (!press.segments) return nullptr;
  return drawOutline(press, [press](const std::vector<glm::dvec3>& outline) {
    make(*press.segments, cutInSlice(press, outline));
  });
}

std::unique_ptr<SceneDrag> beginSceneSegmentScissors(const ScenePress& press) {
  if (!press.segments) return nullptr;
  return drawLasso(press, [press](const Lasso& lasso) {
    make(*press.segments, {keyOf(press.series->series), lasso});
  });
}

}  // namespace volumen
