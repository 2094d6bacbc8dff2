#pragma once

#include <memory>
#include <vector>

#include "tests/ui/segment_window.h"
#include "ui/controller/segment_painter.h"
#include "ui/derivations/drawn_scenes.h"
#include "ui/workspace/series_segments.h"
#include "viewer/segment/occupancy.h"
#include "viewer/segment/range.h"

namespace volumen::tests {

/// A session without a window that shows a 3D view beside planes. The hollow ball and the small ball are
/// segment 1, the core is segment 2.
struct SurfaceSession {
  Session session;
  Jobs jobs;
  SegmentPainter painter{session};
  DrawnScenes scenes;
  LoadedSeriesPtr series = hollowBalls();
  SeriesKey key = keyOf(series->series);

  explicit SurfaceSession(std::size_t mostBytes = std::size_t(1) << 30)
      : scenes(session, painter, jobs, mostBytes) {
    session.show(series);
    session.change(QStringLiteral("test"), withLayout(session.workspace(), Layout::planes));
    add({800, 1200});
    add({400, 600});
  }

  const SegmentMap& map() { return *segmentMapOf(session.workspace(), key); }
  bool idle() {
    return QTest::qWaitFor([this] { return jobs.rows().empty(); }, longest);
  }
  void change(const Workspace& after) { session.change(QStringLiteral("test"), after); }
  void add(ValueRange range) {
    const Workspace with = withNewSegment(session.workspace(), key, series->volume->geometry(), {});
    const SegmentMap& made = *segmentMapOf(with, key);
    change(withSegmentMap(with, withMask(made, made.current, voxelsInRange(*series->volume, range))));
  }
  /// Adds an isolated voxel to segment 1.
  void addVoxel(int i = 0) {
    BitMask mask = maskOf(*map().labels, 1);
    mask.set({i, 0, 0});
    change(withSegmentMap(session.workspace(), withMask(map(), 1, mask)));
  }
  /// Returns false if the volume cannot be cut.
  bool cut(const Mask& mask) {
    const auto left = masked(*series->volume, mask);
    if (!left) return false;
    auto without = std::make_shared<LoadedSeries>(*series);
    without->volume = *left;
    session.keep(without, mask);
    session.setMask(QStringLiteral("test"), key, mask);
    return true;
  }
  void undo() { session.undoStack().undo(); }
  std::vector<SegmentSurface> drawn() { return scenes.scene(sceneViewId).segments; }
  FieldPtr field(int number) {
    for (const SurfaceFields::Entry& made : scenes.surfaces().entries())
      if (made.key.number == number) return made.value;
    return nullptr;
  }
};

}  // namespace volumen::tests
