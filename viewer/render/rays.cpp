#include "viewer/render/rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

namespace volumen {

namespace {
std::array<std::vector<float>*, 13> floatsOf(RayRow& row) {
  return {&row.startX,  &row.startY,  &row.startZ, &row.moveX,      &row.moveY,  &row.moveZ,     &row.viewerX,
          &row.viewerY, &row.viewerZ, &row.ahead,  &row.lastMiddle, &row.stepMm, &row.lastStepMm};
}
}  // namespace

RaySetup::RaySetup(const Scene& scene, const VoxelGeometry& geometry, glm::ivec2 size, double stepVoxels,
                   bool clip)
    : size_(size),
      stepVoxels_(stepVoxels),
      perspective_(scene.camera->projection == Projection::perspective),
      localViewer_(scene.shading.localViewer),
      axes_(cameraAxes(*scene.camera)),
      target_(*scene.camera->target),
      height_(scene.camera->height),
      geometry_(geometry),
      voxelFromMm_(geometry.voxelFromPatientStep()),
      low_(-0.5),
      high_(glm::dvec3(geometry.size) - 0.5) {
  if (perspective_) {
    eye_ = target_ - scene.camera->distance * axes_.direction;
    height_ = 2 * scene.camera->distance * std::tan(glm::radians(scene.camera->fov) / 2);
  }
  if (!clip) return;
  low_ = scene.clip.boxLow * glm::dvec3(geometry.size) - 0.5;
  high_ = scene.clip.boxHigh * glm::dvec3(geometry.size) - 0.5;
  for (const ClipPlane& p : scene.clip.planes) {
    const glm::dvec3 normal = glm::normalize(p.normal);
    planes_.push_back({glm::transpose(geometry.patientFromVoxelStep) * normal,
                       p.offset - glm::dot(normal, geometry.origin)});
  }
}

// So many rays at a time: loops over each of their numbers become vector code. All in voxel space but for the
// direction towards the viewer.
struct RaySetup::Batch {
  static constexpr int size = 64;
  int count = 0;
  int pixel[size];                         // 0 for padding
  double rightMm[size], upMm[size];        // of the pixel, from the target
  double origin[3][size], along[3][size];  // along: a mm of the ray
  double towardsViewer[3][size];
  double stepMm[size];
  double t0[size], t1[size];  // mm along the ray
};

namespace {

// std::ceil of what fits an int; without SSE4 that is a call.
double ceilOf(double x) {
  const double whole = double(int(x));
  return whole + (whole < x ? 1.0 : 0.0);
}

}  // namespace

void RaySetup::setOrigins(Batch& batch) const {
  const double pixelMm = height_ / size_.y;
  for (int n = 0; n < batch.count; ++n) {
    const int y = batch.pixel[n] / size_.x, x = batch.pixel[n] - y * size_.x;
    batch.rightMm[n] = ((x + 0.5) - 0.5 * size_.x) * pixelMm;
    batch.upMm[n] = (0.5 - (y + 0.5) / size_.y) * height_;
  }
  const auto set = [&](int n, glm::dvec3 origin, glm::dvec3 along, glm::dvec3 viewer) {
    origin = voxelFromMm_ * (origin - geometry_.origin);
    for (int i = 0; i < 3; ++i) {
      batch.origin[i][n] = origin[i];
      batch.along[i][n] = along[i];
      batch.towardsViewer[i][n] = viewer[i];
    }
  };
  const auto pixelOf = [&](int n) {
    return target_ + batch.rightMm[n] * axes_.right + batch.upMm[n] * axes_.up;
  };
  if (!perspective_) {
    const glm::dvec3 along = voxelFromMm_ * axes_.direction;
    std::fill_n(batch.stepMm, batch.count, stepVoxels_ / glm::length(along));
    for (int n = 0; n < batch.count; ++n) set(n, pixelOf(n), along, -axes_.direction);
    return;
  }
  for (int n = 0; n < batch.count; ++n) {
    const glm::dvec3 direction = glm::normalize(pixelOf(n) - eye_), along = voxelFromMm_ * direction;
    batch.stepMm[n] = stepVoxels_ / glm::length(along);
    set(n, eye_, along, localViewer_ ? -direction : -axes_.direction);
  }
}

void RaySetup::cutIntervals(Batch& batch) const {
  const double infinity = std::numeric_limits<double>::infinity();
  std::fill_n(batch.t0, batch.count, perspective_ ? 0 : -infinity);
  std::fill_n(batch.t1, batch.count, infinity);
  // Keeps the part of the rays where offset + slope t <= 0; a parallel ray's boundary is inside (SCENE 6).
  const auto keep = [&](auto slopeOf, auto offsetOf) {
    for (int n = 0; n < batch.count; ++n) {
      const double slope = slopeOf(n), offset = offsetOf(n), t = -offset / slope;
      const double sooner = std::min(batch.t1[n], t), later = std::max(batch.t0[n], t);
      const double missed = offset > 0 ? -infinity : batch.t1[n];
      batch.t1[n] = slope > 0 ? sooner : slope < 0 ? batch.t1[n] : missed;
      batch.t0[n] = slope < 0 ? later : batch.t0[n];
    }
  };
  for (int a = 0; a < 3; ++a) {
    const double *o = batch.origin[a], *d = batch.along[a], low = low_[a], high = high_[a];
    keep([&](int n) { return d[n]; }, [&](int n) { return o[n] - high; });
    keep([&](int n) { return -d[n]; }, [&](int n) { return low - o[n]; });
  }
  const auto dot = [](const glm::dvec3& normal, const double(&v)[3][Batch::size], int n) {
    return glm::dot(normal, glm::dvec3(v[0][n], v[1][n], v[2][n]));
  };
  for (const Plane& p : planes_)
    keep([&](int n) { return dot(p.normal, batch.along, n); },
         [&](int n) { return dot(p.normal, batch.origin, n) - p.offset; });
}

void RaySetup::writeRays(const Batch& batch, RayRow& row, int first) const {
  float* start[3] = {&row.startX[first], &row.startY[first], &row.startZ[first]};
  float* move[3] = {&row.moveX[first], &row.moveY[first], &row.moveZ[first]};
  float* viewer[3] = {&row.viewerX[first], &row.viewerY[first], &row.viewerZ[first]};
  int* steps = &row.steps[first];
  float *ahead = &row.ahead[first], *lastMiddle = &row.lastMiddle[first], *stepMm = &row.stepMm[first],
        *lastStepMm = &row.lastStepMm[first];
  for (int n = 0; n < batch.count; ++n) {
    const double length = batch.t1[n] - batch.t0[n], step = batch.stepMm[n];
    const double inside = length > 0 ? length : 0;
    // A rest of less than a millionth of a step is rounding, not an interval of its own.
    const double atLeastOne = std::max(1.0, ceilOf(inside / step - 1e-6));
    const double count = length > 0 ? atLeastOne : 0, last = length - (count - 1) * step;
    steps[n] = int(count);
    ahead[n] = float(count > 0 ? std::clamp(batch.t0[n] / step, -1e30, 1e30) : 0);
    lastMiddle[n] = float(count - 1 + 0.5 * last / step);
    stepMm[n] = float(step);
    lastStepMm[n] = float(std::max(last, 0.0));
  }
  for (int a = 0; a < 3; ++a)
    for (int n = 0; n < batch.count; ++n) {
      const double entered = batch.origin[a][n] + batch.along[a][n] * batch.t0[n];
      start[a][n] = float(steps[n] > 0 ? entered : 0);
      move[a][n] = float(batch.along[a][n] * batch.stepMm[n]);
      viewer[a][n] = float(batch.towardsViewer[a][n]);
    }
}

void RaySetup::setRays(RayRow& row) const {
  Batch batch;
  for (int first = 0; first < row.count; first += Batch::size) {
    batch.count = std::min(Batch::size, row.count - first);
    for (int n = 0; n < batch.count; ++n) batch.pixel[n] = std::max(0, row.pixel[first + n]);
    setOrigins(batch);
    cutIntervals(batch);
    writeRays(batch, row, first);
  }
  const auto values = floatsOf(row);
  row.parallel = !perspective_;
  for (int n = 0; n < row.count; ++n) {
    if (row.pixel[n] >= 0) {
      if (row.steps[n] > 0) {
        row.sharedMove = {row.moveX[n], row.moveY[n], row.moveZ[n]};
        row.sharedStepMm = row.stepMm[n];
      }
      continue;
    }
    row.steps[n] = 0;
    for (auto* v : values) (*v)[n] = 0;
  }
}

void RaySetup::resize(RayRow& row, int count) {
  const std::size_t padded = (std::size_t(count) + padding - 1) / padding * padding;
  row.count = count;
  for (auto* values : floatsOf(row)) values->assign(padded, 0.0f);
  row.steps.assign(padded, 0);
  row.pixel.assign(padded, -1);
}

void RaySetup::makeRays(int x, int y, int count, RayRow& row) const {
  resize(row, count);
  for (int n = 0; n < count; ++n) row.pixel[n] = y * size_.x + x + n;
  setRays(row);
  std::fill(row.ahead.begin(), row.ahead.end(), 0.0f);
}

// Any number would do, and does where floats end: rays then only lie farther apart.
void RaySetup::countAheadFromFirst(RayRow& row) const {
  constexpr float most = 1 << 20;
  float first = std::numeric_limits<float>::max();
  for (std::size_t n = 0; n < row.steps.size(); ++n)
    if (row.steps[n] > 0) first = std::min(first, row.ahead[n]);
  for (std::size_t n = 0; n < row.steps.size(); ++n) {
    const float behind = row.steps[n] > 0 ? std::min(row.ahead[n] - first, most) : 0.0f;
    row.ahead[n] = wholeAhead_ ? float(int(behind + 0.5f)) : behind;
  }
}

double RaySetup::tileSpread() const {
  double pixelMm = height_ / size_.y;
  if (perspective_) {
    double farMm = 0;
    for (const glm::dvec3& corner : geometry_.boxCorners())
      farMm = std::max(farMm, glm::dot(corner - eye_, axes_.direction));
    pixelMm *= farMm / glm::dot(target_ - eye_, axes_.direction);
  }
  const glm::dvec3 across = glm::abs(voxelFromMm_ * axes_.right), down = glm::abs(voxelFromMm_ * axes_.up);
  const glm::dvec3 half = (across + down) * (pixelMm * (tile - 1) / 2.0);
  return std::max({half.x, half.y, half.z});
}

void RaySetup::makeBlock(int x, int y, RayRow& row) const {
  std::vector<glm::ivec2> corners;
  for (int ty = y; ty < std::min(y + block, size_.y); ty += tile)
    for (int tx = x; tx < std::min(x + block, size_.x); tx += tile) corners.emplace_back(tx, ty);
  makeTiles(corners, row);
}

void RaySetup::makeTiles(const std::vector<glm::ivec2>& corners, RayRow& row) const {
  resize(row, int(corners.size()) * tile * tile);
  for (int n = 0; n < row.count; ++n) {
    const int inTile = n % (tile * tile);
    const glm::ivec2 at = corners[n / (tile * tile)] + glm::ivec2(inTile % tile, inTile / tile);
    if (at.x < size_.x && at.y < size_.y) row.pixel[n] = at.y * size_.x + at.x;
  }
  setRays(row);
  countAheadFromFirst(row);
}

}  // namespace volumen
