#include "results/numbers/measured_shape.h"

#include <algorithm>
#include <numeric>

#include "io/frames.h"
#include "viewer/measure/scaled.h"
#include "viewer/scene/json_fields.h"

namespace volumen {

Result<FramesToMeasure::Found> FramesToMeasure::find(const ShapeFrame& name) {
  for (const Series& series : all_) {
    const auto index = frameMeant(series, name);
    if (!index) continue;
    const FrameKey key{keyOf(series), *index};
    if (last_ && last_->key == key) return Found{&series, *index, last_};
    Result<Frame> frame = loadFrame(series, *index);
    if (!frame) return Found{&series, *index, frame.error()};
    const Result<LoadedFramePtr> shown = shownFrame(series, key, std::move(*frame));
    if (shown) last_ = *shown;
    return Found{&series, *index, shown};
  }
  return Error{"No picture here has the instance " + JsonFields::quoted(name.instance) + " and a frame " +
               std::to_string(name.number) + "."};
}

namespace {

MeasuredShape measuredOnFrame(const Shape& shape, FramesToMeasure& frames, const ScaleOf& scaleOf) {
  const auto found = frames.find(*shape.frame);
  if (!found) return {found.error()};
  MeasuredShape out{Measured{}, found->series, found->index};
  if (!found->frame) return out.measured = found->frame.error(), out;
  const LoadedFrame& frame = **found->frame;
  const auto scale = scaleOf(frame.slice->series);
  if (!scale) return out.measured = scale.error(), out;
  out.measured = scaled(measureOnFrame(shape, pixelsOf(frame), scale->unit), scale->factor);
  out.pixelMm = frame.pixel.mm;
  return out;
}

MeasuredShape measuredShape(const ShapeToMeasure& one, FramesToMeasure& frames, const ScaleOf& scaleOf,
                            const CancelToken& cancel) {
  if (!one.volume) return measuredOnFrame(one.shape, frames, scaleOf);
  const auto scale = scaleOf(one.volume->series);
  if (!scale) return {scale.error()};
  return {scaled(measure(one.shape, *one.volume->volume, scale->unit, cancel), scale->factor)};
}

}  // namespace

std::vector<MeasuredShape> measuredShapes(std::span<const ShapeToMeasure> shapes, FramesToMeasure& frames,
                                          const ScaleOf& scaleOf, const CancelToken& cancel) {
  std::vector<std::size_t> byFrame(shapes.size());
  std::iota(byFrame.begin(), byFrame.end(), std::size_t(0));
  std::ranges::stable_sort(byFrame, {}, [&](std::size_t n) {
    const auto& frame = shapes[n].shape.frame;
    return frame ? std::pair(frame->instance, frame->number) : std::pair(std::string(), 0);
  });
  std::vector<MeasuredShape> all(shapes.size(), {Error{"Interrupted."}});
  for (const std::size_t n : byFrame) {
    if (cancel.cancelled()) break;
    all[n] = measuredShape(shapes[n], frames, scaleOf, cancel);
  }
  return all;
}

std::vector<MeasuredShape> measuredShapes(std::span<const ShapeToMeasure> shapes, FramesToMeasure& frames,
                                          const CancelToken& cancel) {
  const auto scaleOf = [](const Series& series) { return valueScale(series, PetUnit::suvBodyWeight); };
  return measuredShapes(shapes, frames, scaleOf, cancel);
}

MeasuredOn placeIn(const ShapesVolume& volume, bool isTiled) {
  return {&volume.series, volume.volume->geometry(), volume.origins, volume.places, isTiled};
}

MeasuredOn placeOn(const MeasuredShape& frame) {
  return {frame.series, {}, {}, {}, false, frame.frame, frame.pixelMm};
}

}  // namespace volumen
