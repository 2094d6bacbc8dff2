#include "ui/controller/measurer.h"

#include <algorithm>
#include <limits>

#include "viewer/measure/outline.h"

namespace volumen {

namespace {

// Of a region about one for each edge of its outline and voxel of its box, and one for each pair of edges.
double stepsOf(const Shape& shape, const VoxelGeometry& geometry) {
  if (shape.kind == ShapeKind::volume) return std::numeric_limits<double>::infinity();
  if (!ruleOf(shape.kind).region || !checkShape(shape)) return double(shape.points.size());
  const Outline outline = outlineOf(shape);
  const glm::dvec3 spacing = geometry.spacing();
  const double voxel = std::min({spacing.x, spacing.y, spacing.z}), edges = double(outline.corners.size());
  const glm::dvec2 size = (outline.high - outline.low) / voxel + 1.0;
  return edges * (size.x * size.y + edges);
}

constexpr double mostStepsAtOnce = 2e5;  // well below 2 ms

}  // namespace

Measurer::Measurer(const Session& session, QObject* parent) : QObject(parent), session_(session) {
  pool_.setMaxThreadCount(1);
}

Measurer::~Measurer() {
  closing_.cancel();
  pool_.clear();
  pool_.waitForDone();
}

// The pool is asked only where something changed: being asked for counts as use there.
MeasuredPtr Measurer::numbersOf(const Measurement& measurement) {
  const Known& known = known_[measurement.id];
  const VolumePtr volume = known.volume.lock();
  const auto& all = session_.workspace().series;
  const auto state = all.find(measurement.series);
  const bool current = known.series == measurement.series && known.shape == measurement.shape && volume &&
                       state != all.end() && known.mask == state->second.mask;
  if (!current) {
    const ShownSeriesPtr series = session_.seriesNamed(measurement.series);
    if (series &&
        (known.series != measurement.series || known.shape != measurement.shape || volume != series->volume))
      request(measurement, series);
  }
  return known.series == measurement.series ? known.numbers : nullptr;
}

MeasuredPtr Measurer::exactNumbersOf(const Measurement& measurement) {
  MeasuredPtr numbers = numbersOf(measurement);
  const Known& known = known_[measurement.id];
  return known.shape == measurement.shape && known.shown == known.asked ? numbers : nullptr;
}

void Measurer::request(const Measurement& measurement, const ShownSeriesPtr& series) {
  Known& known = known_[measurement.id];
  if (known.series != measurement.series || known.shape.kind != measurement.shape.kind)
    known.numbers.reset(), known.shown = jobs_;
  known.series = measurement.series;
  known.shape = measurement.shape;
  known.mask = session_.maskOf(measurement.series);
  known.volume = series->volume;
  known.asked = ++jobs_;
  Job job{measurement.id, known.asked, measurement.shape, series->volume, series->series.unit};
  if (stepsOf(job.shape, job.volume->geometry()) <= mostStepsAtOnce)
    return take(job, measure(job.shape, *job.volume, job.unit));
  {
    const std::lock_guard lock(mutex_);
    std::erase_if(waiting_, [&](const Job& other) { return other.id == job.id; });
    waiting_.push_back(std::move(job));
  }
  pool_.start([this] { runNext(); });
}

void Measurer::runNext() {
  Job job;
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.empty()) return;
    job = std::move(waiting_.front());
    waiting_.erase(waiting_.begin());
  }
  Result<Measured> result = measure(job.shape, *job.volume, job.unit, closing_);
  QMetaObject::invokeMethod(
      this,
      [this, job = std::move(job), result = std::move(result)] {
        take(job, result);
        Q_EMIT measured();
      },
      Qt::QueuedConnection);
}

void Measurer::take(const Job& job, Result<Measured> result) {
  Known& known = known_[job.id];
  if (job.number < known.shown) return;
  known.shown = job.number;
  known.numbers = std::make_shared<const Result<Measured>>(std::move(result));
}

}  // namespace volumen
