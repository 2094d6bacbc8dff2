#include "ui/controller/segment_jobs.h"

#include <algorithm>
#include <new>
#include <utility>

#include "results/numbers/series_columns.h"
#include "results/segments/segment_maps.h"
#include "results/segments/segment_record.h"
#include "results/segments/segments.h"
#include "results/text/text.h"
#include "ui/controller/segment_target.h"
#include "ui/controller/segments_on_slices.h"
#include "ui/workspace/segment_change_text.h"
#include "ui/workspace/series_segments.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

// Returns the map after the work on segment `number`; runs on the job's thread.
Result<SegmentMap> workDone(const SegmentWork& work, const SegmentMap& map, int number,
                            const CancelToken& cancel) {
  if (work.makeAll) {
    Result<SegmentMap> made = work.makeAll(map, cancel);
    return made ? withHandMade(map, std::move(*made)) : made;
  }
  if (!work.steps) return withoutSegment(map, number);
  const Result<StepsWanted> wanted = work.steps(map, number, cancel);
  return wanted ? withStepsDone(map, *wanted, *work.volume, cancel) : Result<SegmentMap>(wanted.error());
}

// Returns the maps that the work starts from.
std::vector<SegmentMap> basesOf(const Workspace& workspace, const SegmentWork& work) {
  const VoxelGeometry& grid = work.volume->geometry();
  if (work.makeMaps) return segmentMapsOn(workspace, work.series, grid);
  return {segmentMapOn(workspace, work.series, grid, work.map)};
}

// Returns the maps after the work.
Result<std::vector<SegmentMap>> mapsMade(const SegmentWork& work, const std::vector<SegmentMap>& bases,
                                         int number, const CancelToken& cancel) {
  if (work.makeMaps) return work.makeMaps(bases, cancel);
  Result<SegmentMap> made = workDone(work, bases.front(), number, cancel);
  if (!made) return made.error();
  return std::vector<SegmentMap>{std::move(*made)};
}

Workspace withMade(const Workspace& workspace, const SegmentWork& work, const std::vector<SegmentMap>& bases,
                   const std::vector<SegmentMap>& made) {
  if (work.makeMaps) return withSegmentMapsOf(workspace, made);
  std::vector<SegmentMap> all;
  for (const SegmentMap* map : segmentMapsOf(workspace, work.series)) all.push_back(*map);
  return withSegmentMap(workspace, withNewOnesApart(bases.front(), made.front(), all));
}

}  // namespace

SegmentWork workShown(const Session& session, const QString& text, const QString& doing) {
  SegmentWork work;
  work.series = keyOf(session.series()->series);
  work.volume = wholeVolume(session);
  work.text = text;
  work.doing = doing;
  return work;
}

SegmentJobs::SegmentJobs(Session& session, const SegmentPainter& painter, Jobs& jobs, QObject* parent)
    : QObject(parent), session_(session), painter_(painter), change_(&jobs), save_(&jobs) {
  save_.keepToTheEnd();
  const auto dropIfClosed = [this] {
    if (isMaking() && !session_.workspace().series.contains(waiting_.front().series)) drop();
  };
  whenChanged(session_, this, dropIfClosed, &Workspace::series);
  // From the event loop, because Esc undoes the steps since the press once the stroke has ended.
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
  if (!work.map) {
    const SegmentMap* worked = segmentMapOf(session_.workspace(), work.series);
    waiting_.back().map = worked ? worked->number : 0;
  }
  next();
}

void SegmentJobs::next() {
  while (!isMaking() && !waiting_.empty()) {
    const SegmentWork work = waiting_.front();
    QString why;
    if (session_.workspace().series.contains(work.series)) {
      const std::vector<SegmentMap> bases = basesOf(session_.workspace(), work);
      const SegmentMap& base = bases.front();
      const Segment* segment = findSegment(base, work.number);
      if (missesSegments(session_.workspace(), work.series))
        why = tr("The segments of this series were not found with the session: no others are made.");
      else if (work.makeAll || work.makeMaps)
        return begin(work, bases);
      else if (work.number == 0 && !freeNumber(base))
        why = tr("There are 255 segments, and no more fit: remove one first.");
      else if (segment && segment->locked)
        why = tr("%1 is locked: unlock it first.").arg(shownText(segment->label));
      else if (segment || work.number == 0)
        return begin(work, bases);
    }
    waiting_.pop_front();  // before reporting, because a listener may request another change
    if (!why.isEmpty()) refuse(work, why);
  }
  if (waiting_.empty()) Q_EMIT ended();
}

