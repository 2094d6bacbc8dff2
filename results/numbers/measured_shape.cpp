#include "results/numbers/measured_shape.h"

#include <optional>

#include "io/frames.h"
#include "results/series/loaded_frame.h"
#include "viewer/measure/scaled.h"
#include "viewer/scene/json_fields.h"

namespace volumen {

namespace {

// The series and index of the image on which a shape is drawn.
struct FrameOfStudy {
  const Series* series = nullptr;
  int index = 0;
};

std::optional<FrameOfStudy> findFrame(const std::vector<Series>& all, const ShapeFrame& name) {
  for (const Series& series : all)
    if (const auto index = frameMeant(series, name)) return FrameOfStudy{&series, *index};
  return {};
}

}  // namespace

MeasuredShape measuredOnFrame(const Shape& shape, const std::vector<Series>& all, const ScaleOf& scaleOf) {
  const auto found = findFrame(all, *shape.frame);
  if (!found)
    return {Error{"No picture here has the instance " + JsonFields::quoted(shape.frame->instance) +
                  " and a frame " + std::to_string(shape.frame->number) + "."}};
  MeasuredShape out{Measured{}, found->series, found->index};
  const auto failed = [&](const Error& error) {
    out.measured = error;
    return out;
  };
  Result<Frame> frame = loadFrame(*found->series, found->index);
  if (!frame) return failed(frame.error());
  const Result<LoadedFramePtr> shown =
      shownFrame(*found->series, {keyOf(*found->series), found->index}, std::move(*frame));
  if (!shown) return failed(shown.error());
  const auto scale = scaleOf((*shown)->slice->series);
  if (!scale) return failed(scale.error());
  out.measured = scaled(measureOnFrame(shape, pixelsOf(**shown), scale->unit), scale->factor);
  out.pixelMm = (*shown)->pixel.mm;
  return out;
}

MeasuredShape measuredShape(const ShapeToMeasure& one, const std::vector<Series>& frames,
                            const CancelToken& cancel) {
  const auto scaleOf = [](const Series& series) { return valueScale(series, PetUnit::suvBodyWeight); };
  if (!one.volume) return measuredOnFrame(one.shape, frames, scaleOf);
  const ValueScale scale = scaleOf(one.volume->series);
  return {scaled(measure(one.shape, *one.volume->volume, scale.unit, cancel), scale.factor)};
}

MeasuredOn placeIn(const ShapesVolume& volume, bool isTiled) {
  return {&volume.series, volume.volume->geometry(), volume.origins, volume.places, isTiled};
}

MeasuredOn placeOn(const MeasuredShape& frame) {
  return {frame.series, {}, {}, {}, false, frame.frame, frame.pixelMm};
}

}  // namespace volumen
