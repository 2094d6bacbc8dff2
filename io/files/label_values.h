#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/files/image_header.h"
#include "io/study/progress.h"
#include "viewer/segment/dense_labels.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// The largest number of a label in files; the smallest is 1.
inline constexpr std::uint32_t mostLabelValue = 0xffffff;

/// Maps a number in a file to a label of a label map.
struct LabelOf {
  std::uint32_t value = 0;
  std::uint8_t label = 0;
};

/// Returns labels for unique numbers: the number itself if it is a valid label, else the smallest free one.
/// The Error: there are more than 255 numbers.
Result<std::vector<LabelOf>> labelsFor(std::span<const std::uint32_t> values);

/// The label numbers at the voxels of one volume of an image file.
class LabelValues {
 public:
  /// Reads the numbers. The Error names the file: it cannot be read, or holds values that are not within
  /// 0.001 of a label. Rounding is reported in `notes`.
  static Result<LabelValues> read(const ImageHeader& header, std::uint64_t volume, const std::string& path,
                                  std::vector<std::string>& notes, const Progress& progress = {},
                                  const CancelToken& cancel = {});

  /// Returns all numbers except 0, in ascending order.
  std::vector<std::uint32_t> present() const;
  /// Returns the labels at the voxels; numbers without a label become background.
  DenseLabels labels(std::span<const LabelOf> labels) const;

 private:
  VoxelGeometry geometry_;
  std::vector<std::uint32_t> values_;
};

}  // namespace volumen
