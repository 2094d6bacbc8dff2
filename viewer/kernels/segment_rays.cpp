#include "viewer/kernels/segment_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace volumen {

namespace {
constexpr int allCrossings = std::numeric_limits<int>::max();
constexpr double infiniteMm = std::numeric_limits<double>::infinity();
constexpr double leftLaterVoxels = 1e-3, nextLaterVoxels = 1e-6;  // picture.md 10

// Returns the number of crossings behind which at most `transmittance` of the light is left.
int crossingsUpTo(double transmittance, double opacity) {
  if (opacity == 1) return 1;
  const double count = std::ceil(std::log(transmittance) / std::log1p(-opacity)) + 1;
  return count < 1e6 ? int(count) : allCrossings;
}

}  // namespace

SegmentRays::SegmentRays(const Plan& plan, const VoxelGeometry& geometry,
                         std::vector<std::shared_ptr<const SegmentCells>> cells)
    : generator_(plan, geometry),
      view_(generator_.view()),
      right_(view_.voxelFromMm * view_.axes.right),
      up_(view_.voxelFromMm * view_.axes.up),
      direction_(view_.voxelFromMm * view_.axes.direction),
      stopTransmittance_(plan.stopTransmittance),
      lighting_(makeLighting(plan.scene, true, true)) {
  const Clip& clip = plan.scene.clip;
  cutsLow_ = glm::greaterThan(clip.boxLow, glm::dvec3(0));
  cutsHigh_ = glm::lessThan(clip.boxHigh, glm::dvec3(1));
  isEmpty_ = glm::any(glm::equal(clip.boxLow, clip.boxHigh));
  const auto shown = shownSegments(plan.scene);
  for (std::size_t n = 0; n < shown.size(); ++n) {
    const OccupancyField& field = *shown[n]->field;
    const glm::dmat3 voxelFromMm = field.geometry.voxelFromPatientStep();
    Segment s{cells[n],
              shown[n]->colour,
              shown[n]->opacity,
              field.geometry.voxelFromPatient(*plan.scene.camera->target) - glm::dvec3(field.box.low),
              voxelFromMm * view_.axes.right,
              voxelFromMm * view_.axes.up,
              voxelFromMm * view_.axes.direction,
              field.geometry.patientFromVoxelGradient()};
    s.mostCrossings = crossingsUpTo(stopTransmittance_, s.opacity);
    findPixels(s);
    segments_.push_back(std::move(s));
    searched_.push_back(int(n));
  }
  std::stable_partition(searched_.begin(), searched_.end(),
                        [&](int n) { return segments_[std::size_t(n)].opacity == 1; });
}

// Finds them from the corners of the box around its cells, with a margin of a pixel.
void SegmentRays::findPixels(Segment& segment) const {
  const VoxelBox& box = segment.cells->box();
  const glm::dmat3 axesFromVoxel = glm::inverse(glm::dmat3(segment.right, segment.up, segment.direction));
  const double pixelMm = view_.heightMm / view_.size.y;
  glm::dvec2 low(infiniteMm), high(-infiniteMm);
  for (int n = 0; n < 8; ++n) {
    const glm::dvec3 corner(glm::bvec3(n & 1, n & 2, n & 4));
    const glm::dvec3 p =
        axesFromVoxel * (glm::mix(glm::dvec3(box.low), glm::dvec3(box.high + 1), corner) - segment.target);
    double scale = 1 / pixelMm;
    if (view_.perspective) {
      const double fromEyeMm = view_.distanceMm + p.z;
      if (fromEyeMm <= 1e-3 * view_.distanceMm) low = glm::dvec2(-infiniteMm), high = glm::dvec2(infiniteMm);
      scale *= view_.distanceMm / std::max(fromEyeMm, 1e-3 * view_.distanceMm);
    }
    const glm::dvec2 at(p.x * scale + 0.5 * view_.size.x, 0.5 * view_.size.y - p.y * scale);
    low = glm::min(low, at), high = glm::max(high, at);
  }
  const glm::dvec2 size(view_.size);
  segment.lowPixel = glm::ivec2(glm::floor(glm::clamp(low - 1.5, glm::dvec2(0), size)));
  segment.highPixel = glm::ivec2(glm::ceil(glm::clamp(high + 0.5, glm::dvec2(-1), size)));
}

SegmentRays::Line SegmentRays::lineThrough(glm::ivec2 at) const {
  const double pixelMm = view_.heightMm / view_.size.y;
  Line line;
  line.rightMm = (at.x - (0.5 * view_.size.x - 0.5)) * pixelMm;
  line.upMm = (0.5 * view_.size.y - 0.5 - at.y) * pixelMm;
  line.eyeMm = -infiniteMm;
  if (!view_.perspective) return line;
  const double toEye = glm::length(glm::dvec3(line.rightMm, line.upMm, view_.distanceMm));
  line.right = line.rightMm / toEye;
  line.up = line.upMm / toEye;
  line.direction = view_.distanceMm / toEye;
  line.eyeMm = -toEye;
  return line;
}

