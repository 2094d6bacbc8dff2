#pragma once

#include <QPainter>
#include <vector>

#include "ui/tools/tool.h"

namespace volumen {

/// A line of another plane on screen in a flat view, logical pixels.
struct CrossLine {
  ViewKind kind;                 ///< of the other plane
  QPointF from, to;              ///< beyond the edges of the view
  std::vector<QPointF> handles;  ///< to turn the planes by; those inside the view
};

/// Whether another view on screen has a line among crossLines() of this one: both show slices of one series,
/// at one crosshair.
bool isCrossed(const Workspace& workspace, ViewId view, ViewId other);

/// Where those planes cut this one; none where the preferences hide them.
std::vector<CrossLine> crossLines(const SlicePress& press);

/// Draws them with a gap about the crosshair's point.
void paintCrossLines(QPainter& painter, const std::vector<CrossLine>& lines, QPointF middle, QRect view);

/// What a press on the lines does: turns all planes by a handle, moves a plane by its line; null where none
/// of them is under the press. A line is taken hold of in its outer parts alone, so that a drag that means
/// the picture moves no plane: outside the middle third of the view and away from the crossing. `whole`: all
/// along, but for the gap at the crossing.
std::unique_ptr<Drag> beginOnLines(const SlicePress& press, bool whole);
/// Whether there is one.
bool isOnLines(const SlicePress& press, bool whole);

}  // namespace volumen
