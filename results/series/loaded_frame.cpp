#include "results/series/loaded_frame.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace volumen {

namespace {

VoxelGeometry geometryOf(const Frame& frame) {
  VoxelGeometry geometry{.size = {frame.size, 1}, .calibrated = frame.place.has_value()};
  const glm::dvec2 mm = frame.pixel.mm;
  const FramePlace place = frame.place.value_or(FramePlace{});
  const glm::dvec3 normal = glm::normalize(glm::cross(place.row, place.column));
  // As thick as its pixels are wide, so that the smallest spacing is that of the pixels.
  geometry.patientFromVoxelStep = {mm.x * place.row, mm.y * place.column, std::min(mm.x, mm.y) * normal};
  geometry.origin = place.origin;
  return geometry;
}

Result<VolumePtr> volumeOf(const VoxelGeometry& geometry, PixelValues values,
                           const std::optional<ValueRange>& padding = {}) {
  std::vector<std::string> warnings;
  VolumeParts parts;
  parts.geometry = geometry;
  parts.values = std::move(values.stored);
  parts.slope = values.slope;
  parts.intercept = values.intercept;
  parts.attributes.padding = padding;
  return Volume::make(std::move(parts), warnings);
}

PixelValues bytes(std::vector<std::uint8_t> stored) { return {std::move(stored), 1, 0}; }

std::vector<std::uint8_t> channel(const Frame& frame, std::size_t which) {
  std::vector<std::uint8_t> values(frame.rgb.size() / 3);
  for (std::size_t n = 0; n < values.size(); ++n) values[n] = frame.rgb[3 * n + which];
  return values;
}

std::vector<std::uint8_t> allOverlays(const Frame& frame) {
  std::vector<std::uint8_t> mask = frame.overlays.front().mask;
  for (const FrameOverlay& overlay : frame.overlays)
    std::ranges::transform(mask, overlay.mask, mask.begin(), [](auto a, auto b) { return a | b; });
  return mask;
}

// Returns the slice with the properties of the series that tools and texts need.
LoadedSeriesPtr sliceOf(const Series& series, int index, const Frame& frame, VolumePtr volume) {
  auto slice = std::make_shared<LoadedSeries>();
  static_cast<SeriesIdentity&>(slice->series) = series;
  slice->series.laterality = projectionOf(series, index).laterality;
  slice->series.id = series.id;
  slice->series.path = series.path;
  slice->series.format = series.format;
  slice->series.acquired.calibrated = series.acquired.calibrated;
  slice->series.unit = frame.unit;
  if (frame.unit == series.unit) slice->series.suv = series.suv;  // else a presentation changed values
  slice->volume = std::move(volume);
  if (frame.colour()) return slice;
  const std::vector<float> ends = percentiles(*slice->volume, {1, 999});
  const ValueRange all = valueRange(*slice->volume);
  slice->histogram.low = all.low, slice->histogram.high = all.high;
  slice->window = frame.greys.front().mapping.window;
  slice->valueSpread = ends[1] > ends[0] ? double(ends[1]) - ends[0] : 1;
  return slice;
}

}  // namespace

std::size_t LoadedFrame::bytes() const {
  std::size_t sum = 0;
  for (const Pyramid& pyramid : pyramids) sum += pyramid.whole()->bytes() + pyramid.bytes();
  return sum;
}

const Volume& LoadedFrame::seenOn(const SlicePlane& plane, const VolumePtr& volume) const {
  return *std::ranges::find(pyramids, volume, &Pyramid::whole)->seenOn(plane);
}

Result<LoadedFramePtr> shownFrame(const Series& series, const FrameKey& key, Frame frame,
                                  std::optional<FramePresentation> how, std::vector<NamedGrey> seriesGreys) {
  const VoxelGeometry geometry = geometryOf(frame);
  auto shown = std::make_shared<LoadedFrame>();
  shown->key = key;
  shown->how = std::move(how);
  VolumePtr values;
  std::optional<Error> problem;
  const auto add = [&](VolumePtr& to, const Result<VolumePtr>& volume) {
    if (!volume) {
      problem = volume.error();
      return;
    }
    to = *volume;
    shown->pyramids.emplace_back(to);
  };
  if (frame.colour()) {
    add(values, volumeOf(geometry, bytes(channel(frame, 0))));
    add(shown->green, volumeOf(geometry, bytes(channel(frame, 1))));
    add(shown->blue, volumeOf(geometry, bytes(channel(frame, 2))));
  } else {
    add(values, volumeOf(geometry, std::move(frame.values), frame.padding));
  }
  if (!frame.overlays.empty()) add(shown->overlays, volumeOf(geometry, bytes(allOverlays(frame))));
  if (!frame.shutter.empty()) add(shown->shutter, volumeOf(geometry, bytes(std::move(frame.shutter))));
  if (problem) return *problem;
  shown->slice = sliceOf(series, key.index, frame, values);
  shown->greys = std::move(frame.greys);
  shown->seriesGreys = std::move(seriesGreys);
  shown->pixel = frame.pixel;
  shown->shutterGrey = frame.shutterGrey;
  shown->rowSide = std::move(frame.rowSide);
  shown->columnSide = std::move(frame.columnSide);
  shown->regions = std::move(frame.regions);
  shown->warnings = std::move(frame.warnings);
  return LoadedFramePtr(shown);
}

SlicePlane framePlane(const VoxelGeometry& slice) {
  const glm::dvec3 right = glm::normalize(slice.patientFromVoxelStep[0]);
  const glm::dvec3 column = slice.patientFromVoxelStep[1];
  return planeAlong(slice, right, glm::normalize(column - glm::dot(column, right) * right));
}

ShapeFrame frameNamed(const Series& series, int frame) {
  const auto n = std::size_t(frame);
  return {n < series.sopInstanceUids.size() ? series.sopInstanceUids[n] : std::string(),
          n < series.frames.size() ? series.frames[n] : frame};
}

std::optional<int> frameMeant(const Series& series, const ShapeFrame& name) {
  for (int n = 0; n < int(series.files.size()); ++n)
    if (frameNamed(series, n) == name) return n;
  return {};
}

FramePixels pixelsOf(const LoadedFrame& frame) {
  const std::string& side = frame.slice->series.laterality;
  const char rows = frame.rowSide.empty() ? ' ' : frame.rowSide.front();
  const bool isKnown = (side == "L" || side == "R") && (rows == 'L' || rows == 'R');
  const int outwards = !isKnown ? 0 : side.front() == rows ? 1 : -1;
  return {frame.slice->volume, frame.green, frame.blue, frame.pixel, frame.regions, outwards};
}

}  // namespace volumen
