#include "ui/controller/curve_follower.h"

#include <algorithm>
#include <new>
#include <utility>

#include "ui/controller/segment_target.h"
#include "ui/controller/step_work.h"
#include "ui/workspace/curve_spans.h"
#include "ui/workspace/segment_record.h"
#include "ui/workspace/segments.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

// The segments with the values that they follow, and the steps that give them those voxels.
struct Following {
  SegmentMap map;
  StepsWanted steps{};
  std::vector<std::string> names{};  // what the steps call the segments
};

// A name of its own stays.
Following followingOf(const SegmentMap& base, const TransferFunction& curve, const LoadedSeries& series) {
  Following wanted{base};
  for (Segment& segment : wanted.map.segments) {
    const std::optional<ValueRange> range = rangeFollowed(segment, curve, series);
    if (!range || segment.locked || segment.range == range) continue;
    if (segment.range && segment.label == nameOfRange(*segment.range, series.series))
      segment.label = freeName(base, nameOfRange(*range, series.series));
    segment.range = range;
    wanted.names.push_back(stepNameOf(segment.number));
    wanted.steps.steps.push_back(
        {"range", wanted.names.back(), {{"low", range->low}, {"high", range->high}}});
    wanted.steps.numbers.push_back(segment.number);
  }
  return wanted;
}

Result<SegmentMap> followed(const Following& wanted, const Volume& volume, const Mask& mask,
                            const CancelToken& cancel) try {
  if (wanted.names.empty()) return wanted.map;
  return withStepsDone(wanted.map, keptIn(wanted.steps, wanted.names, volume, mask, cancel), volume, cancel);
} catch (const std::bad_alloc&) {
  return Error{"The segment does not follow the curve: there is not enough memory."};
}

}  // namespace

CurveFollower::CurveFollower(Session& session, Jobs& jobs, QObject* parent)
    : QObject(parent), session_(session), lane_(&jobs) {}

void CurveFollower::follow() {
  pulledAgain_ = lane_.isBusy();
  if (pulledAgain_) return;
  const SegmentMap* map = segmentsShown(session_);
  if (!map || std::ranges::none_of(map->segments, [](const Segment& s) { return s.span.has_value(); }))
    return;
  const int step = session_.undoStack().index();
  if (step != step_ || *map != made_) base_ = *map;
  step_ = step;
  started_ = *map;
  curve_ = session_.scene().transferFunction;
  const Following wanted = followingOf(base_, curve_, *session_.series());
  if (wanted.names.empty() && started_ == base_) return;
  lane_.run(
      JobName(tr("Following the curve")),
      [wanted, volume = wholeVolume(session_), mask = session_.maskOf(base_.series)](const Job& job) {
        return followed(wanted, *volume, mask, job.cancel());
      },
      [this](const Result<SegmentMap>& made) { take(made); }, [this] { pulledAgain_ = false; });
}

// In the step of the pull where that is the last one still; nothing where the segments were changed
// meanwhile, or the curve otherwise than by pulling on.
void CurveFollower::take(const Result<SegmentMap>& made) {
  const QUndoStack& steps = session_.undoStack();
  const SegmentMap* now = segmentMapOf(session_.workspace(), base_.series);
  const bool isLastStep = steps.index() == step_ && !steps.canRedo();
  const bool isCurve = session_.scene().transferFunction == curve_;
  const bool isWanted = pulledAgain_ ? isLastStep : isCurve && !steps.canRedo();
  if (!made && !pulledAgain_) Q_EMIT failed(QString::fromStdString(made.message()));
  if (made && isWanted && now && *now == started_) {
    session_.playOn(isLastStep ? step_ - 1 : step_, [&] {
      session_.change(tr("Segment follows the curve"), withSegmentMap(session_.workspace(), *made));
    });
    if (const SegmentMap* taken = segmentMapOf(session_.workspace(), base_.series)) made_ = *taken;
  }
  if (std::exchange(pulledAgain_, false)) follow();
}

}  // namespace volumen
