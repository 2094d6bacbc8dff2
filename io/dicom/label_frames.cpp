#include "io/dicom/label_frames.h"

#include "io/dicom/colour.h"

namespace volumen::dicom {

// Returns null for numbers that belong to no segment.
std::vector<std::uint64_t>* LabelFrames::maskOf(int number, Masks& masks) {
  if (number == background_) return nullptr;
  if (byNumber_.contains(number)) return &masks.try_emplace(number, (pixels_ + 63) / 64).first->second;
  if (number != 0) undescribed_.insert(number);
  return nullptr;
}

std::vector<std::size_t> LabelFrames::add(std::span<const int> numbers) {
  Masks masks;
  std::vector<std::uint64_t>* mask = nullptr;
  int last = background_;
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    if (numbers[n] != last) mask = maskOf(last = numbers[n], masks);
    if (mask) (*mask)[n / 64] |= std::uint64_t(1) << n % 64;
  }
  std::vector<std::size_t> segments;
  for (const auto& [number, words] : masks) {
    segments.push_back(byNumber_.at(number));
    bits_.add(words, pixels_);
  }
  return segments;
}

void addPaletteColours(std::vector<Segment>& segments, const DataSet& data) {
  if (data.text(0x00280004, data.root()) != "PALETTE COLOR") return;
  std::vector<std::uint16_t> numbers;
  for (const Segment& segment : segments) numbers.push_back(std::uint16_t(segment.number));
  std::vector<std::string> warnings;
  const auto rgb = toRgb({numbers, {}}, PixelFormat{}, data, warnings);
  if (!rgb) return;
  for (std::size_t n = 0; n < segments.size(); ++n)
    if (!segments[n].colour)
      segments[n].colour = glm::u8vec3((*rgb)[3 * n], (*rgb)[3 * n + 1], (*rgb)[3 * n + 2]);
}

}  // namespace volumen::dicom
