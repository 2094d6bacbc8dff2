#pragma once

#include <optional>

#include "viewer/slice/plane.h"

namespace volumen {

/// Returns the means of blocks of `edge` x `edge` stored values of a picture, first row on top. Blocks at the
/// right and bottom border have the pixels that are left. Runs on one thread.
std::vector<float> blockMeans(const VoxelValues& stored, glm::ivec2 size, int edge);

/// A picture reduced to the means of blocks of stored values.
struct SmallPicture {
  glm::ivec2 size{0};
  int block = 1;  ///< edge of a block
  std::vector<float> means;
};

/// Returns a picture reduced for one whose longer side has `edge` pixels, with enough pixels for each to
/// scale it smoothly; nothing if it is too small for that.
std::optional<SmallPicture> smallPicture(const VoxelValues& stored, glm::ivec2 size, int edge);

/// A large picture and its reduced copies, whose pixels are means of blocks of pixels. Views that show the
/// picture small are drawn from a copy, so that their cost follows the view, not the picture. Numbers are
/// never taken from copies.
class Pyramid {
 public:
  /// Pictures of fewer pixels have no copies.
  static constexpr std::int64_t leastPixels = std::int64_t(1) << 22;

  Pyramid() = default;
  /// `whole`: a volume of one slice.
  explicit Pyramid(VolumePtr whole);

  const VolumePtr& whole() const { return whole_; }
  /// Returns the smallest copy whose pixels are at most half as large as those of a plane that averages; the
  /// whole picture if there is none.
  const VolumePtr& seenOn(const SlicePlane& plane) const;
  /// Bytes held by the copies.
  std::size_t bytes() const;

 private:
  VolumePtr whole_;
  std::vector<VolumePtr> copies_;  // the largest first
};

}  // namespace volumen
