#include "ui/controller/measure_jobs.h"

#include <algorithm>
#include <limits>

#include "ui/workspace/measurements.h"
#include "ui/workspace/text.h"
#include "ui/workspace/value_text.h"
#include "viewer/measure/outline.h"
#include "viewer/measure/scaled.h"

namespace volumen {

namespace {

// Estimates the work of a measurement. Regions take about one step per edge of the outline and voxel of the
// box, and one per pair of edges.
double stepsOf(const Shape& shape, const VoxelGeometry& geometry) {
  if (shape.kind == ShapeKind::volume) return std::numeric_limits<double>::infinity();
  constexpr double stepsAPiece = 256;  // of a curve
  if (shape.kind == ShapeKind::openCurve) return stepsAPiece * double(shape.points.size());
  if (!ruleOf(shape.kind).region || !checkShape(shape)) return double(shape.points.size());
  const Outline outline = outlineOf(shape);
  const glm::dvec3 spacing = geometry.spacing();
  const double voxel = std::min({spacing.x, spacing.y, spacing.z}), edges = double(outline.corners.size());
  const glm::dvec2 size = (outline.high - outline.low) / voxel + 1.0;
  return edges * (size.x * size.y + edges);
}

// In SUV each voxel has a sphere of its own, whose voxels are found first.
double stepsOn(const Shape& shape, const Volume& volume, const std::string& unit) {
  const double steps = stepsOf(shape, volume.geometry());
  if (!ruleOf(shape.kind).region || !isSuv(unit)) return steps;
  return steps * (1 + 2 * 1000 / volume.geometry().voxelVolume()) + 1e6;
}

// The second series measured beside the first.
struct Second {
  VolumePtr volume;  // null if there is none
  Rigid toFromUnder;
  ValueScale scale;
};

Result<Measured> measureBoth(const Shape& shape, const Volume& volume, const ValueScale& scale,
                             const Second& second, const CancelToken& cancel) {
  Result<Measured> measured = scaled(measure(shape, volume, scale.unit, cancel), scale.factor);
  if (!measured || !second.volume) return measured;
  addOther(*measured, shape, *second.volume, second.toFromUnder, second.scale.unit, cancel);
  if (measured->other) scaleOther(*measured, second.scale.factor);
  return measured;
}

constexpr double mostStepsAtOnce = 2e5;  // well below 2 ms

}  // namespace

MeasureJobs::MeasureJobs(const Session& session, FrameService& frames, QObject* parent)
    : QObject(parent), session_(session), frames_(frames) {
  connect(&session_, &Session::preferencesChanged, this,
          [this](const Preferences& before, const Preferences& after) {
            if (before.petUnit != after.petUnit) Q_EMIT measured();
          });
  connect(&frames_, &FrameService::ready, this, [this](int view) { endRead(view); });
  connect(&frames_, &FrameService::failed, this, [this](int view, const FrameKey& key, const QString& why) {
    if (view == measuredId) unread_[key] = {why.toStdString(), std::chrono::steady_clock::now()};
    endRead(view);
  });
  connect(&frames_, &FrameService::held, this, &MeasureJobs::forgetUnread);
}

// Queries the pool only after a change, because a query counts as use there.
MeasuredPtr MeasureJobs::numbersOf(const Measurement& measurement) {
  Known& known = known_[measurement.id];
  if (measurement.shape.frame) {
    if (known.series != measurement.series || known.shape != measurement.shape ||
        known.petUnit != shownPetUnit())
      requestOnFrame(measurement);
    return known.series == measurement.series ? known.numbers : nullptr;
  }
  const VolumePtr volume = known.volume.lock();
  const auto& all = session_.workspace().series;
  const auto state = all.find(measurement.series);
  const Over over = overOf(measurement);
  const bool overIsCurrent =
      known.over == over.place && known.overVolume.lock() == (over.series ? over.series->volume : nullptr);
  const bool current = overIsCurrent && known.series == measurement.series &&
                       known.shape == measurement.shape && volume && known.petUnit == shownPetUnit() &&
                       state != all.end() && known.mask == state->second.mask;
  if (!current) {
    const LoadedSeriesPtr series = session_.seriesNamed(measurement.series);
    if (series && (known.series != measurement.series || known.shape != measurement.shape ||
                   volume != series->volume || known.petUnit != shownPetUnit() || !overIsCurrent))
      request(measurement, series, over);
  }
  return known.series == measurement.series ? named(known) : nullptr;
}

// Adds the names of both series as shown now; they change when names are hidden.
MeasuredPtr MeasureJobs::named(Known& known) const {
  const auto& [under, over] = known.both;
  const bool isOfBoth = known.numbers && *known.numbers && (*known.numbers)->other && under && over;
  if (!isOfBoth) return known.numbers;
  if (!(*known.numbers)->source.empty() && known.namesHidden == namesHidden()) return known.numbers;
  Measured measured = **known.numbers;
  measured.source = seriesText(*under).toStdString();
  measured.other->source = seriesText(*over).toStdString();
  known.namesHidden = namesHidden();
  known.numbers = std::make_shared<const Result<Measured>>(std::move(measured));
  return known.numbers;
}

MeasuredPtr MeasureJobs::exactNumbersOf(const Measurement& measurement) {
  MeasuredPtr numbers = numbersOf(measurement);
  const Known& known = known_[measurement.id];
  return known.shape == measurement.shape && known.shown == known.asked ? numbers : nullptr;
}

MeasureJobs::Over MeasureJobs::overOf(const Measurement& measurement) const {
  Over over;
  if (ruleOf(measurement.shape.kind).region)
    over.place = seriesOver(session_.workspace(), measurement.series);
  if (over.place) over.series = session_.seriesNamed(over.place->series);
  return over;
}

// Begins a new shape of a measurement. Its last results stay if the kind is the same.
MeasureJobs::Known& MeasureJobs::begin(const Measurement& measurement) {
  Known& known = known_[measurement.id];
  if (known.series != measurement.series || known.shape.kind != measurement.shape.kind)
    known.numbers.reset(), known.shown = asked_;
  known.series = measurement.series;
  known.shape = measurement.shape;
  known.mask = session_.maskOf(measurement.series);
  known.petUnit = shownPetUnit();
  known.asked = ++asked_;
  return known;
}

void MeasureJobs::request(const Measurement& measurement, const LoadedSeriesPtr& series, const Over& over) {
  Known& known = begin(measurement);
  known.volume = series->volume;
  known.over = over.place;
  known.overVolume = over.series ? over.series->volume : nullptr;
  const ValueScale scale = shownScale(series->series);
  const Shape& shape = measurement.shape;
  double steps = stepsOn(shape, *series->volume, scale.unit);
  Second second;
  Both both;
  if (over.series) {
    second = {over.series->volume, over.place->toFromUnder, shownScale(over.series->series)};
    const auto& all = session_.workspace().series;
    both = {all.at(measurement.series).series, all.at(over.place->series).series};
    steps += stepsOn(shape, *second.volume, second.scale.unit);
  }
  const auto run = [shape, volume = series->volume, scale, second](const CancelToken& cancel) {
    return measureBoth(shape, *volume, scale, second, cancel);
  };
  start(measurement.id, run, steps, both);
}

// Reads frames that are not in memory, one at a time. Listeners then request the results again.
void MeasureJobs::requestOnFrame(const Measurement& measurement) {
  const auto& all = session_.workspace().series;
  const auto state = all.find(measurement.series);
  if (state == all.end() || state->second.missing) return;
  const auto index = frameMeant(*state->second.series, *measurement.shape.frame);
  const FrameKey key{measurement.series, index.value_or(-1)};
  const LoadedFramePtr frame = index ? frames_.find(key) : nullptr;
  std::optional<Error> problem;
  if (!index) problem = Error{"The series does not hold its picture."};
  if (const auto unread = unread_.find(key); !frame && unread != unread_.end())
    problem = Error{unread->second.why};
  if (!frame && !problem) {
    if (read_) return;
    read_ = key;
    return frames_.request(measuredId, state->second.series, *index, 1);
  }
  const Known& known = begin(measurement);
  if (problem) return take(measurement.id, known.asked, *problem);
  const auto run = [shape = measurement.shape, frame,
                    scale = shownScale(frame->slice->series)](const CancelToken&) {
    return scaled(measureOnFrame(shape, pixelsOf(*frame), scale.unit), scale.factor);
  };
  start(measurement.id, run, stepsOf(inSliceSpace(measurement.shape, frame->geometry()), frame->geometry()));
}

// A frame of the series was read, so frames that failed some time ago are retried.
void MeasureJobs::forgetUnread(const SeriesKey& series) {
  const auto before = std::chrono::steady_clock::now() - std::chrono::milliseconds(FrameService::tryAgainMs);
  const auto forgotten = std::erase_if(
      unread_, [&](const auto& entry) { return entry.first.series == series && entry.second.at <= before; });
  if (forgotten == 0) return;
  for (auto& [id, known] : known_)
    if (known.series == series && known.shape.frame && known.numbers && !*known.numbers) known.shape = {};
  Q_EMIT measured();
}

void MeasureJobs::endRead(int view) {
  if (view != measuredId) return;
  frames_.drop(measuredId);
  read_.reset();
  Q_EMIT measured();
}

void MeasureJobs::start(int id, const Measure& measure, double steps, const Both& both) {
  Known& known = known_[id];
  if (steps <= mostStepsAtOnce) return take(id, known.asked, measure(CancelToken()), both);
  lane_.giveUpWaiting(known.job);
  known.job = lane_.run(
      {}, [measure](const Job& job) { return measure(job.cancel()); },
      [this, id, asked = known.asked, both](Result<Measured> result) {
        take(id, asked, std::move(result), both);
        Q_EMIT measured();
      });
}

void MeasureJobs::take(int id, int asked, Result<Measured> result, const Both& both) {
  Known& known = known_[id];
  if (asked < known.shown) return;
  known.shown = asked;
  known.both = both;
  known.numbers = std::make_shared<const Result<Measured>>(std::move(result));
}

}  // namespace volumen
