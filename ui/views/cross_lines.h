#pragma once

#include <QPainter>
#include <vector>

#include "ui/tools/tool.h"

namespace volumen {

/// The line of another plane on screen in a flat view, in logical pixels.
struct CrossLine {
  ViewKind kind;                 ///< kind of the other view
  QPointF from, to;              ///< outside the edges of the view
  std::vector<QPointF> handles;  ///< handles inside the view that rotate the planes
};

/// Returns whether `other` has a line in `view`: both are on screen and show slices of one series at one
/// crosshair.
bool isCrossed(const Workspace& workspace, ViewId view, ViewId other);

/// Returns the intersections with the other planes; empty if the preferences hide them.
std::vector<CrossLine> crossLines(const SlicePress& press);

/// Draws the lines with a gap about the point of the crosshair.
void paintCrossLines(QPainter& painter, const std::vector<CrossLine>& lines, QPointF middle, QRect view);

/// Starts the gesture of a press on the lines: a handle rotates all planes, a line moves its plane. Returns
/// null if neither is under the press. Lines react outside the middle third of the view and away from the
/// crossing, so that drags meant for the picture move no plane. With `whole` they react along their full
/// length except for the gap at the crossing.
std::unique_ptr<Drag> beginOnLines(const SlicePress& press, bool whole);
/// Returns whether beginOnLines() would start a gesture.
bool isOnLines(const SlicePress& press, bool whole);

}  // namespace volumen
