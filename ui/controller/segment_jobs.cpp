#include "ui/controller/segment_jobs.h"

#include <new>
#include <utility>

#include "io/export/export_segments.h"
#include "ui/workspace/segment_record.h"
#include "ui/workspace/segments.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

// With the work done to the segment of this number, on the job's thread.
Result<SegmentMap> workDone(const SegmentWork& work, const SegmentMap& map, int number,
                            const CancelToken& cancel) try {
  if (work.makeAll) {
    Result<SegmentMap> made = work.makeAll(map, cancel);
    return made ? withHandMade(map, std::move(*made)) : made;
  }
  if (work.steps) {
    const Result<StepsWanted> wanted = work.steps(map, number, cancel);
    return wanted ? withStepsDone(map, *wanted, *work.volume, cancel) : Result<SegmentMap>(wanted.error());
  }
  if (!work.make) return withoutSegment(map, number);
  const Result<BitMask> mask = work.make(map, number, cancel);
  if (!mask) return mask.error();
  return withHandMade(map, withMask(map, number, *mask));
} catch (const std::bad_alloc&) {
  return Error{"The segment was not changed: there is not enough memory."};
}

SegmentNumbers segmentNumbersOf(const std::shared_ptr<const LabelMap>& labels, int number,
                                const VolumePtr& volume) {
  SegmentNumbers numbers{labels, volume, labelCounts(*labels), number, {}};
  if (number > 0) numbers.values = valuesIn(maskOf(*labels, std::uint8_t(number)), *volume);
  return numbers;
}

}  // namespace

SegmentJobs::SegmentJobs(Session& session, const SegmentPainter& painter, Jobs& jobs, QObject* parent)
    : QObject(parent), session_(session), painter_(painter), change_(&jobs), measure_(&jobs), save_(&jobs) {
  save_.keepToTheEnd();
  connect(&session_, &Session::workspaceChanged, this, [this](const Workspace&, const Workspace& after) {
    if (isMaking() && !after.series.contains(waiting_.front().series)) drop();
  });
  // From the event loop: Esc undoes the steps since the press once the stroke has ended.
  connect(
      &painter_, &SegmentPainter::ended, this,
      [this] {
        if (const auto takeNow = std::exchange(takeLater_, nullptr)) takeNow();
      },
      Qt::QueuedConnection);
}

SegmentJobs::~SegmentJobs() { save_.wait(); }

void SegmentJobs::change(const SegmentWork& work) {
  waiting_.push_back(work);
  next();
}

void SegmentJobs::next() {
  while (!isMaking() && !waiting_.empty()) {
    const SegmentWork work = waiting_.front();
    if (session_.workspace().series.contains(work.series)) {
      const SegmentMap* known = segmentMapOf(session_.workspace(), work.series);
      const SegmentMap base = segmentMapOn(session_.workspace(), work.series, work.volume->geometry());
      const Segment* segment = findSegment(base, work.number);
      if (known && known->missing)
        refuse(work, tr("The segments of this series were not found with the session: no others are made."));
      else if (work.makeAll)
        return begin(work, base);
      else if (work.number == 0 && !freeNumber(base))
        refuse(work, tr("There are 255 segments, and no more fit: remove one first."));
      else if (segment && segment->locked)
        refuse(work, tr("%1 is locked: unlock it first.").arg(shownText(segment->label)));
      else if (segment || work.number == 0)
        return begin(work, base);
    }
    waiting_.pop_front();
  }
  if (waiting_.empty()) Q_EMIT ended();
}

void SegmentJobs::begin(const SegmentWork& work, const SegmentMap& base) {
  Workspace with = session_.workspace();
  int number = work.number;
  if (work.makeAll) {
    // Whatever it makes is in its own map.
  } else if (number == 0) {
    Segment made;
    if (work.change) work.change(made);
    with = withNewSegment(std::move(with), work.series, work.volume->geometry(), std::move(made));
    number = segmentMapOf(with, work.series)->current;
  } else if (work.change) {
    with = withSegmentChanged(std::move(with), work.series, number, work.change);
  }
  change_.run(
      JobName(work.doing),
      [work, number, map = segmentMapOn(with, work.series, work.volume->geometry())](const Job& job) {
        return workDone(work, map, number, job.cancel());
      },
      [this, base](const Result<SegmentMap>& made) { take(base, made); }, [this] { drop(); });
}

// One step where the segments are still what it was made of; else it is made anew.
void SegmentJobs::take(const SegmentMap& base, const Result<SegmentMap>& made) {
  if (painter_.isPainting()) {
    takeLater_ = [this, base, made] { take(base, made); };
    return;
  }
  const SegmentWork work = waiting_.front();
  const Workspace& workspace = session_.workspace();
  const bool isSame = segmentMapOn(workspace, work.series, work.volume->geometry()) == base;
  if (isSame || !made) waiting_.pop_front();
  if (!made) {
    refuse(work, shownText(made.message()));
  } else if (isSame) {
    session_.endGesture();
    session_.change(work.text, withSegmentMap(workspace, *made));
    session_.endGesture();
    if (work.done) work.done();
  }
  next();
}

void SegmentJobs::refuse(const SegmentWork& work, const QString& why) {
  if (work.refused) work.refused(why);
  Q_EMIT failed(why);
}

// Nobody wants what is under way any more. The next one waits for the event loop: the workspace may be
// telling of a change.
void SegmentJobs::drop() {
  change_.giveUpAll();
  takeLater_ = nullptr;
  waiting_.pop_front();
  QMetaObject::invokeMethod(
      this, [this] { next(); }, Qt::QueuedConnection);
}

void SegmentJobs::measure(const std::shared_ptr<const LabelMap>& labels, int number,
                          const VolumePtr& volume) {
  measure_.giveUpAll();
  measure_.run(
      tr("Measuring segments"),
      [labels, number, volume](const Job&) { return segmentNumbersOf(labels, number, volume); },
      [this](const SegmentNumbers& numbers) { Q_EMIT measured(numbers); });
}

void SegmentJobs::save(const SegmentMap& map, const Series& series, const QString& path) {
  save_.run(
      tr("Exporting segments"),
      [map, series, path](const Job& job) {
        const Segmented segments{map.segments, *map.labels};
        return exportSegments(path.toStdString(), {&segments, 1}, series, {}, job.cancel());
      },
      [this, map](const Result<ExportedSegments>& done) {
        if (!done) return Q_EMIT failed(QString::fromStdString(done.message()));
        const auto texts = [](const std::vector<std::string>& all) {
          QStringList list;
          for (const std::string& text : all) list << shownText(text);
          return list;
        };
        Q_EMIT saved(texts(done->files), texts(done->notes), map);
      });
}

}  // namespace volumen
