#pragma once

#include "tests/ui/draws_nothing.h"
#include "ui/controller/segment_painter.h"
#include "ui/derivations/drawn_scenes.h"

namespace volumen::tests {

/// A session with all that a 3D view of it needs. No picture is drawn.
struct SceneSession {
  Session session;
  Jobs jobs;
  SegmentPainter painter{session};
  DrawnScenes scenes{session, painter, jobs};
  DrawService drawService{drawsNothing()};
};

}  // namespace volumen::tests