void SegmentRays::clip(const Line& line, double& t0, double& t1) const {
  constexpr double roundingVoxels = 1e-9;
  const auto cut = [&](double outside, double slope, double rounding) {
    const double drift = slope * view_.lengthMm;
    if (drift > rounding)
      t1 = std::min(t1, -outside / slope);
    else if (drift < -rounding)
      t0 = std::max(t0, -outside / slope);
    else if (outside > rounding)
      t1 = -infiniteMm;
  };
  const glm::dvec3 origin = view_.target + line.rightMm * right_ + line.upMm * up_;
  const glm::dvec3 move = line.right * right_ + line.up * up_ + line.direction * direction_;
  for (int a = 0; a < 3; ++a) {
    if (cutsHigh_[a]) cut(origin[a] - view_.high[a], move[a], roundingVoxels);
    if (cutsLow_[a]) cut(view_.low[a] - origin[a], -move[a], roundingVoxels);
  }
  for (const ViewRays::Plane& p : view_.planes)
    cut(glm::dot(origin, p.normal) - p.offset, glm::dot(move, p.normal),
        roundingVoxels * view_.leastSpacingMm);
}

void SegmentRays::followOne(int n, const Line& line, double t0, double& t1, Task& task,
                            std::vector<Met>& met) const {
  const Segment& s = segments_[std::size_t(n)];
  const FieldLine inField{s.target + line.rightMm * s.right + line.upMm * s.up,
                          line.right * s.right + line.up * s.up + line.direction * s.direction};
  task.crossings.clear();
  appendCrossings(*s.cells, inField, t0, t1, s.mostCrossings, task.crossings);
  const double voxelMm = 1 / glm::length(line.right * right_ + line.up * up_ + line.direction * direction_);
  for (const FieldCrossing& c : task.crossings) {
    const double order = c.t + (nextLaterVoxels * n + (c.leaves ? leftLaterVoxels : 0)) * voxelMm;
    met.push_back({c.t, order, n});
  }
  if (int(task.crossings.size()) == s.mostCrossings) t1 = std::min(t1, met.back().order);
}

void SegmentRays::follow(int pixel, Task& task, std::vector<Met>& met) const {
  if (isEmpty_) return;
  const glm::ivec2 at(pixel % view_.size.x, pixel / view_.size.x);
  const auto first = std::ptrdiff_t(met.size());
  bool isClipped = false;
  Line line;
  double t0 = 0, t1 = 0;
  for (const int n : searched_) {
    const Segment& s = segments_[std::size_t(n)];
    if (at.x < s.lowPixel.x || at.y < s.lowPixel.y || at.x > s.highPixel.x || at.y > s.highPixel.y) continue;
    if (!isClipped) {
      line = lineThrough(at);
      t0 = line.eyeMm, t1 = infiniteMm;
      clip(line, t0, t1);
      isClipped = true;
    }
    followOne(n, line, t0, t1, task, met);
  }
  std::sort(met.begin() + first, met.end(), [](const Met& a, const Met& b) { return a.order < b.order; });
  double through = 1;
  for (auto m = met.begin() + first; m != met.end(); ++m) {
    through *= 1 - segments_[std::size_t(m->segment)].opacity;
    if (through > stopTransmittance_) continue;
    met.erase(m + 1, met.end());
    break;
  }
}

glm::vec3 SegmentRays::colourAt(int pixel, const Met& met) const {
  const Segment& s = segments_[std::size_t(met.segment)];
  const Line line = lineThrough({pixel % view_.size.x, pixel / view_.size.x});
  const glm::dvec3 place = s.target + (line.rightMm + met.t * line.right) * s.right +
                           (line.upMm + met.t * line.up) * s.up + met.t * line.direction * s.direction;
  const glm::dvec3 gradient = s.gradientMatrix * fieldGradient(*s.cells->field(), place);
  const double length = glm::length(gradient);
  if (length == 0) return glm::vec3(s.colour * glm::dvec3(lighting_.flat));
  const glm::dvec3 normal = -gradient / length;
  if (!lighting_.localViewer) {
    const Shade shade = shadeOf(lighting_, normal);
    return glm::vec3(s.colour * shade.d + shade.s);
  }
  const CameraAxes& axes = view_.axes;
  const glm::dvec3 along = line.right * axes.right + line.up * axes.up + line.direction * axes.direction;
  const Shade shade = shadeOf(seenFrom(lighting_, -along), normal);
  return glm::vec3(s.colour * shade.d + shade.s);
}

}  // namespace volumen
