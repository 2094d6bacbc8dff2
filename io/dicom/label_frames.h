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

/// Turns the frames of a label map into 1-bit frames of one segment each.
class LabelFrames {
 public:
  /// `byNumber` maps segment numbers to indices and must outlive this. `background` is the value of
  /// unlabelled pixels. `pixels` is the size of a frame.
  LabelFrames(const std::unordered_map<int, std::size_t>& byNumber, int background, std::size_t pixels)
      : byNumber_(byNumber), background_(background), pixels_(pixels) {}

  /// Adds a frame for each segment that has pixels, and returns the indices of these segments.
  std::vector<std::size_t> add(std::span<const int> numbers);

  std::vector<std::uint8_t> bits() const { return bits_.bytes(); }
  /// Returns the pixel values other than 0 that belong to no segment.
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

/// Gives segments without a colour the palette entry of their number, if the label map has a palette.
void addPaletteColours(std::vector<Segment>& segments, const DataSet& data);

}  // namespace volumen::dicom
