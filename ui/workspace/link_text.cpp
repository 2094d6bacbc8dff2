#include "ui/workspace/link_text.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "results/text/text.h"
#include "ui/workspace/flat_plane.h"

namespace volumen {

namespace {

bool areLinked(const Workspace& workspace, ViewId view) {
  return relationOf(workspace, frameOfReference(*seriesIn(workspace, workspace.focus)),
                    frameOfReference(*seriesIn(workspace, view)))
      .has_value();
}

QString handText(const Workspace& workspace, ViewId view, const FrameRelation& relation) {
  const Series& own = *seriesIn(workspace, workspace.focus);
  const Series& other = *seriesIn(workspace, view);
  const Crosshair from = crosshairOf(workspace, workspace.focus, own);
  const Crosshair to = crosshairOf(workspace, view, other);
  const glm::dvec3 normal = to.plane(workspace.view(view).kind).normal();
  const long mm = std::lround(glm::dot(relation.toFromFrom(from.at) - from.at, normal));
  return tr("linked by hand, %1%2 mm")
      .arg(mm < 0 ? QString(QChar(0x2212)) : QStringLiteral("+"))
      .arg(std::abs(mm));
}

}  // namespace

QString linkText(const Workspace& workspace, ViewId view) {
  const std::vector<ViewId> others = viewsOfOtherFrames(workspace);
  if (view == workspace.focus || seriesIn(workspace, workspace.focus) == nullptr) return {};
  if (scrollsAlone(workspace, view) && scrollsAlone(workspace, workspace.focus)) return tr("not linked");
  if (std::ranges::find(others, view) == others.end()) return {};
  const auto relation = relationOf(workspace, frameOfReference(*seriesIn(workspace, workspace.focus)),
                                   frameOfReference(*seriesIn(workspace, view)));
  if (!relation) return tr("not linked");
  return relation->byHand ? handText(workspace, view, *relation) : tr("linked by registration");
}

QString linkSentence(const Workspace& workspace) {
  const std::vector<ViewId> others = viewsOfOtherFrames(workspace);
  if (scrollsAlone(workspace, workspace.focus)) return tr("Each view scrolls alone: Scroll links them.");
  if (others.empty()) return tr("Views of one frame of reference scroll together.");
  const bool all = std::ranges::all_of(others, [&](ViewId id) { return areLinked(workspace, id); });
  return all ? tr("The views scroll together.")
             : tr("Different frames of reference: not linked. Lock here links them by hand.");
}

QString whyNotOverlaid(const Workspace& workspace, const Series& under, const Series& over) {
  if (!under.acquired.calibrated || !over.acquired.calibrated) return tr("not calibrated");
  if (!relationOf(workspace, frameOfReference(under), frameOfReference(over)))
    return tr("another frame of reference");
  return {};
}

}  // namespace volumen