void SegmentJobs::begin(const SegmentWork& work, const std::vector<SegmentMap>& bases) {
  Workspace with = session_.workspace();
  int number = work.number;
  if (work.makeAll || work.makeMaps) {
    // The work chooses its segments itself.
  } else if (number == 0) {
    Segment made;
    if (work.change) work.change(made);
    with = withNewSegment(std::move(with), work.series, work.volume->geometry(), std::move(made), work.map);
    number = segmentMapOf(with, work.series, *work.map)->current;
  } else if (work.change) {
    with = withSegmentChanged(withMapWorkedOn(std::move(with), work.series, *work.map), work.series, number,
                              work.change);
  }
  change_.run(
      JobName(work.doing),
      [work, number, maps = basesOf(with, work)](const Job& job) {
        Made made{mapsMade(work, maps, number, job.cancel()), {}};
        // Work on several maps reports itself what it took.
        if (made.maps && !work.makeMaps) made.said = changeText(maps.front(), made.maps->front());
        return made;
      },
      [this, bases](const Made& made) { take(bases, made); }, [this] { drop(); });
}

// Makes one undo step if the segments are unchanged since the start; otherwise repeats the work.
void SegmentJobs::take(const std::vector<SegmentMap>& bases, const Made& made) {
  if (painter_.isPainting()) {
    takeLater_ = [this, bases, made] { take(bases, made); };
    return;
  }
  const SegmentWork work = waiting_.front();
  const Workspace& workspace = session_.workspace();
  const bool isSame = basesOf(workspace, work) == bases;
  if (isSame || !made.maps) waiting_.pop_front();
  if (!made.maps) {
    refuse(work, shownText(made.maps.message()));
  } else if (isSame) {
    session_.endGesture();
    session_.change(work.text, withMade(workspace, work, bases, *made.maps));
    session_.endGesture();
    if (!made.said.isEmpty()) Q_EMIT answered({SegmentAnswer::Kind::done, made.said});
    if (work.done) work.done();
  }
  next();
}

void SegmentJobs::refuse(const SegmentWork& work, const QString& why) {
  if (work.refused) work.refused(why);
  Q_EMIT answered({SegmentAnswer::Kind::failed, why});
}

// Drops the work in progress. The next one starts from the event loop, because the workspace may be reporting
// a change.
void SegmentJobs::drop() {
  change_.giveUpAll();
  takeLater_ = nullptr;
  waiting_.pop_front();
  QMetaObject::invokeMethod(
      this, [this] { next(); }, Qt::QueuedConnection);
}

void SegmentJobs::save(const std::vector<SegmentMap>& maps, const Series& series, const QString& path) {
  write(
      [maps, series, path,
       named = asNamedInFiles(series)](const CancelToken& cancel) -> Result<ExportedSegments> {
        const bool isDicom = path.endsWith(QLatin1String(".dcm"), Qt::CaseInsensitive);
        const auto segments = isDicom ? segmentedOnSlices(maps, series, cancel) : segmentedOf(maps);
        if (!segments) return segments.error();
        return exportSegments(path.toStdString(), *segments, isDicom ? series : named, {}, cancel);
      },
      maps);
}

void SegmentJobs::saveSurfaces(const std::shared_ptr<const std::vector<SurfaceToWrite>>& surfaces,
                               const Series& series, const std::vector<std::string>& files) {
  write([surfaces, series = asNamedInFiles(series),
         files](const CancelToken& cancel) { return exportSurfaces(files, *surfaces, series, cancel); },
        {});
}

void SegmentJobs::write(const Writing& writing, const std::vector<SegmentMap>& maps) {
  save_.run(
      tr("Exporting segments"), [writing](const Job& job) { return writing(job.cancel()); },
      [this, maps](const Result<ExportedSegments>& done) {
        if (!done)
          return Q_EMIT answered({SegmentAnswer::Kind::failed, QString::fromStdString(done.message())});
        const auto texts = [](const std::vector<std::string>& all) {
          QStringList list;
          for (const std::string& text : all) list << shownText(text);
          return list;
        };
        Q_EMIT saved(texts(done->files), texts(done->notes), maps);
      });
}

}  // namespace volumen
