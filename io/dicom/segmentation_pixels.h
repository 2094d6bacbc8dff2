#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <vector>

#include "io/dicom/data_set.h"
#include "io/dicom/header.h"

namespace volumen::dicom {

/// The pixel data of a segmentation object. Its Errors are reasons without the file's name.
class SegmentationPixels {
 public:
  /// `pictures` is the size of the pictures it refers to (0 if unknown), named in an Error about a wrong
  /// length. All arguments but `size`, `frames` and `pictures` must outlive the object.
  SegmentationPixels(const InspectedFile& file, const DataSet& data, const std::string& path, glm::ivec2 size,
                     int frames, glm::ivec2 pictures)
      : file_(file), data_(data), path_(path), size_(size), frames_(frames), pictures_(pictures) {}

  /// Returns 1-bit pixels, frame after frame without gaps (packed_bits.h). Frames that begin on whole bytes
  /// are joined, with a sentence in `notes`.
  Result<std::vector<std::uint8_t>> bits(std::vector<std::string>& notes) const;

  using TakeFrame = std::function<Status(std::size_t frame, std::span<const int> numbers)>;
  /// Decodes wider pixels like those of any picture, frame by frame.
  Status forEachFrame(const TakeFrame& take) const;

 private:
  std::uint64_t framePixels() const { return std::uint64_t(size_.x) * std::uint64_t(size_.y); }
  std::uint64_t bytesThere() const;
  bool arePadded() const;
  Status checkLength(std::uint64_t bitsOfPixel) const;
  std::string picturesDiffer() const;
  Result<std::vector<std::uint8_t>> bytesAt(std::uint64_t offset, std::uint64_t length) const;
  std::vector<std::uint8_t> withoutPadding(std::span<const std::uint8_t> bytes) const;

  const InspectedFile& file_;
  const DataSet& data_;
  const std::string& path_;
  glm::ivec2 size_;
  int frames_;
  glm::ivec2 pictures_;
};

}  // namespace volumen::dicom
