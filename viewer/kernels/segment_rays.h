#pragma once

#include <memory>
#include <vector>

#include "viewer/kernels/ray_generator.h"
#include "viewer/kernels/segment_crossings.h"
#include "viewer/tables/lighting.h"

namespace volumen {

/// Finds and lights the surfaces of segments that the rays of a picture meet (picture.md 10).
class SegmentRays {
 public:
  /// `cells`: one entry for each of shownSegments(plan.scene), in that order.
  SegmentRays(const Plan& plan, const VoxelGeometry& geometry,
              std::vector<std::shared_ptr<const SegmentCells>> cells);
  SegmentRays(const SegmentRays&) = delete;
  SegmentRays& operator=(const SegmentRays&) = delete;

  /// A point where a ray meets a surface.
  struct Met {
    double t = 0;      ///< Distance from the picture in mm.
    double order = 0;  ///< Smaller values are in front.
    int segment = 0;   ///< Index in shownSegments().
  };
  /// Working memory of one thread.
  struct Task {
    std::vector<FieldCrossing> crossings;
  };
  /// Appends the points where the ray through a pixel (y * width + x) meets surfaces, in order, up to the one
  /// that hides the rest.
  void follow(int pixel, Task& task, std::vector<Met>& met) const;
  glm::vec3 colourAt(int pixel, const Met& met) const;
  float opacityOf(const Met& met) const { return float(segments_[std::size_t(met.segment)].opacity); }
  /// Returns the ray generator of the same picture.
  const RayGenerator& generator() const { return generator_; }

 private:
  struct Segment {
    std::shared_ptr<const SegmentCells> cells;
    glm::dvec3 colour{1};
    double opacity = 1;
    glm::dvec3 target{0};                      // Target of the camera, in voxels of the field's box.
    glm::dvec3 right{0}, up{0}, direction{0};  // The camera's axes per mm, in voxels of the field's box.
    glm::dmat3 gradientMatrix{1};              // Converts value per voxel to value per mm in patient space.
    int mostCrossings = 1;                     // Number of crossings behind which everything is hidden.
    glm::ivec2 lowPixel{0}, highPixel{-1};     // No ray outside these pixels meets the segment.
  };
  /// A ray in the camera's axes: its position in the picture, and its move per mm along each axis.
  struct Line {
    double rightMm = 0, upMm = 0, right = 0, up = 0, direction = 1;
    double eyeMm = 0;  // Start of t.
  };
  Line lineThrough(glm::ivec2 at) const;
  void findPixels(Segment& segment) const;
  /// Limits t0 and t1 to the part of the ray that the clip box and planes leave.
  void clip(const Line& line, double& t0, double& t1) const;
  void followOne(int n, const Line& line, double t0, double& t1, Task& task, std::vector<Met>& met) const;

  RayGenerator generator_;
  const ViewRays& view_;
  glm::dvec3 right_, up_, direction_;            // The camera's axes per mm, in voxels of the volume.
  glm::bvec3 cutsLow_{false}, cutsHigh_{false};  // Sides of the clip box that lie inside the volume.
  bool isEmpty_ = false;                         // True if the clip box is empty.
  double stopTransmittance_ = 0;
  Lighting lighting_;
  std::vector<Segment> segments_;
  // Segments in order of search: opaque ones first, as nothing behind them need be searched.
  std::vector<int> searched_;
};

}  // namespace volumen
