#include "io/dicom/nuclear.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "io/dicom/separators.h"
#include "io/dicom/slice_place.h"
#include "io/dicom/stack.h"

namespace volumen::dicom {
namespace {

constexpr std::uint32_t detectorInformation = 0x00540022, sliceVector = 0x00540080;

/// One number for each frame, from 1; empty if the file does not give as many.
using FrameNumbers = std::vector<std::uint16_t>;

FrameNumbers numbersOf(const DataSet& data, std::uint32_t vector, const FileHeader& header) {
  FrameNumbers numbers = data.words(vector, data.root());
  if (numbers.size() != header.slices.size()) numbers.clear();
  return numbers;
}

/// Returns the slice of each frame. Without the vector, slices are consecutive if there is one frame a slice.
FrameNumbers slicesOf(const DataSet& data, const FileHeader& header) {
  FrameNumbers numbers = numbersOf(data, sliceVector, header);
  const std::size_t slices = data.word(0x00540081, data.root()).value_or(0);
  if (!numbers.empty() || slices != header.slices.size()) return numbers;
  numbers.resize(slices);
  std::iota(numbers.begin(), numbers.end(), std::uint16_t(1));
  return numbers;
}

std::string textOf(const FrameNumbers& numbers, std::size_t frame) {
  return numbers.empty() ? std::string() : std::to_string(numbers[frame]);
}

/// Returns the signed distance between slices along the normal, mm; 0 if unknown.
double signedDistance(const DataSet& data, FileHeader& header) {
  if (header.slices.size() < 2) return 0;
  if (const double distance = data.number(0x00180088, data.root()).value_or(0); distance != 0)
    return distance;
  const double thickness = header.slices[0].thickness;
  if (thickness > 0)
    warnOnce(header, "its SpacingBetweenSlices is missing: slices were placed their thickness, " +
                         millimetres(thickness) + " mm, apart");
  return std::max(0.0, thickness);
}

/// Reads the position of the first slice from the frame's detector, if it has one.
void readDetectorPlace(const DataSet& data, const FrameNumbers& detectors, std::size_t frame,
                       FileHeader& header) {
  const auto items = data.items(detectorInformation, data.root());
  const std::size_t number = detectors.empty() ? 1 : detectors[frame];
  if (number >= 1 && number <= items.size()) readPlace(data, items[number - 1], header.slices[frame], header);
}

}  // namespace

bool isReconstructedNuclear(const DataSet& data) {
  if (data.has(sliceVector, data.root())) return true;
  const auto words = data.values(0x00080008, data.root());
  return data.has(detectorInformation, data.root()) &&
         std::ranges::any_of(words, [](const std::string& word) { return word.starts_with("RECON"); });
}

void placeNuclearFrames(const DataSet& data, FileHeader& header) {
  const FrameNumbers windows = numbersOf(data, 0x00540010, header),
                     detectors = numbersOf(data, 0x00540020, header),
                     intervals = numbersOf(data, 0x00540060, header),
                     slots = numbersOf(data, 0x00540070, header), slices = slicesOf(data, header);
  const double distance = signedDistance(data, header);
  for (std::size_t n = 0; n < header.slices.size(); ++n) {
    Slice& slice = header.slices[n];
    setSeparator(slice, "EnergyWindowVector", textOf(windows, n));
    setSeparator(slice, "DetectorVector", textOf(detectors, n));
    setSeparator(slice, "RRIntervalVector", textOf(intervals, n));
    setSeparator(slice, "TimeSlotVector", textOf(slots, n));
    slice.inStack = slices.empty() ? 0 : slices[n];
    readDetectorPlace(data, detectors, n, header);
    if (header.slices.size() < 2 || !isPlaced(slice)) continue;
    if (slice.inStack == 0 || distance == 0)
      slice.position.reset();
    else
      *slice.position += (double(slice.inStack) - 1) * distance *
                         glm::cross(slice.orientation->row, slice.orientation->column);
  }
}

}  // namespace volumen::dicom
