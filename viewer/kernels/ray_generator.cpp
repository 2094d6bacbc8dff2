#include "viewer/kernels/ray_generator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "viewer/scene/step_length.h"

namespace volumen {

namespace {

std::array<std::vector<float>*, 13> floatsOf(RayRow& row) {
  return {&row.startX,  &row.startY,  &row.startZ, &row.moveX,      &row.moveY,  &row.moveZ,     &row.viewerX,
          &row.viewerY, &row.viewerZ, &row.ahead,  &row.lastMiddle, &row.stepMm, &row.lastStepMm};
}

}  // namespace

RayGenerator::RayGenerator(const Scene& scene, const VoxelGeometry& geometry, glm::ivec2 size,
                           double stepVoxels, bool clip)
    : geometry_(geometry), target_(*scene.camera->target) {
  const Camera& camera = *scene.camera;
  const glm::dvec3 voxels(geometry.size), spacing = geometry.spacing();
  view_.size = size;
  view_.stepVoxels = stepVoxels;
  view_.perspective = camera.projection == Projection::perspective;
  view_.localViewer = scene.shading.localViewer;
  view_.axes = cameraAxes(camera);
  view_.target = geometry.voxelFromPatient(target_);
  view_.voxelFromMm = geometry.voxelFromPatientStep();
  view_.sharedStepMm = view_.perspective ? 0 : stepMm(camera, geometry, stepVoxels);
  view_.heightMm =
      view_.perspective ? 2 * camera.distance * std::tan(glm::radians(camera.fov) / 2) : camera.height;
  view_.distanceMm = camera.distance;
  view_.lengthMm = glm::dot(spacing, voxels);
  view_.leastSpacingMm = std::min({spacing.x, spacing.y, spacing.z});
  const Clip whole;
  const Clip& drawn = clip ? scene.clip : whole;
  view_.low = drawn.boxLow * voxels - 0.5;
  view_.high = drawn.boxHigh * voxels - 0.5;
  for (const ClipPlane& p : drawn.planes) {
    const glm::dvec3 normal = glm::normalize(p.normal);
    view_.planes.push_back({glm::transpose(geometry.patientFromVoxelStep) * normal,
                            p.offset - glm::dot(normal, geometry.origin)});
  }
}

void RayGenerator::resize(RayRow& row, int count) {
  const std::size_t padded = (std::size_t(count) + padding - 1) / padding * padding;
  row.count = count;
  for (auto* values : floatsOf(row)) values->resize(padded);
  row.steps.resize(padded);
  row.pixel.assign(padded, -1);
}

void RayGenerator::makeRays(int x, int y, int count, RayRow& row) const {
  resize(row, count);
  for (int n = 0; n < count; ++n) row.pixel[n] = y * view_.size.x + x + n;
  makeRays_(view_, Ahead::none, nullptr, row);
}

double RayGenerator::tileSpread() const {
  double pixelMm = view_.heightMm / view_.size.y;
  if (view_.perspective) {
    double farMm = 0;
    for (const glm::dvec3& corner : geometry_.boxCorners())
      farMm = std::max(farMm, glm::dot(corner - target_, view_.axes.direction));
    pixelMm *= 1 + farMm / view_.distanceMm;
  }
  const glm::dvec3 across = glm::abs(view_.voxelFromMm * view_.axes.right),
                   down = glm::abs(view_.voxelFromMm * view_.axes.up);
  const glm::dvec3 half = (across + down) * (pixelMm * (tile - 1) / 2.0);
  return std::max({half.x, half.y, half.z});
}

void RayGenerator::makeBlock(int x, int y, RayRow& row) const {
  std::vector<glm::ivec2> corners;
  for (int ty = y; ty < std::min(y + block, view_.size.y); ty += tile)
    for (int tx = x; tx < std::min(x + block, view_.size.x); tx += tile) corners.emplace_back(tx, ty);
  makeTiles(corners, row);
}

void RayGenerator::makeTiles(const std::vector<glm::ivec2>& corners, RayRow& row) const {
  resize(row, int(corners.size()) * tile * tile);
  for (int n = 0; n < row.count; ++n) {
    const int inTile = n % (tile * tile);
    const glm::ivec2 at = corners[n / (tile * tile)] + glm::ivec2(inTile % tile, inTile / tile);
    if (at.x < view_.size.x && at.y < view_.size.y) row.pixel[n] = at.y * view_.size.x + at.x;
  }
  makeRays_(view_, ahead_, nullptr, row);
}

void RayGenerator::make(std::vector<int> pixels, const RayParts* parts, RayRow& row) const {
  resize(row, int(pixels.size()));
  row.pixel = std::move(pixels);
  makeRays_(view_, ahead_, parts, row);
}

void RayGenerator::makePixels(std::vector<int> pixels, RayRow& row) const {
  make(std::move(pixels), nullptr, row);
}

void RayGenerator::makeParts(const RayParts& parts, RayRow& row) const {
  make(std::move(row.pixel), &parts, row);
}

}  // namespace volumen
