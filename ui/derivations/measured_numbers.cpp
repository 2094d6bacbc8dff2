#include "ui/derivations/measured_numbers.h"

#include <QSignalBlocker>
#include <algorithm>
#include <limits>

#include "results/series/loaded_frame.h"
#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/workspace/measurements.h"
#include "ui/workspace/when_changed.h"
#include "viewer/measure/outline.h"
#include "viewer/measure/scaled.h"

namespace volumen {

namespace {

constexpr double mostStepsAtOnce = 2e5;  // well below 2 ms

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
double stepsOn(const Shape& shape, const LoadedSeries& series, PetUnit unit) {
  const VoxelGeometry& geometry = series.volume->geometry();
  const double steps = stepsOf(shape, geometry);
  if (!ruleOf(shape.kind).region || !isSuv(valueScale(series.series, unit).unit)) return steps;
  return steps * (1 + 2 * 1000 / geometry.voxelVolume()) + 1e6;
}

// `over` is null if there is no second series.
Result<Measured> measureBoth(const NumbersKey& key, const LoadedSeries& under, const LoadedSeries* over,
                             const CancelToken& cancel) {
  const Shape& shape = key.measurement.shape;
  const ValueScale scale = valueScale(under.series, key.petUnit);
  Result<Measured> measured = scaled(measure(shape, *under.volume, scale.unit, cancel), scale.factor);
  if (!measured || !over) return measured;
  const ValueScale second = valueScale(over->series, key.petUnit);
  addOther(*measured, shape, *over->volume, key.over->toFromUnder, second.unit, cancel);
  if (measured->other) scaleOther(*measured, second.factor);
  return measured;
}

bool isSame(const std::weak_ptr<const Volume>& a, const std::weak_ptr<const Volume>& b) {
  return !a.owner_before(b) && !b.owner_before(a);
}

// Returns whether numbers of `b` stand for those of `a` until these are computed.
bool areVersions(const Measurement& a, const Measurement& b) {
  return a.id == b.id && a.series == b.series && a.shape.kind == b.shape.kind;
}

MeasuredPtr told(Result<Measured> measured) {
  return std::make_shared<const Result<Measured>>(std::move(measured));
}

}  // namespace

bool NumbersKey::operator==(const NumbersKey& other) const {
  return measurement == other.measurement && petUnit == other.petUnit && isSame(volume, other.volume) &&
         over == other.over && isSame(overVolume, other.overVolume);
}

std::optional<NumbersKey> numbersKeyOf(const Session& session, const Measurement& measurement) {
  const auto& all = session.workspace().series;
  const auto state = all.find(measurement.series);
  if (state == all.end()) return {};
  NumbersKey key{measurement, shownPetUnit()};
  key.measurement.textOffset.reset();
  if (measurement.shape.frame) return state->second.missing ? std::nullopt : std::optional(key);
  const LoadedSeriesPtr series = session.seriesNamed(measurement.series);
  if (!series) return {};
  key.volume = series->volume;
  if (ruleOf(measurement.shape.kind).region) key.over = seriesOver(session.workspace(), measurement.series);
  if (const LoadedSeriesPtr over = key.over ? session.seriesNamed(key.over->series) : nullptr)
    key.overVolume = over->volume;
  return key;
}

MeasuredNumbers::MeasuredNumbers(const Session& session, FrameService& frames)
    : session_(session), frames_(frames), numbers_(rule(), session, nullptr) {
  whenChanged(
      session, this,
      [this] {
        drawn_.reset();
        numbers_.update();
      },
      &Workspace::measurements);
  connect(&numbers_, &Numbers::changed, this, &MeasuredNumbers::changed);
  numbers_.update();
}

MeasuredNumbers::Numbers::Rule MeasuredNumbers::rule() {
  return {.wanted = [this] { return wanted(); },
          .work = [this](const NumbersKey& key, std::size_t) { return workOf(key); },
          .name = [](const NumbersKey&) { return JobName(); },
          .bytes = [](const Result<Measured>&) { return std::size_t(0); },
          .areVersions = [](const NumbersKey& a,
                            const NumbersKey& b) { return areVersions(a.measurement, b.measurement); },
          .finishesVersions = true,
          .isQuick = [this](const NumbersKey& key) { return isQuick(key); },
          .isKept =
              [this](const NumbersKey& key) {
                const Measurement* m = findMeasurement(session_.workspace(), key.measurement.id);
                return m && areVersions(*m, key.measurement);
              },
          .tryAgainMs = FrameService::tryAgainMs,
          .lacksMemory = outOfMemory};
}

std::vector<NumbersKey> MeasuredNumbers::wanted() const {
  std::vector<NumbersKey> keys;
  const auto add = [&](const Measurement& measurement) {
    if (auto key = numbersKeyOf(session_, measurement)) keys.push_back(std::move(*key));
  };
  if (drawn_) add(*drawn_);
  for (const Measurement& measurement : session_.workspace().measurements) add(measurement);
  return keys;
}

MeasuredNumbers::Numbers::Work MeasuredNumbers::workOf(const NumbersKey& key) const {
  const Measurement& m = key.measurement;
  if (m.shape.frame)
    return [key, series = session_.workspace().series.at(m.series).series,
            &frames = frames_](const Job& job) -> Result<MeasuredPtr> {
      const Shape& shape = key.measurement.shape;
      const auto index = frameMeant(*series, *shape.frame);
      if (!index) return told(Error{"The series does not hold its picture."});
      const Result<LoadedFramePtr> frame = frames.readNow(series, *index, job.cancel());
      if (!frame) return frame.error();
      const ValueScale scale = valueScale((*frame)->slice->series, key.petUnit);
      return told(scaled(measureOnFrame(shape, pixelsOf(**frame), scale.unit), scale.factor));
    };
  return [key, under = session_.seriesNamed(m.series),
          over = key.over ? session_.seriesNamed(key.over->series)
                          : nullptr](const Job& job) -> Result<MeasuredPtr> {
    return told(measureBoth(key, *under, over.get(), job.cancel()));
  };
}

// Frames that are not in memory are read first.
bool MeasuredNumbers::isQuick(const NumbersKey& key) const {
  const auto& [id, of, shape, offset] = key.measurement;
  if (shape.frame) {
    const auto index = frameMeant(*session_.workspace().series.at(of).series, *shape.frame);
    if (!index) return true;
    const LoadedFramePtr frame = frames_.find({of, *index});
    return frame && stepsOf(inSliceSpace(shape, frame->geometry()), frame->geometry()) <= mostStepsAtOnce;
  }
  double steps = stepsOn(shape, *session_.seriesNamed(of), key.petUnit);
  if (const LoadedSeriesPtr over = key.over ? session_.seriesNamed(key.over->series) : nullptr)
    steps += stepsOn(shape, *over, key.petUnit);
  return steps <= mostStepsAtOnce;
}

MeasuredPtr MeasuredNumbers::numbersOf(const Measurement& measurement) {
  return numbersOf(measurement, false);
}

MeasuredPtr MeasuredNumbers::exactNumbersOf(const Measurement& measurement) {
  return numbersOf(measurement, true);
}

MeasuredPtr MeasuredNumbers::numbersOf(const Measurement& measurement, bool isExact) {
  if (!findMeasurement(session_.workspace(), measurement.id) && drawn_ != measurement) {
    const QSignalBlocker quiet(numbers_);  // its only reader is asking
    drawn_ = measurement;
    numbers_.update();
  }
  const auto key = isExact ? numbersKeyOf(session_, measurement) : std::nullopt;
  const auto entry = std::ranges::find_if(numbers_.entries(), [&](const Numbers::Entry& one) {
    if (!areVersions(one.key.measurement, measurement)) return false;
    return !isExact || (key ? one.key == *key : one.key.measurement.shape == measurement.shape);
  });
  return entry == numbers_.entries().end() ? nullptr : named(*entry);
}

// Adds the names of both series as shown now; they change when names are hidden.
MeasuredPtr MeasuredNumbers::named(const Numbers::Entry& entry) const {
  if (!entry.value) return told(Error{entry.whyNot});
  const auto& all = session_.workspace().series;
  const Result<Measured>& measured = *entry.value;
  if (!measured || !measured->other) return entry.value;
  const auto under = all.find(entry.key.measurement.series), over = all.find(entry.key.over->series);
  if (under == all.end() || over == all.end()) return entry.value;
  Measured named = *measured;
  named.source = seriesText(*under->second.series).toStdString();
  named.other->source = seriesText(*over->second.series).toStdString();
  return told(std::move(named));
}

}  // namespace volumen
