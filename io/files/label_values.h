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

/// Numbers that files may use for labels, from 1.
inline constexpr std::uint32_t mostLabelValue = 0xffffff;

/// Which label of a label map stands for which number of a file.
struct LabelOf {
  std::uint32_t value = 0;
  std::uint8_t label = 0;
};

/// Labels for numbers, each of which is there once: the number itself where it is one, else the smallest that
/// is free. The Error: there are more than 255 of them.
Result<std::vector<LabelOf>> labelsFor(std::span<const std::uint32_t> values);

/// The numbers at the voxels of one volume of an image file.
class LabelValues {
 public:
  /// The Error names the file: it cannot be read, or holds values that are no labels, even when rounded by
  /// 0.001. Rounding is told in `notes`.
  static Result<LabelValues> read(const ImageHeader& header, std::uint64_t volume, const std::string& path,
                                  std::vector<std::string>& notes, const Progress& progress = {},
                                  const CancelToken& cancel = {});

  /// All but 0, in order.
  std::vector<std::uint32_t> present() const;
  /// The labels at the voxels; background where there is none for a number.
  DenseLabels labels(std::span<const LabelOf> labels) const;

 private:
  VoxelGeometry geometry_;
  std::vector<std::uint32_t> values_;
};

}  // namespace volumen
