#include "io/dicom/csa.h"

#include <algorithm>

namespace volumen::dicom {
namespace {

constexpr std::size_t nameBytes = 64, fieldBytes = 84, itemBytes = 16;
constexpr std::uint32_t mostFields = 1024, mostItems = 4096;

/// Reads the header front to back. `ok_` becomes false at the first missing part.
class CsaReader {
 public:
  explicit CsaReader(Bytes bytes) : bytes_(bytes), isSecond_(textAt(0, 4) == "SV10") {}

  CsaFields fields() {
    CsaFields all;
    at_ = isSecond_ ? 8 : 0;
    const std::uint32_t count = std::min(dword(), mostFields);
    dword();
    for (std::uint32_t n = 0; n < count && ok_; ++n) {
      if (!has(fieldBytes)) break;
      const std::string name = textAt(at_, nameBytes);
      const std::uint32_t items = numberAt<std::uint32_t>(bytes_, at_ + 76, false);
      if (n == 0) firstItems_ = items;
      at_ += fieldBytes;
      if (items > mostItems) break;
      std::vector<std::string> values;
      for (std::uint32_t item = 0; item < items && ok_; ++item)
        if (std::string value = nextItem(); !value.empty()) values.push_back(std::move(value));
      if (ok_) all.emplace(name, std::move(values));
    }
    return all;
  }

 private:
  bool has(std::uint64_t count) {
    ok_ = ok_ && count <= bytes_.size() && at_ <= bytes_.size() - count;
    return ok_;
  }
  std::uint32_t dword() {
    if (!has(4)) return 0;
    at_ += 4;
    return numberAt<std::uint32_t>(bytes_, at_ - 4, false);
  }
  /// Returns the text up to the first NUL, without spaces at its ends.
  std::string textAt(std::size_t at, std::size_t count) const {
    if (at > bytes_.size()) return {};
    const Bytes part = bytes_.subspan(at, std::min(count, bytes_.size() - at));
    std::string text(part.begin(), std::find(part.begin(), part.end(), 0));
    text.erase(0, text.find_first_not_of(' '));
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
  }
  std::string nextItem() {
    if (!has(itemBytes)) return {};
    const std::uint32_t first = numberAt<std::uint32_t>(bytes_, at_, false);
    // The first version adds the item count of the first field to every length.
    const std::uint32_t length =
        isSecond_ ? numberAt<std::uint32_t>(bytes_, at_ + 4, false) : first - std::min(first, firstItems_);
    at_ += itemBytes;
    if (!has(length)) return {};
    const std::string value = textAt(at_, length);
    at_ += (std::uint64_t(length) + 3) / 4 * 4;
    return value;
  }

  Bytes bytes_;
  bool isSecond_, ok_ = true;
  std::uint64_t at_ = 0;
  std::uint32_t firstItems_ = 0;
};

}  // namespace

CsaFields readCsa(Bytes bytes) { return CsaReader(bytes).fields(); }

CsaFields readCsaImageHeader(const DataSet& data) {
  constexpr std::uint32_t group = 0x00290000, imageHeader = 0x10;
  for (std::uint32_t block = 0x10; block <= 0xff; ++block) {
    if (data.text(group | block, data.root()) != "SIEMENS CSA HEADER") continue;
    const std::vector<std::uint8_t> bytes = data.bytes(group | block << 8 | imageHeader, data.root());
    return readCsa(bytes);
  }
  return {};
}

}  // namespace volumen::dicom
