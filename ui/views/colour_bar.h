#pragma once

#include <QPainter>
#include <memory>
#include <optional>

#include "ui/tools/drag.h"
#include "ui/workspace/session.h"
#include "viewer/slice/colour_map.h"

namespace volumen {

/// What a bar of colours stands for: a series over another, or one that is shown in colours itself.
struct ColourBar {
  ViewId view = 0;  ///< where it stands
  LoadedSeriesPtr series;
  ColourMap map = ColourMap::grey;
  Window window;  ///< in use, stored values; inverted: the lowest value is on top
  bool over = false;
};

/// Where it stands, upright at the left edge of an area, logical pixels; empty where there is no room for it.
QRectF colourBarRect(const QRectF& area);
/// With the values of its ends beside them.
void paintColourBar(QPainter& painter, const QRectF& area, const ColourBar& bar);
/// What its ends are dragged by.
void paintBarHandles(QPainter& painter, const QRectF& area);

/// Whether a place is on the bar or on its numbers.
bool isOnColourBar(const QRectF& area, QPointF p);
/// Whether it is at one of its ends.
bool isOnBarEnd(const QRectF& area, QPointF p);
/// Drags the end of the bar that is there, as a scale: so many heights of the bar are so many times its
/// window; Shift: fine, Ctrl: fast. The other end stays. Null: there is none.
std::unique_ptr<Drag> beginBarEnd(Session& session, const QRectF& area, const ColourBar& bar, QPointF at);
/// Gives what it stands for a window; edits in a gesture are one step.
void setBarWindow(Session& session, const ColourBar& bar, const Window& window);

}  // namespace volumen
