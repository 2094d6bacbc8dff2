#include "io/dicom/scan.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace volumen::dicom {
namespace {

constexpr std::size_t depthLimit = 64, elementLimit = 1'000'000;
constexpr std::uint64_t metaLimit = 1 << 20;
constexpr std::uint64_t longestGuess = 64 << 10;  // longest value assumed for an element of unknown VR

bool isLetter(std::uint8_t c) { return c >= 'A' && c <= 'Z'; }

template <std::size_t n>
bool isOneOf(std::uint16_t vr, const char* const (&names)[n]) {
  return std::any_of(std::begin(names), std::end(names),
                     [&](const char* name) { return vr == vrOf(name[0], name[1]); });
}

}  // namespace

bool hasLongLength(std::uint16_t vr) {
  constexpr const char* names[] = {"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                   "SV", "UC", "UN", "UR", "UT", "UV"};
  return isOneOf(vr, names);
}

namespace {

/// Returns whether the VR is one of PS3.5 6.2.
bool isVr(std::uint16_t vr) {
  constexpr const char* names[] = {"AE", "AS", "AT", "CS", "DA", "DS", "DT", "FD", "FL", "IS", "LO",
                                   "LT", "PN", "SH", "SL", "SS", "ST", "TM", "UI", "UL", "US"};
  return hasLongLength(vr) || isOneOf(vr, names);
}

std::uint32_t tagAt(Bytes bytes, std::uint64_t offset, bool bigEndian) {
  return std::uint32_t(numberAt<std::uint16_t>(bytes, offset, bigEndian)) << 16 |
         numberAt<std::uint16_t>(bytes, offset + 2, bigEndian);
}

bool isPixelTag(std::uint32_t tag) { return tag == 0x7fe00008 || tag == 0x7fe00009 || tag == 0x7fe00010; }

/// A sequence or item that has not ended yet.
struct Open {
  enum Kind { sequence, item, fragments } kind;
  std::uint32_t index;  // index in the list of elements
  std::uint64_t end;    // end of its value; undefinedLength if a delimiter ends it
  Encoding encoding;    // encoding of its contents
};

/// The pass of scanDataSet.
class Pass {
 public:
  Pass(Bytes head, std::uint64_t offset, std::uint64_t fileSize, Encoding encoding)
      : head_(head), at_(offset), fileSize_(fileSize), encoding_(encoding) {}

  Result<DataSetScan> run() {
    while (!finished()) {
      if (!closeFinished()) return fail("reaches beyond the sequence it is in");
      if (finished()) break;
      if (!available(at_ + 8)) return needMore(at_ + 8);
      if (Status s = step(); !s) return s.error();
      if (scan_.needsUpTo || scan_.pixels) break;
    }
    if (!scan_.needsUpTo) endAll();
    scan_.end = at_;
    return std::move(scan_);
  }
  /// Returns the elements before the one where run() failed.
  DataSetScan before() && {
    endAll();
    // Sequences may claim more bytes than were read.
    for (Element& e : scan_.elements)
      if (e.length != undefinedLength) {
        e.offset = std::min<std::uint64_t>(e.offset, head_.size());
        e.length = std::min<std::uint64_t>(e.length, head_.size() - e.offset);
      }
    return std::move(scan_);
  }

 private:
  const Encoding& encoding() const { return open_.empty() ? encoding_ : open_.back().encoding; }
  std::uint64_t limit() const {
    for (auto it = open_.rbegin(); it != open_.rend(); ++it)
      if (it->end != undefinedLength) return it->end;
    return fileSize_;
  }
  bool available(std::uint64_t end) const { return end <= head_.size(); }
  void endAll() {
    for (const Open& open : open_) scan_.elements[open.index].end = std::uint32_t(scan_.elements.size());
  }
  // Fewer than eight bytes after the last element are padding.
  bool finished() const { return scan_.pixels || (open_.empty() && at_ + 8 > fileSize_); }

  Result<DataSetScan> needMore(std::uint64_t end) {
    if (end > fileSize_) return Error{"the file ends inside " + tagText(lastTag_) + " (it is cut off)"};
    scan_.needsUpTo = end;
    return std::move(scan_);
  }
  Error fail(const std::string& what) const {
    return Error{"element " + tagText(lastTag_) + " at byte " + std::to_string(at_) + " " + what};
  }

  bool closeFinished() {
    while (!open_.empty() && open_.back().end != undefinedLength && at_ >= open_.back().end) {
      if (at_ > open_.back().end) return false;
      close();
    }
    return true;
  }
  void close() {
    scan_.elements[open_.back().index].end = std::uint32_t(scan_.elements.size());
    open_.pop_back();
  }

  Status add(std::uint32_t tag, std::uint16_t vr, std::uint64_t header, std::uint64_t length) {
    if (scan_.elements.size() >= elementLimit) return Error{"the file has more than 1,000,000 elements"};
    const std::uint32_t next = std::uint32_t(scan_.elements.size()) + 1;
    scan_.elements.push_back({tag, vr, encoding().bigEndian, next, at_ + header, length});
    return {};
  }
  Status push(Open::Kind kind, Encoding inside) {
    if (open_.size() >= depthLimit) return Error{"sequences are nested deeper than 64 levels"};
    const Element& e = scan_.elements.back();
    const std::uint64_t end = e.length == undefinedLength ? undefinedLength : e.offset + e.length;
    open_.push_back({kind, std::uint32_t(scan_.elements.size()) - 1, end, inside});
    return {};
  }

  Status step() {
    lastTag_ = tagAt(head_, at_, encoding().bigEndian);
    if (lastTag_ >> 16 == 0xfffe) return delimiter();
    if (!open_.empty() && open_.back().kind != Open::item) return fail("stands where an item must stand");
    if (lastTag_ >> 16 == 0) return fail("belongs to group 0000, which no data set may hold");
    return element();
  }

  Status delimiter() {
    const std::uint64_t length = numberAt<std::uint32_t>(head_, at_ + 4, encoding().bigEndian);
    if (lastTag_ == itemTag) return item(length);
    if (length != 0) return fail("is a delimiter with a length");
    const bool endsItem = lastTag_ == itemEndTag, endsSequence = lastTag_ == sequenceEndTag;
    if (open_.empty() || !(endsItem || endsSequence)) return fail("stands outside any sequence");
    at_ += 8;
    const bool matches = endsItem == (open_.back().kind == Open::item);
    if (open_.back().end == undefinedLength && !matches) return fail("ends what was not begun");
    if (open_.back().end == undefinedLength) close();  // other delimiters are extra and harmless
    return {};
  }

  Status item(std::uint64_t length) {
    if (open_.empty() || open_.back().kind == Open::item) return fail("is an item outside any sequence");
    if (length != undefinedLength && at_ + 8 + length > limit()) return fail("is longer than what holds it");
    if (Status s = add(lastTag_, 0, 8, length); !s) return s;
    at_ += 8;
    if (open_.back().kind == Open::fragments) return skip(length);
    return push(Open::item, open_.back().encoding);
  }

  Status skip(std::uint64_t length) {
    if (length == undefinedLength) return fail("is a fragment without a length");
    at_ += length;
    return {};
  }

  Status element() {
    std::uint16_t vr = 0;
    std::uint64_t header = 8, length = 0;
    const bool big = encoding().bigEndian;
    if (!encoding().explicitVr) {
      length = numberAt<std::uint32_t>(head_, at_ + 4, big);
    } else {
      vr = vrOf(char(head_[at_ + 4]), char(head_[at_ + 5]));
      if (!isVr(vr)) return elementOfNoVr();
      if (hasLongLength(vr)) {
        header = 12;
        if (!available(at_ + 12)) return more(at_ + 12);
        length = numberAt<std::uint32_t>(head_, at_ + 8, big);
      } else {
        length = numberAt<std::uint16_t>(head_, at_ + 6, big);
      }
    }
    if (open_.empty() && isPixelTag(lastTag_)) {
      scan_.pixels = Element{lastTag_, vr, big, 0, at_ + header, length};
      return {};
    }
    return value(vr, header, length);
  }

  /// A possible layout of an element of unknown VR: the size of its header and the length of its value.
  struct Form {
    std::uint64_t header, length;
  };
  std::array<Form, 3> formsAt(std::uint64_t at) const {
    const bool big = encoding().bigEndian;
    return {Form{8, numberAt<std::uint16_t>(head_, at + 6, big)},
            Form{12, numberAt<std::uint32_t>(head_, at + 8, big)},
            Form{8, numberAt<std::uint32_t>(head_, at + 4, big)}};
  }

  /// Returns whether the data set continues at `at`, after `tag`: with an element of known VR, or with at
  /// most `more` others followed by one.
  bool goesOn(std::uint64_t at, std::uint32_t tag, int more) const {
    if (at == limit() || (open_.empty() && at <= fileSize_ && at + 8 > fileSize_)) return true;
    if (at > limit() || !available(at + 8)) return false;
    const std::uint32_t next = tagAt(head_, at, encoding().bigEndian);
    if (next == itemEndTag || next == sequenceEndTag) return !open_.empty();
    if (next <= tag) return false;
    if (isVr(vrOf(char(head_[at + 4]), char(head_[at + 5])))) return true;
    return more > 0 && available(at + 12) && std::ranges::any_of(formsAt(at), [&](const Form& f) {
             return f.length <= longestGuess && goesOn(at + f.header + f.length, next, more - 1);
           });
  }

  /// Reads an element whose VR is not in the standard: with a short length, a long one, or no VR at all. The
  /// layout that leads to another element wins.
  Status elementOfNoVr() {
    constexpr int mostInARow = 3;
    const std::uint64_t looked = std::min(fileSize_, at_ + 2 * longestGuess);
    if (at_ + 12 > fileSize_) return fail("has no valid VR");
    if (!available(looked)) return more(looked);
    const std::array<Form, 3> forms = formsAt(at_);
    if (open_.empty() && isPixelTag(lastTag_)) {
      const Form& form = at_ + forms[2].header + forms[2].length == fileSize_ ? forms[2] : forms[1];
      scan_.pixels =
          Element{lastTag_, vrOf('O', 'W'), encoding().bigEndian, 0, at_ + form.header, form.length};
      return {};
    }
    const bool isSequence = forms[1].length == undefinedLength && available(at_ + 16) &&
                            tagAt(head_, at_ + forms[1].header, encoding().bigEndian) == itemTag;
    if (isSequence) return value(0, forms[1].header, undefinedLength);
    for (int others = 0; others <= mostInARow; ++others)
      for (const Form& form : forms)
        if (form.length <= longestGuess && goesOn(at_ + form.header + form.length, lastTag_, others))
          return value(0, form.header, form.length);
    if (isLetter(head_[at_ + 4]) && isLetter(head_[at_ + 5]))
      return value(0, forms[0].header, forms[0].length);
    return fail("has no valid VR");
  }

  Status value(std::uint16_t vr, std::uint64_t header, std::uint64_t length) {
    const std::uint64_t begin = at_ + header;
    if (length != undefinedLength && begin + length > limit())
      return fail("claims " + std::to_string(length) + " bytes, more than there are (" +
                  std::to_string(limit() - std::min(limit(), begin)) + ")");
    if (Status s = add(lastTag_, vr, header, length); !s) return s;
    at_ = begin;
    if (length == undefinedLength) {
      if (vr == vrOf('O', 'B') || vr == vrOf('O', 'W')) return push(Open::fragments, encoding());
      if (vr != 0 && vr != vrOf('S', 'Q') && vr != vrOf('U', 'N')) return fail("has no length");
      // PS3.5 6.2.2: a sequence of VR UN is in implicit little endian.
      return push(Open::sequence, vr == vrOf('U', 'N') ? Encoding{false, false} : encoding());
    }
    if (vr == vrOf('S', 'Q')) return push(Open::sequence, encoding());
    if (!available(begin + length)) return more(begin + length);
    const bool standard = (lastTag_ >> 16) % 2 == 0;
    if (vr == 0 && standard && length >= 8 && tagAt(head_, begin, encoding().bigEndian) == itemTag)
      return push(Open::sequence, encoding());
    at_ += length;
    return {};
  }

  Status more(std::uint64_t end) {
    if (end > fileSize_) return Error{"the file ends inside " + tagText(lastTag_) + " (it is cut off)"};
    scan_.needsUpTo = end;
    return {};
  }

  Bytes head_;
  std::uint64_t at_, fileSize_;
  Encoding encoding_;
  std::uint32_t lastTag_ = 0;
  std::vector<Open> open_;
  DataSetScan scan_;
};

}  // namespace

bool hasMagic(Bytes head) { return head.size() >= 132 && std::memcmp(head.data() + 128, "DICM", 4) == 0; }

std::string tagText(std::uint32_t tag) {
  char text[16];
  std::snprintf(text, sizeof text, "(%04X,%04X)", unsigned(tag >> 16), unsigned(tag & 0xffff));
  return text;
}

Result<MetaHeader> scanMeta(Bytes head, std::uint64_t fileSize) {
  MetaHeader meta;
  meta.magic = hasMagic(head);
  std::uint64_t at = meta.magic ? 132 : 0;
  const std::uint64_t end = std::min<std::uint64_t>(head.size(), at + metaLimit);
  while (at + 8 <= end && tagAt(head, at, false) >> 16 == 2) {
    const std::uint32_t tag = tagAt(head, at, false);
    const std::uint16_t vr = vrOf(char(head[at + 4]), char(head[at + 5]));
    const bool isLong = hasLongLength(vr);
    if (!isLetter(head[at + 4]) || !isLetter(head[at + 5]) || (isLong && at + 12 > end))
      return Error{"the file meta information is damaged at " + tagText(tag)};
    const std::uint64_t length =
        isLong ? numberAt<std::uint32_t>(head, at + 8, false) : numberAt<std::uint16_t>(head, at + 6, false);
    const std::uint64_t begin = at + (isLong ? 12 : 8);
    if (length > fileSize || begin + length > end)
      return Error{"the file meta information is damaged at " + tagText(tag)};
    if (tag == 0x00020010) {
      meta.transferSyntaxUid.assign(reinterpret_cast<const char*>(head.data()) + begin, length);
      meta.transferSyntaxUid.erase(std::min(meta.transferSyntaxUid.find_first_of(std::string_view("\0 ", 2)),
                                            meta.transferSyntaxUid.size()));
    }
    at = begin + length;
  }
  // pydicom inserts an empty (0000,0000) if zeros followed the last element.
  constexpr std::array<std::uint8_t, 8> empty{};
  if (meta.magic && at + 8 <= end &&
      std::equal(empty.begin(), empty.end(), head.begin() + std::ptrdiff_t(at)))
    at += 8;
  meta.dataSet = at;
  return meta;
}

Encoding encodingFound(Bytes head, std::uint64_t offset, Encoding expected) {
  if (offset + 8 > head.size()) return expected;
  // The first group of a data set is small (0004, 0008), so its low byte is 0 in the wrong byte order.
  const std::uint16_t little = numberAt<std::uint16_t>(head, offset, false);
  Encoding found = expected;
  if (little != 0 && little < 0x0100) found.bigEndian = false;
  if (little != 0 && little % 0x0100 == 0) found.bigEndian = true;
  found.explicitVr = isLetter(head[offset + 4]) && isLetter(head[offset + 5]);
  return found;
}

Result<DataSetScan> scanDataSet(Bytes head, std::uint64_t offset, std::uint64_t fileSize, Encoding encoding,
                                DataSetScan* before) {
  Pass pass(head, offset, fileSize, encoding);
  Result<DataSetScan> found = pass.run();
  if (!found && before) *before = std::move(pass).before();
  return found;
}

}  // namespace volumen::dicom
