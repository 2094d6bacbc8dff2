#pragma once

#include "ui/workspace/session.h"
#include "ui/workspace/view_kind.h"

namespace volumen {

class DrawService;
class FrameService;
class MeasureJobs;
class DerivedObjects;
class SliceService;
class View;

/// What views show and work with.
struct ViewParts {
  Session& session;
  DrawService& drawService;
  SliceService& slices;
  FrameService& frames;
  MeasureJobs& measurer;
  DerivedObjects& derived;
};

/// A hidden view of this id for the kinds of a family. The class for each is a row of one table.
View* makeView(ViewFamily family, const ViewParts& parts, ViewId id, QWidget* parent);

}  // namespace volumen
