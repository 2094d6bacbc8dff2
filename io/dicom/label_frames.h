#pragma once

#include <map>
#include <set>
#include <span>
#include <unordered_map>
#include <vector>

#include "io/dicom/data_set.h"
#include "viewer/segment/packed_bits.h"
#include "viewer/segment/segment.h"

namespace volumen::dicom {

/// Makes frames of one bit a pixel, each of one segment, from the frames of a label map.
class LabelFrames {
 public:
  /// `byNumber`: indices of segments; it must outlive this. `background`: the number of pixels of no segment.
  /// `pixels`: of a frame.
  LabelFrames(const std::unordered_map<int, std::size_t>& byNumber, int background, std::size_t pixels)
      : byNumber_(byNumber), background_(background), pixels_(pixels) {}

  /// Adds a frame of each segment that has pixels, and returns which these are.
  std::vector<std::size_t> add(std::span<const int> numbers);

  std::vector<std::uint8_t> bits() const { return bits_.bytes(); }
  /// Numbers of pixels that are those of no segment, but for 0.
  const std::set<int>& undescribed() const { return undescribed_; }

 private:
  using Masks = std::map<int, std::vector<std::uint64_t>>;
  std::vector<std::uint64_t>* maskOf(int number, Masks& masks);

  const std::unordered_map<int, std::size_t>& byNumber_;
  int background_;
  std::size_t pixels_;
  BitPacker bits_;
  std::set<int> undescribed_;
};

/// Gives segments without a colour that of their number in the palette of a label map that has one.
void addPaletteColours(std::vector<Segment>& segments, const DataSet& data);

}  // namespace volumen::dicom
