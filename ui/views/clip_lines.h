#pragma once

#include <QLineF>
#include <QPainter>
#include <vector>

#include "ui/tools/tool.h"

namespace volumen {

/// An edge of the clip box of the 3D scene in a flat view of the same series, logical pixels.
struct ClipLine {
  int axis = 0;
  bool high = false;
  QLineF line;
};

/// Those that are seen: none where the box is the whole volume, unless it is asked for (`whole`).
std::vector<ClipLine> clipLines(const SlicePress& press, bool whole);

void paintClipLines(QPainter& painter, const std::vector<ClipLine>& lines);

/// Moves the edge that is under the press; null: none is.
std::unique_ptr<Drag> beginOnClip(const SlicePress& press, bool whole);
bool isOnClip(const SlicePress& press, bool whole);

}  // namespace volumen
