#include "io/export/dicom_elements.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <charconv>

namespace volumen {

namespace {

DcmTag tagOf(const DicomElement& e) {
  const DcmTagKey key(Uint16(e.tag >> 16), Uint16(e.tag & 0xffff));
  if (!e.vr) return DcmTag(key);
  const char name[] = {char(e.vr >> 8), char(e.vr & 0xff), '\0'};
  return DcmTag(key, DcmVR(name));
}

// The stack of nested items that elements of a list go into; the innermost is last.
class OpenItems {
 public:
  explicit OpenItems(DcmItem& root) : items_{&root} {}

  void add(const DicomElement& e) {
    const std::size_t depth = std::size_t(e.depth);
    if (e.tag == dicomItem) return addItem(depth);
    if (depth >= items_.size()) return;
    items_.resize(depth + 1);
    sequences_.resize(depth);
    const DcmTag tag = tagOf(e);
    if (tag.getEVR() == EVR_SQ) {
      sequences_.push_back(new DcmSequenceOfItems(tag));
      items_[depth]->insert(sequences_.back(), true);
    } else if (!e.value.empty() || !items_[depth]->tagExists(tag)) {
      items_[depth]->putAndInsertString(tag, e.value.c_str(), true);
    }
  }

 private:
  void addItem(std::size_t depth) {
    if (depth < 1 || depth > sequences_.size()) return;
    items_.resize(depth);
    sequences_.resize(depth);
    items_.push_back(new DcmItem);
    sequences_.back()->insert(items_.back());
  }

  std::vector<DcmItem*> items_;
  std::vector<DcmSequenceOfItems*> sequences_;  // the latest one at each depth
};

}  // namespace

// Adding + 0.0 turns -0 into 0.
std::string decimal(double value) {
  constexpr std::ptrdiff_t longest = 16;
  char text[32];
  const auto print = [&](auto... precision) {
    return std::to_chars(text, std::end(text), value + 0.0, precision...).ptr - text;
  };
  std::ptrdiff_t length = print();
  for (int digits = 16; length > longest; --digits) length = print(std::chars_format::general, digits);
  return std::string(text, std::size_t(length));
}

std::string decimals(std::initializer_list<double> values) {
  std::string text;
  for (double v : values) {
    if (!text.empty()) text += '\\';
    text += decimal(v);
  }
  return text;
}

std::string valueOf(std::span<const DicomElement> elements, std::uint32_t tag) {
  std::string value;
  for (const DicomElement& e : elements)
    if (e.tag == tag && e.depth == 0 && !e.value.empty()) value = e.value;
  return value;
}

void put(std::span<const DicomElement> elements, DcmItem& into) {
  OpenItems open(into);
  for (const DicomElement& e : elements) open.add(e);
}

}  // namespace volumen
