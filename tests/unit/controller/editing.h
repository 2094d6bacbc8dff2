#pragma once

#include <QTest>
#include <vector>

#include "results/segments/segments.h"
#include "tests/ui/hollow_balls.h"
#include "ui/controller/lesion.h"
#include "ui/controller/segment_editing.h"
#include "ui/controller/segment_edits.h"
#include "ui/controller/segment_parts.h"
#include "ui/workspace/series_segments.h"
#include "viewer/segment/range.h"

namespace volumen::tests {

inline constexpr int longestMs = 60'000;
/// The middle of the hollow ball, and a position in no ball.
inline constexpr glm::dvec3 bigBall(-5), inAir(18, -18, 12);

/// A session without a window that shows a series, with its answers.
struct Editing {
  LoadedSeriesPtr series;
  SeriesKey key;
  Session session;
  Jobs jobs;
  SegmentEditing editing{session, jobs};
  std::vector<SegmentAnswer> answers;

  explicit Editing(LoadedSeriesPtr shown = hollowBalls())
      : series(std::move(shown)), key(keyOf(series->series)) {
    session.show(series);
    QObject::connect(&editing, &SegmentEditing::answered, &editing,
                     [this](const SegmentAnswer& answer) { answers.push_back(answer); });
  }
  const VoxelGeometry& grid() const { return series->volume->geometry(); }
  const SegmentMap* map() { return segmentMapOf(session.workspace(), key); }
  BitMask mask() { return maskOf(*map()->labels, std::uint8_t(map()->current)); }
  bool idle() {
    return QTest::qWaitFor([this] { return jobs.rows().empty(); }, longestMs);
  }
  void choose(const std::function<void(SegmentOptions&)>& change) { editing.choose(change); }
  /// Adds a segment of these values, which becomes the current one.
  void add(ValueRange range) {
    const Workspace with = withNewSegment(session.workspace(), key, grid(), {});
    const SegmentMap& made = *segmentMapOf(with, key);
    session.change(QStringLiteral("test"),
                   withSegmentMap(with, withMask(made, made.current, voxelsInRange(*series->volume, range))));
  }
  void begin(const std::vector<ValueRange>& segments, const SegmentOptions& options) {
    for (const ValueRange range : segments) add(range);
    choose([&](SegmentOptions& chosen) { chosen = options; });
  }
  void changeCurrent(const std::function<void(Segment&)>& change) {
    session.change(QStringLiteral("test"),
                   withSegmentChanged(session.workspace(), key, map()->current, change));
  }
  void part(glm::dvec3 p, Qt::KeyboardModifiers keys = {}) { part(PartClick{key, p, false, keys}); }
  void part(const PartClick& click) { editing.change(partOf(session, editing.options(), click)); }
  void paint(glm::dvec3 p, double mm) {
    paint(SegmentStroke{SegmentStroke::Phase::begins, key, ballStroke(grid(), p, p, mm)});
  }
  void paint(SegmentStroke stroke) {
    editing.paint(stroke);
    stroke.phase = SegmentStroke::Phase::ends;
    editing.paint(stroke);
  }
  /// Cuts a half space, x < 0, along z from the plane through the middle of the ball.
  void cut(bool inSlice, bool inside = true) {
    SegmentCut wanted{key};
    wanted.inSlice = inSlice;
    wanted.lasso.origin = {0, 0, -4.5};
    wanted.lasso.points = {{-50, -50}, {0, -50}, {0, 50}, {-50, 50}};
    wanted.lasso.inside = inside;
    cut(wanted);
  }
  void cut(const SegmentCut& wanted) { editing.change(cutOf(session, editing.options(), wanted)); }
  Result<SegmentWork> lesion(double mm) {
    return lesionOf(session, editing.options().lesionThreshold, {key, inSmallBall, mm});
  }
};

}  // namespace volumen::tests
