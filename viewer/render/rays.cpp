#include "viewer/render/rays.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

namespace volumen {

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

RaySetup::Interval RaySetup::interval(glm::dvec3 o, glm::dvec3 d) const {
  const double infinity = std::numeric_limits<double>::infinity();
  Interval in{perspective_ ? 0 : -infinity, infinity};
  // Keeps the part of the ray where offset + slope t <= 0; a parallel ray's boundary is inside (SCENE 6).
  const auto keep = [&](double slope, double offset) {
    if (slope > 0)
      in.t1 = std::min(in.t1, -offset / slope);
    else if (slope < 0)
      in.t0 = std::max(in.t0, -offset / slope);
    else if (offset > 0)
      in.t1 = -infinity;
  };
  for (int a = 0; a < 3; ++a) {
    keep(d[a], o[a] - high_[a]);
    keep(-d[a], low_[a] - o[a]);
  }
  for (const Plane& p : planes_) keep(glm::dot(p.normal, d), glm::dot(p.normal, o) - p.offset);
  return in;
}

void RaySetup::setRay(RayRow& row, int n, glm::dvec3 o, glm::dvec3 d, glm::dvec3 direction) const {
  const Interval in = interval(o, d);
  const double stepMm = stepVoxels_ / glm::length(d);
  const double length = in.t1 - in.t0;
  // A rest of less than a millionth of a step is rounding, not an interval of its own.
  const double steps = length > 0 ? std::max(1.0, std::ceil(length / stepMm - 1e-6)) : 0;
  const double last = length - (steps - 1) * stepMm;
  const glm::dvec3 start = steps > 0 ? o + d * in.t0 : glm::dvec3(0), move = d * stepMm;
  row.steps[n] = int(steps);
  row.lastMiddle[n] = float(steps - 1 + 0.5 * last / stepMm);
  row.startX[n] = float(start.x), row.startY[n] = float(start.y), row.startZ[n] = float(start.z);
  row.moveX[n] = float(move.x), row.moveY[n] = float(move.y), row.moveZ[n] = float(move.z);
  row.stepMm[n] = float(stepMm);
  row.lastStepMm[n] = float(std::max(last, 0.0));
  const glm::dvec3 viewer = localViewer_ ? -direction : -axes_.direction;
  row.viewerX[n] = float(viewer.x), row.viewerY[n] = float(viewer.y), row.viewerZ[n] = float(viewer.z);
}

void RaySetup::resize(RayRow& row, int count) {
  const std::size_t padded = (std::size_t(count) + padding - 1) / padding * padding;
  row.count = count;
  for (auto* values :
       {&row.startX, &row.startY, &row.startZ, &row.moveX, &row.moveY, &row.moveZ, &row.viewerX, &row.viewerY,
        &row.viewerZ, &row.lastMiddle, &row.stepMm, &row.lastStepMm})
    values->assign(padded, 0.0f);
  row.steps.assign(padded, 0);
  row.pixel.assign(padded, -1);
}

void RaySetup::setPixel(RayRow& row, int n, int x, int y) const {
  const double pixelMm = height_ / size_.y;
  const double a = ((x + 0.5) - 0.5 * size_.x) * pixelMm, b = (0.5 - (y + 0.5) / size_.y) * height_;
  const glm::dvec3 q = target_ + a * axes_.right + b * axes_.up;
  const glm::dvec3 origin = perspective_ ? eye_ : q;
  const glm::dvec3 direction = perspective_ ? glm::normalize(q - eye_) : axes_.direction;
  row.pixel[n] = y * size_.x + x;
  setRay(row, n, geometry_.voxelFromPatient(origin), voxelFromMm_ * direction, direction);
}

void RaySetup::makeRays(int x, int y, int count, RayRow& row) const {
  resize(row, count);
  for (int n = 0; n < count; ++n) setPixel(row, n, x + n, y);
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
  const glm::ivec2 tiles = (glm::min(size_ - glm::ivec2(x, y), glm::ivec2(block)) + (tile - 1)) / tile;
  resize(row, tiles.x * tiles.y * tile * tile);
  for (int n = 0; n < row.count; ++n) {
    const int whole = n / (tile * tile), inTile = n % (tile * tile);
    const int px = x + whole % tiles.x * tile + inTile % tile,
              py = y + whole / tiles.x * tile + inTile / tile;
    if (px < size_.x && py < size_.y) setPixel(row, n, px, py);
  }
}

}  // namespace volumen
