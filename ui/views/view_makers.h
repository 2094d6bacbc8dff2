#pragma once

#include "ui/workspace/session.h"
#include "ui/workspace/view_kind.h"

namespace volumen {

class DrawService;
class DrawnScenes;
class FrameService;
class MeasuredNumbers;
class DerivedObjects;
class SegmentEditing;
class SliceService;
class View;

/// The services that views use.
struct ViewParts {
  Session& session;
  const DrawnScenes& drawn;
  DrawService& drawService;
  SliceService& slices;
  FrameService& frames;
  MeasuredNumbers& measurer;
  DerivedObjects& derived;
  SegmentEditing* segments = nullptr;  ///< null for views that are not on screen
};

/// Makes a hidden view of this id for the kinds of a family. A table maps families to classes.
View* makeView(ViewFamily family, const ViewParts& parts, ViewId id, QWidget* parent);

}  // namespace volumen
