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

/// Where the other planes on screen of the same series cut this one.
std::vector<CrossLine> crossLines(const SlicePress& press);

/// Draws them with a gap about the crosshair's point.
void paintCrossLines(QPainter& painter, const std::vector<CrossLine>& lines, QPointF middle, QRect view);

/// What a press on the lines does: turns all planes by a handle, moves a plane by its line; null where none
/// of them is under the press.
std::unique_ptr<Drag> beginOnLines(const SlicePress& press);
/// Whether there is one.
bool isOnLines(const SlicePress& press);

}  // namespace volumen
