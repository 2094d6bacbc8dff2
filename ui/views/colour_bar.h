#pragma once

#include <QPainter>
#include <memory>
#include <optional>

#include "ui/tools/drag.h"
#include "ui/workspace/session.h"
#include "viewer/slice/colour_map.h"

namespace volumen {

/// The content of a colour bar: an overlaid series, or a series that is itself shown in colours.
struct ColourBar {
  ViewId view = 0;  ///< the view that shows the bar
  LoadedSeriesPtr series;
  ColourMap map = ColourMap::grey;
  Window window;  ///< in use, stored values; if inverted, the lowest value is on top
  bool over = false;
};

/// Returns the colour bar of a view of slices; nothing if it shows grey only.
std::optional<ColourBar> colourBarOf(const Session& session, ViewId view);

/// Returns the rectangle of the bar, upright at the left edge of `area`, in logical pixels. It is empty if
/// there is no room.
QRectF colourBarRect(const QRectF& area);
/// Draws the bar with the values of its ends.
void paintColourBar(QPainter& painter, const QRectF& area, const ColourBar& bar);
/// Draws the handles of its ends.
void paintBarHandles(QPainter& painter, const QRectF& area);

/// Returns whether `p` is on the bar or on its numbers.
bool isOnColourBar(const QRectF& area, QPointF p);
/// Returns whether `p` is at an end of the bar.
bool isOnBarEnd(const QRectF& area, QPointF p);
/// Drags the end of the bar at `at`; the other end stays. A drag of N bar heights changes the window by N
/// times its width; Shift is fine, Ctrl fast. Returns null if there is no end.
std::unique_ptr<Drag> beginBarEnd(Session& session, const QRectF& area, const ColourBar& bar, QPointF at);
/// Sets the window of the bar's series. Edits within a gesture are one undo step.
void setBarWindow(Session& session, const ColourBar& bar, const Window& window);

}  // namespace volumen
