#include "viewer/methods/surface_stretches.h"

#include <algorithm>
#include <limits>

#include "viewer/volume/clock.h"

namespace volumen {

namespace {
constexpr double endlessMm = std::numeric_limits<double>::infinity();
constexpr std::size_t raysOfTile = std::size_t(RayGenerator::tile) * RayGenerator::tile;

std::int64_t nsSince(double beginMs) { return std::int64_t(1e6 * (wallMs() - beginMs)); }
}  // namespace

bool SurfaceStretches::find(const SegmentRays& segments, const RayRow& rays) {
  segments_ = &segments;
  met_.clear();
  rays_.resize(rays.pixel.size());
  for (std::size_t n = 0; n < rays_.size(); ++n) {
    rays_[n] = {rays.pixel[n], met_.size(), met_.size(), -endlessMm, rays.pixel[n] >= 0};
    if (rays.pixel[n] < 0) continue;
    segments.follow(rays.pixel[n], task_, met_);
    rays_[n].end = met_.size();
  }
  return !met_.empty();
}

void SurfaceStretches::trace(const RenderInputs& inputs, TraceKernel kernel, const TraceRow& out,
                             TraceCounts& counts) {
  error_.clear();
  while (gather()) {
    if (out.error) error_.assign(rayOf_.size(), 0.0f);
    traceStretch(inputs, kernel, counts);
    add(out);
    const double begin = wallMs();
    cover(inputs.trace().stopTransmittance, out);
    counts.surfacesNs += nsSince(begin);
  }
}

// Collects the next stretches of all rays that go on, in whole tiles. Returns false if there are none.
bool SurfaceStretches::gather() {
  rayOf_.clear(), row_.pixel.clear(), parts_.from.clear(), parts_.to.clear();
  for (std::size_t first = 0; first < rays_.size(); first += raysOfTile) {
    const auto tile = std::span(rays_).subspan(first, raysOfTile);
    if (std::ranges::none_of(tile, &Ray::goesOn)) continue;
    for (std::size_t n = first; n < first + raysOfTile; ++n) {
      const Ray& ray = rays_[n];
      rayOf_.push_back(n);
      row_.pixel.push_back(ray.goesOn ? ray.pixel : -1);
      parts_.from.push_back(ray.from);
      parts_.to.push_back(ray.next < ray.end ? met_[ray.next].t : endlessMm);
    }
  }
  return !rayOf_.empty();
}

void SurfaceStretches::traceStretch(const RenderInputs& inputs, TraceKernel kernel, TraceCounts& counts) {
  segments_->generator().makeParts(parts_, row_);
  values_.assign(4 * rayOf_.size(), 0.0f);
  TraceRow row = traceRowOf(values_);
  if (!error_.empty()) row.error = error_.data();
  kernel(inputs.trace(), row_, {}, row, counts);
}

// Adds the stretches behind the light gathered so far.
void SurfaceStretches::add(const TraceRow& out) const {
  const std::size_t count = rayOf_.size();
  const float *red = values_.data(), *green = red + count, *blue = green + count, *alpha = blue + count;
  for (std::size_t n = 0; n < count; ++n) {
    if (row_.pixel[n] < 0) continue;
    const std::size_t ray = rayOf_[n];
    const float through = 1 - out.alpha[ray];
    out.red[ray] += through * red[n];
    out.green[ray] += through * green[n];
    out.blue[ray] += through * blue[n];
    out.alpha[ray] += through * alpha[n];
    if (out.error) out.error[ray] += through * error_[n];
  }
}

// Adds the surfaces at which the stretches end.
void SurfaceStretches::cover(float stopTransmittance, const TraceRow& out) {
  for (std::size_t n = 0; n < rayOf_.size(); ++n) {
    if (row_.pixel[n] < 0) continue;
    const std::size_t at = rayOf_[n];
    Ray& ray = rays_[at];
    const float through = 1 - out.alpha[at];
    ray.goesOn = ray.next < ray.end && through > stopTransmittance;
    if (!ray.goesOn) continue;
    const SegmentRays::Met& met = met_[ray.next++];
    const float weight = through * segments_->opacityOf(met);
    const glm::vec3 colour = weight * segments_->colourAt(ray.pixel, met);
    out.red[at] += colour.r, out.green[at] += colour.g, out.blue[at] += colour.b;
    out.alpha[at] += weight;
    ray.from = std::max(ray.from, met.t);
    ray.goesOn = 1 - out.alpha[at] > stopTransmittance;
  }
}

}  // namespace volumen
