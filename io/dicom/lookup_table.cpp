#include "io/dicom/lookup_table.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace volumen::dicom {
namespace {

/// Expands segmented table data (PS3.3 C.7.9.2): opcodes, lengths and values of 8 or 16 bits each.
class Segments {
 public:
  Segments(std::vector<std::uint16_t> words, bool wide, std::size_t count)
      : words_(std::move(words)), wide_(wide), count_(count) {}

  /// Returns all entries, or none if the segments do not give exactly `count_` entries.
  std::vector<std::uint16_t> expanded() {
    std::size_t at = 0;
    while (entries_.size() < count_ && at < words_.size())
      if (!segment(at, true)) return {};
    entries_.resize(entries_.size() == count_ ? count_ : 0);
    return entries_;
  }

 private:
  enum Opcode { discrete = 0, linear = 1, indirect = 2 };

  bool segment(std::size_t& at, bool mayBeIndirect) {
    if (at + 2 > words_.size()) return false;
    const int opcode = words_[at];
    const std::size_t length = words_[at + 1];
    at += 2;
    if (opcode == discrete) return copy(at, length);
    if (opcode == linear) return slope(at, length);
    return opcode == indirect && mayBeIndirect && repeat(at, length);
  }

  bool copy(std::size_t& at, std::size_t length) {
    if (length > words_.size() - at || length > count_ - entries_.size()) return false;
    entries_.insert(entries_.end(), words_.begin() + std::ptrdiff_t(at),
                    words_.begin() + std::ptrdiff_t(at + length));
    at += length;
    return true;
  }

  /// Appends a slope from the previous entry (not repeated) to the end value.
  bool slope(std::size_t& at, std::size_t length) {
    if (entries_.empty() || at >= words_.size() || length > count_ - entries_.size()) return false;
    const double from = entries_.back(), to = words_[at++];
    for (std::size_t n = 1; n <= length; ++n)
      entries_.push_back(std::uint16_t(std::floor(from + (to - from) * double(n) / double(length) + 0.5)));
    return true;
  }

  /// Repeats earlier segments from a byte offset on, whose least significant part is first.
  bool repeat(std::size_t& at, std::size_t segments) {
    const std::size_t parts = wide_ ? 2 : 4;
    if (parts > words_.size() - at) return false;
    std::size_t offset = 0;
    for (std::size_t n = 0; n < parts; ++n) offset |= std::size_t(words_[at + n]) << (wide_ ? 16 : 8) * n;
    at += parts;
    std::size_t earlier = wide_ ? offset / 2 : offset;
    for (std::size_t n = 0; n < segments; ++n)
      if (earlier >= words_.size() || !segment(earlier, false)) return false;
    return true;
  }

  std::vector<std::uint16_t> words_;
  bool wide_;
  std::size_t count_;
  std::vector<std::uint16_t> entries_;
};

std::vector<std::uint16_t> bytesAsWords(const std::vector<std::uint8_t>& bytes) {
  return {bytes.begin(), bytes.end()};
}

/// Returns the entries of the data: words, or bytes if there are too few words. Bytes in a table of more than
/// 8 bits are accepted only if there are as many as entries.
std::vector<std::uint16_t> plainEntries(const DataSet& data, DataSet::Scope scope, std::uint32_t tag,
                                        std::size_t count, int& bits) {
  std::vector<std::uint16_t> entries = data.words(tag, scope);
  if (entries.size() < count && (bits == 8 || entries.size() == (count + 1) / 2)) {
    entries = bytesAsWords(data.bytes(tag, scope));
    bits = 8;
  }
  if (entries.size() < count) return {};
  entries.resize(count);
  return entries;
}

/// Returns the entries of segmented data, of the declared width if that fits, else of the other one.
std::vector<std::uint16_t> segmentedEntries(const DataSet& data, DataSet::Scope scope, std::uint32_t tag,
                                            std::size_t count, int& bits) {
  for (const bool wide : {bits > 8, bits <= 8}) {
    auto parts = wide ? data.words(tag, scope) : bytesAsWords(data.bytes(tag, scope));
    const std::vector<std::uint16_t> entries = Segments(std::move(parts), wide, count).expanded();
    if (entries.empty()) continue;
    if (wide != (bits > 8)) bits = wide ? 16 : 8;
    return entries;
  }
  return {};
}

}  // namespace

std::uint16_t LookupTable::at(double input) const {
  return entries[std::size_t(std::clamp(input - first, 0.0, double(entries.size() - 1)))];
}

int LookupTable::usedBits() const { return int(std::bit_width(unsigned(std::ranges::max(entries)))); }

Result<LookupTable> readLookupTable(const DataSet& data, DataSet::Scope scope, LookupTags tags,
                                    bool isSigned) {
  const std::vector<std::uint16_t> descriptor = data.words(tags.descriptor, scope);
  if (descriptor.size() < 3)
    return Error{"the descriptor " + tagText(tags.descriptor) +
                 " of a look-up table is missing or too short"};
  constexpr std::size_t most = 65536;  // written as 0
  const std::size_t count = descriptor[0] ? descriptor[0] : most;
  const int bits = descriptor[2];
  if (bits < 8 || bits > 16)
    return Error{"a look-up table " + tagText(tags.descriptor) + " has entries of " + std::to_string(bits) +
                 " bits; 8 to 16 are read"};
  const bool isNegative = isSigned || data.find(tags.descriptor, scope)->vr == vrOf('S', 'S');
  LookupTable table;
  table.first = isNegative ? double(std::int16_t(descriptor[1])) : double(descriptor[1]);
  table.bits = table.saidBits = bits;
  const bool inSegments = tags.segments && data.has(tags.segments, scope);
  table.entries = inSegments ? segmentedEntries(data, scope, tags.segments, count, table.bits)
                             : plainEntries(data, scope, tags.data, count, table.bits);
  if (table.entries.empty())
    return Error{"a look-up table " + tagText(inSegments ? tags.segments : tags.data) +
                 " does not hold the " + std::to_string(count) + " entries that its descriptor announces"};
  // Too large entries are clipped for greys. A palette's entries are colours and must keep their values.
  if (tags.segments && table.bits == 8 && table.usedBits() > 8) table.bits = 16;
  if (table.bits != bits)
    data.remark("one of its look-up tables says that its entries have " + std::to_string(bits) +
                " bits, and they have " + std::to_string(table.bits) + ": they were read as they are");
  return table;
}

}  // namespace volumen::dicom
