#include "io/dicom/fragments.h"

#include <algorithm>

namespace volumen::dicom {
namespace {

constexpr std::size_t fragmentLimit = 1'000'000;

/// Returns all items of the pixel data. The first is the basic offset table.
Result<std::vector<Range>> allItems(const RegularFile& file, const Element& pixels) {
  std::vector<Range> items;
  std::uint64_t at = pixels.offset;
  while (at + 8 <= file.size()) {
    const auto header = file.read(at, 8);
    if (!header) return header.error();
    const std::uint32_t tag = std::uint32_t(numberAt<std::uint16_t>(*header, 0, pixels.bigEndian)) << 16 |
                              numberAt<std::uint16_t>(*header, 2, pixels.bigEndian);
    const std::uint64_t length = numberAt<std::uint32_t>(*header, 4, pixels.bigEndian);
    if (tag == sequenceEndTag) return items;
    if (tag != itemTag || length == undefinedLength)
      return Error{"the pixel data holds " + tagText(tag) + " where a fragment must stand"};
    if (length > file.size() - at - 8) return Error{"the last fragment of the pixel data is cut off"};
    if (items.size() > fragmentLimit) return Error{"the pixel data has more than 1,000,000 fragments"};
    items.push_back({at + 8, length});
    at += 8 + length;
  }
  return items;
}

std::vector<FrameRanges> splitAt(const std::vector<Range>& fragments,
                                 const std::vector<std::size_t>& starts) {
  std::vector<FrameRanges> frames;
  for (std::size_t n = 0; n < starts.size(); ++n) {
    const std::size_t end = n + 1 < starts.size() ? starts[n + 1] : fragments.size();
    frames.emplace_back(fragments.begin() + std::ptrdiff_t(starts[n]),
                        fragments.begin() + std::ptrdiff_t(end));
  }
  return frames;
}

/// Returns the first fragment of each frame by the offset table; empty if it does not match the fragments.
std::vector<std::size_t> startsByTable(const std::vector<std::uint8_t>& table, const Element& pixels,
                                       const std::vector<Range>& fragments, std::size_t frames) {
  std::vector<std::size_t> starts;
  if (table.size() != 4 * frames) return starts;
  for (std::size_t n = 0; n < frames; ++n) {
    const std::uint64_t offset =
        fragments[0].offset + numberAt<std::uint32_t>(table, 4 * n, pixels.bigEndian);
    const auto it =
        std::lower_bound(fragments.begin(), fragments.end(), offset,
                         [](const Range& fragment, std::uint64_t at) { return fragment.offset < at; });
    const std::size_t index = std::size_t(it - fragments.begin());
    const bool found = it != fragments.end() && it->offset == offset;
    if (!found || (starts.empty() ? index != 0 : index <= starts.back())) return {};
    starts.push_back(index);
  }
  return starts;
}

/// Returns the fragments that begin with a start marker: SOI of JPEG and JPEG-LS, SOC of JPEG 2000.
Result<std::vector<std::size_t>> startsByMarker(const RegularFile& file,
                                                const std::vector<Range>& fragments) {
  std::vector<std::size_t> starts;
  for (std::size_t n = 0; n < fragments.size(); ++n) {
    if (fragments[n].length < 4) continue;
    const auto head = file.read(fragments[n].offset, 3);
    if (!head) return head.error();
    const bool begins =
        (*head)[0] == 0xff && ((*head)[1] == 0xd8 || (*head)[1] == 0x4f) && (*head)[2] == 0xff;
    if (begins) starts.push_back(n);
  }
  return starts;
}

}  // namespace

Result<std::vector<FrameRanges>> encapsulatedFrames(const RegularFile& file, const Element& pixels,
                                                    int frames) {
  const Result<std::vector<Range>> items = allItems(file, pixels);
  if (!items) return items.error();
  if (items->empty()) return Error{"the pixel data is empty"};
  const std::vector<Range> fragments(items->begin() + 1, items->end());
  const std::size_t wanted = std::size_t(frames);
  if (fragments.size() < wanted)
    return Error{"the file claims " + std::to_string(frames) + " frames, but its pixel data holds " +
                 std::to_string(fragments.size())};
  if (wanted == 1) return std::vector<FrameRanges>{fragments};
  std::vector<std::size_t> starts;
  if (fragments.size() == wanted) {
    for (std::size_t n = 0; n < wanted; ++n) starts.push_back(n);
  } else {
    const auto table = file.read((*items)[0].offset, (*items)[0].length);
    if (!table) return table.error();
    starts = startsByTable(*table, pixels, fragments, wanted);
  }
  if (starts.empty()) {
    const auto marked = startsByMarker(file, fragments);
    if (!marked) return marked.error();
    starts = *marked;
  }
  if (starts.size() != wanted || starts[0] != 0)
    return Error{"the fragments of its pixel data cannot be assigned to its " + std::to_string(frames) +
                 " frames"};
  return splitAt(fragments, starts);
}

Result<std::uint64_t> endOfFragments(const RegularFile& file, const Element& pixels) {
  constexpr std::uint64_t delimiter = 8;
  const Result<std::vector<Range>> items = allItems(file, pixels);
  if (!items) return items.error();
  const std::uint64_t end = items->empty() ? pixels.offset : items->back().offset + items->back().length;
  if (end + delimiter > file.size()) return Error{"the pixel data has no end"};
  return end + delimiter;
}

}  // namespace volumen::dicom
