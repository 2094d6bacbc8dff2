#pragma once

#include <QLineF>
#include <QPainter>
#include <vector>

#include "ui/tools/tool.h"

namespace volumen {

/// An edge of the clip box of the 3D scene in a flat view of the same series, in logical pixels.
struct ClipLine {
  int axis = 0;
  bool high = false;
  QLineF line;
};

/// Returns the visible edges. If the box is the whole volume, there are none unless `whole` is true.
std::vector<ClipLine> clipLines(const SlicePress& press, bool whole);

void paintClipLines(QPainter& painter, const std::vector<ClipLine>& lines);

/// Starts a drag of the edge under the press; null if there is none.
std::unique_ptr<Drag> beginOnClip(const SlicePress& press, bool whole);
bool isOnClip(const SlicePress& press, bool whole);

}  // namespace volumen
