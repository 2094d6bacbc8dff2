#include "io/dicom/attribute_list.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdicent.h>
#include <dcmtk/dcmdata/dcdict.h>

#include <algorithm>
#include <charconv>

#include "io/dicom/data_set.h"
#include "io/dicom/scanned_file.h"
#include "io/worker/batches.h"
#include "io/worker/object_fields.h"

namespace volumen::dicom {

namespace {

constexpr std::size_t longestValue = 400, mostNumbers = 64;
constexpr std::uint32_t charset = 0x00080005;

struct Known {
  std::string name, vr;
};

// Returns the entry of DCMTK's dictionary. Private tags are looked up by the creator of their block.
Known lookUp(std::uint32_t tag, const std::string& creator) {
  const DcmTagKey key(Uint16(tag >> 16), Uint16(tag & 0xffff));
  const DcmDataDictionary& dictionary = dcmDataDict.rdlock();
  const DcmDictEntry* entry = dictionary.findEntry(key, creator.empty() ? nullptr : creator.c_str());
  Known known;
  if (entry) known = {entry->getTagName(), entry->getVR().getVRName()};
  dcmDataDict.rdunlock();
  return known;
}

template <class T>
std::string numbersIn(Bytes bytes, bool bigEndian) {
  std::string text;
  for (std::size_t n = 0; n + sizeof(T) <= bytes.size() && n < mostNumbers * sizeof(T); n += sizeof(T)) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, numberAt<T>(bytes, n, bigEndian)).ptr;
    if (!text.empty()) text += '\\';
    text.append(digits, end);
  }
  return text;
}

class Lister {
 public:
  Lister(Bytes bytes, const std::vector<Element>& elements, std::string characters)
      : bytes_(bytes), elements_(elements), data_(bytes, elements), characters_(std::move(characters)) {}

  std::vector<AttributeLine> list() {
    add(data_.root(), 0);
    return std::move(lines_);
  }

 private:
  // The recursion is bounded, as the scan limits the depth of sequences.
  void add(DataSet::Scope scope, int depth) {
    int item = 0;
    for (std::uint32_t n = scope.begin; n < scope.end; n = elements_[n].end) {
      const Element& e = elements_[n];
      if (e.tag == itemTag)
        lines_.push_back({depth, "Item " + std::to_string(++item), {}, {}, {}});
      else
        lines_.push_back(lineOf(e, n, scope, depth));
      add({n + 1, e.end}, depth + 1);
    }
  }

  AttributeLine lineOf(const Element& e, std::uint32_t n, DataSet::Scope scope, int depth) const {
    const bool isPrivate = e.tag >> 16 & 1, isBlock = (e.tag & 0xffff) <= 0xff;
    const std::uint32_t block = (e.tag & 0xffff0000) | (e.tag >> 8 & 0xff);
    Known known = lookUp(e.tag, isPrivate && !isBlock ? data_.text(block, scope) : std::string());
    if (isPrivate && isBlock) known = {"PrivateCreator", "LO"};
    if (e.vr) known.vr = {char(e.vr >> 8), char(e.vr & 0xff)};
    if (e.end > n + 1) known.vr = "SQ";
    return {depth, tagText(e.tag), known.name, known.vr, valueOf(e, n, known.vr)};
  }

  std::string valueOf(const Element& e, std::uint32_t n, const std::string& vr) const {
    if (vr == "SQ" || e.length == undefinedLength) {
      int items = 0;
      for (std::uint32_t m = n + 1; m < e.end; m = elements_[m].end) ++items;
      return vr == "SQ" ? std::to_string(items) + (items == 1 ? " item" : " items") : "fragments";
    }
    if (e.offset + e.length > bytes_.size()) return std::to_string(e.length) + " bytes";  // pixels
    const Bytes value = bytes_.subspan(e.offset, e.length);
    if (vr == "US") return numbersIn<std::uint16_t>(value, e.bigEndian);
    if (vr == "SS") return numbersIn<std::int16_t>(value, e.bigEndian);
    if (vr == "UL") return numbersIn<std::uint32_t>(value, e.bigEndian);
    if (vr == "SL") return numbersIn<std::int32_t>(value, e.bigEndian);
    if (vr == "UV") return numbersIn<std::uint64_t>(value, e.bigEndian);
    if (vr == "SV") return numbersIn<std::int64_t>(value, e.bigEndian);
    if (vr == "FL") return numbersIn<float>(value, e.bigEndian);
    if (vr == "FD") return numbersIn<double>(value, e.bigEndian);
    if (vr == "AT" && value.size() == 4)
      return tagText(std::uint32_t(numberAt<std::uint16_t>(value, 0, e.bigEndian)) << 16 |
                     numberAt<std::uint16_t>(value, 2, e.bigEndian));
    constexpr const char* texts[] = {"AE", "AS", "CS", "DA", "DS", "DT", "IS", "LO", "LT",
                                     "PN", "SH", "ST", "TM", "UC", "UI", "UR", "UT"};
    if (std::find(std::begin(texts), std::end(texts), vr) == std::end(texts))
      return std::to_string(e.length) + " bytes";
    return textIn(value);
  }

  std::string textIn(Bytes value) const {
    std::string text(reinterpret_cast<const char*>(value.data()), std::min(value.size(), longestValue));
    while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.pop_back();
    return toUtf8(text, characters_) + (value.size() > longestValue ? " ..." : "");
  }

  Bytes bytes_;
  const std::vector<Element>& elements_;
  DataSet data_;
  std::string characters_;
  std::vector<AttributeLine> lines_;
};

std::vector<AttributeLine> linesOf(Bytes bytes, const std::vector<Element>& elements) {
  const DataSet data(bytes, elements);
  return Lister(bytes, elements, data.text(charset, data.root())).list();
}

Result<std::vector<AttributeLine>> listAttributesHere(const std::string& path) {
  worker::needAll();
  const Result<RegularFile> file = RegularFile::open(path);
  if (!file) return file.error();
  ScannedFile s;
  if (Status read = s.readMeta(*file); !read) return read.error();
  std::vector<AttributeLine> lines;
  if (hasMagic(s.head) && s.meta.dataSet <= s.head.size()) {
    const Bytes before = Bytes(s.head).first(s.meta.dataSet);
    constexpr std::uint64_t preamble = 132;
    if (const auto found = scanDataSet(before, preamble, s.meta.dataSet, Encoding{}); found)
      lines = linesOf(before, found->elements);
  }
  if (Status scanned = s.scan(*file); !scanned) return scanned.error();
  const std::vector<AttributeLine> rest = linesOf(s.head, s.dataSet.elements);
  lines.insert(lines.end(), rest.begin(), rest.end());
  if (lines.empty()) return Error{"it holds no DICOM attributes"};
  if (s.dataSet.pixels)
    lines.push_back({0, tagText(s.dataSet.pixels->tag), lookUp(s.dataSet.pixels->tag, {}).name, "OW",
                     s.dataSet.pixels->length == undefinedLength
                         ? "fragments"
                         : std::to_string(s.dataSet.pixels->length) + " bytes"});
  return lines;
}

}  // namespace

Result<std::vector<AttributeLine>> listAttributes(const std::string& path) {
  const CancelToken never;
  worker::Request request = worker::headersOf({path}, never);
  worker::Failure failure{};
  return worker::isolated<listAttributesHere>(request, failure, path);
}

}  // namespace volumen::dicom
