#include "ui/controller/curve_follower.h"

#include <algorithm>
#include <new>
#include <utility>

#include "results/segments/segment_maps.h"
#include "results/segments/segment_record.h"
#include "results/segments/segments.h"
#include "results/segments/step_work.h"
#include "results/text/text.h"
#include "ui/controller/segment_target.h"
#include "ui/workspace/curve_spans.h"
#include "ui/workspace/segment_change_text.h"

namespace volumen {

namespace {

// A map with updated ranges of its segments, and the steps that make their voxels.
struct Following {
  SegmentMap map;
  StepsWanted steps{};
  std::vector<std::string> names{};  // names of the segments in the steps
};

// Names chosen by the user stay.
Following followingOf(const SegmentMap& map, const std::vector<SegmentMap>& all,
                      const TransferFunction& curve, const LoadedSeries& series) {
  Following wanted{map};
  for (Segment& segment : wanted.map.segments) {
    const std::optional<ValueRange> range = rangeFollowed(segment, curve, series);
    if (!range || segment.locked || segment.range == range) continue;
    if (segment.range && segment.label == nameOfRange(*segment.range, series.series))
      segment.label = freeName(all, nameOfRange(*range, series.series));
    segment.range = range;
    wanted.names.push_back(stepNameOf(segment.number));
    wanted.steps.steps.push_back(
        {"range", wanted.names.back(), {{"low", range->low}, {"high", range->high}}});
    wanted.steps.numbers.push_back(segment.number);
  }
  return wanted;
}

Result<std::vector<SegmentMap>> followed(const std::vector<Following>& all, const Volume& volume,
                                         const Mask& mask, const CancelToken& cancel) {
  std::vector<SegmentMap> maps;
  for (const Following& wanted : all) {
    maps.push_back(wanted.map);
    if (wanted.names.empty()) continue;
    Result<SegmentMap> made =
        withStepsDone(wanted.map, keptIn(wanted.steps, wanted.names, volume, mask, cancel), volume, cancel);
    if (!made) return made.error();
    maps.back() = std::move(*made);
  }
  return maps;
}

bool followsCurve(const SegmentMap* map) {
  return std::ranges::any_of(map->segments, [](const Segment& s) { return s.span.has_value(); });
}

}  // namespace

CurveFollower::CurveFollower(Session& session, const SegmentPainter& painter, Jobs& jobs, QObject* parent)
    : QObject(parent), session_(session), painter_(painter), lane_(&jobs) {
  connect(&session_.undoStack(), &QUndoStack::indexChanged, this, &CurveFollower::release);
  // From the event loop, because Esc undoes the steps since the press once the stroke has ended.
  connect(
      &painter_, &SegmentPainter::ended, this,
      [this] {
        if (std::exchange(waitsForStroke_, false)) begin(session_.undoStack().canRedo());
      },
      Qt::QueuedConnection);
}

void CurveFollower::follow() { begin(false); }

// Releases the segments of a drag once its undo step is not the last one. A stroke may still be undone.
void CurveFollower::release() {
  const bool isUsed = lane_.isBusy() || waitsForStroke_ || painter_.isPainting();
  if (!isUsed && session_.undoStack().index() != step_) base_ = made_ = started_ = {};
}

void CurveFollower::begin(bool overUndone) {
  pulledAgain_ = lane_.isBusy();
  if (pulledAgain_) return;
  overUndone_ = overUndone;
  const std::vector<const SegmentMap*> shown = allSegmentsShown(session_);
  if (std::ranges::none_of(shown, followsCurve)) return;
  const std::vector<SegmentMap> maps = copiesOf(shown);
  const int step = session_.undoStack().index();
  if (step != step_ || maps != made_) base_ = maps;
  step_ = step;
  started_ = maps;
  curve_ = session_.scene().transferFunction;
  std::vector<Following> wanted;
  for (const SegmentMap& map : base_) wanted.push_back(followingOf(map, base_, curve_, *session_.series()));
  const bool isAsItWas = std::ranges::all_of(wanted, [](const Following& one) { return one.names.empty(); });
  if (isAsItWas && started_ == base_) return;
  lane_.run(
      JobName(tr("Following the curve")),
      [wanted, volume = wholeVolume(session_), mask = session_.maskOf(base_.front().series)](const Job& job) {
        Made made{followed(wanted, *volume, mask, job.cancel()), {}};
        for (std::size_t n = 0; made.maps && n < wanted.size(); ++n)
          made.said << changeText(wanted[n].map, (*made.maps)[n]);
        made.said.removeAll(QString());
        return made;
      },
      [this](const Made& made) { take(made); },
      [this] {
        pulledAgain_ = false;
        release();
      });
}

// Merges the result into the undo step of the drag if that is still the last one. Repeats the job if segments
// changed meanwhile. Drops the result if the curve changed other than by dragging on.
void CurveFollower::take(const Made& made) {
  if (painter_.isPainting()) {
    pulledAgain_ = false;
    waitsForStroke_ = true;
    return;
  }
  const QUndoStack& steps = session_.undoStack();
  const SeriesKey series = base_.front().series;
  const auto maps = [&] { return copiesOf(segmentMapsOf(session_.workspace(), series)); };
  const bool isEnd = overUndone_ || !steps.canRedo();
  const bool isLastStep = steps.index() == step_ && isEnd;
  const bool isOfNow = session_.scene().transferFunction == curve_ && isEnd;
  const bool isWanted = pulledAgain_ ? isLastStep : isOfNow;
  const bool isSame = maps() == started_;
  if (!made.maps && !pulledAgain_)
    Q_EMIT answered({SegmentAnswer::Kind::failed, QString::fromStdString(made.maps.message())});
  if (made.maps && isWanted && isSame) {
    session_.playOn(isLastStep ? step_ - 1 : step_, [&] {
      Workspace after = session_.workspace();
      for (const SegmentMap& map : *made.maps) after = withSegmentMap(std::move(after), map);
      session_.change(tr("Segment follows the curve"), after);
    });
    made_ = maps();
    if (!made.said.isEmpty()) Q_EMIT answered({SegmentAnswer::Kind::done, made.said.join(QLatin1Char(' '))});
  }
  if (std::exchange(pulledAgain_, false) || (isOfNow && !isSame)) follow();
  release();
}

}  // namespace volumen
