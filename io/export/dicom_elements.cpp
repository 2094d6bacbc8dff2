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

// DCMTK reads numbers less exactly than it could.
template <class T>
std::vector<T> numbersOf(const std::string& text) {
  std::vector<T> all;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\\', begin), text.size());
    T number = 0;
    std::from_chars(text.data() + begin, text.data() + end, number);
    all.push_back(number);
    begin = end + 1;
  }
  return all;
}

void putValue(const DcmTag& tag, const std::string& value, DcmItem& into) {
  if (tag.getEVR() == EVR_FD) {
    const auto numbers = numbersOf<double>(value);
    into.putAndInsertFloat64Array(tag, numbers.data(), static_cast<unsigned long>(numbers.size()));
  } else if (tag.getEVR() == EVR_FL) {
    const auto numbers = numbersOf<float>(value);
    into.putAndInsertFloat32Array(tag, numbers.data(), static_cast<unsigned long>(numbers.size()));
  } else {
    into.putAndInsertString(tag, value.c_str(), true);
  }
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
      putValue(tag, e.value, *items_[depth]);
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

std::string inOneLine(const std::string& text) {
  constexpr std::size_t longest = 64;  // characters of LO
  std::string line;
  std::size_t characters = 0;
  for (const char c : text) {
    characters += (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    if (characters > longest) return line.substr(0, line.find_last_not_of(" ,") + 1);
    line += c == '\\' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  return line;
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
