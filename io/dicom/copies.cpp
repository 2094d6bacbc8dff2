#include "io/dicom/copies.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "io/regular_file.h"

namespace volumen::dicom {
namespace {

/// Returns the bytes of a frame as stored, or nothing if they cannot be read.
std::optional<std::vector<std::uint8_t>> bytesOf(const FileHeader& file, int frame) {
  const Result<RegularFile> opened = RegularFile::open(file.path);
  if (!opened || file.frames.empty()) return {};
  std::vector<std::uint8_t> bytes;
  for (const Range& range : file.frames[std::min(std::size_t(frame), file.frames.size() - 1)]) {
    const auto part = opened->read(range.offset, range.length);
    if (!part) return {};
    bytes.insert(bytes.end(), part->begin(), part->end());
  }
  return bytes;
}

/// Returns false if the stored bytes of two pictures differ. Differently coded pictures cannot be compared.
bool mayBeAlike(const Entry& a, const Entry& b) {
  const FileHeader &x = *a.file, &y = *b.file;
  if (x.syntax.uid != y.syntax.uid || x.inflatedFrom || y.inflatedFrom) return true;
  const auto first = bytesOf(x, a.slice().frame), second = bytesOf(y, b.slice().frame);
  return !first || !second || *first == *second;
}

/// Returns the facts that agree in copies of one picture.
auto factsOf(const Entry& e) {
  const Slice& s = e.slice();
  const PixelFormat& f = e.file->format;
  return std::tie(e.placed.alongNormal, s.instance, s.slope, s.intercept, s.separators, f.isSigned,
                  f.bitsStored, f.highBit);
}

}  // namespace

std::vector<std::string> dropCopies(Entries& entries) {
  std::vector<std::string> warnings;
  std::map<std::pair<std::string, int>, Entries> seen;
  std::size_t copies = 0, others = 0;
  std::string copy, other;
  Entries kept;
  for (const Entry& e : entries) {
    const std::string& uid = e.file->sopInstanceUid;
    Entries& same = seen[{uid, e.slice().frame}];
    const auto of = std::ranges::find_if(
        same, [&](const Entry& s) { return factsOf(s) == factsOf(e) && mayBeAlike(s, e); });
    if (uid.empty() || of == same.end()) {
      if (!uid.empty() && !same.empty() && others++ == 0)
        other = fileName(e.file->path) + " has the SOP Instance UID of " + fileName(same[0].file->path) +
                ", but is another picture";
      same.push_back(e);
      kept.push_back(e);
    } else if (copies++ == 0) {
      copy = fileName(e.file->path) + " is a copy of " + fileName(of->file->path) + " and is left out";
    }
  }
  if (copies > 1) copy += ", and so are " + std::to_string(copies - 1) + " other copies";
  if (copies) warnings.push_back(copy + ".");
  if (others > 1) other += ", and so it is with " + std::to_string(others - 1) + " more";
  if (others) warnings.push_back(other + ".");
  entries = std::move(kept);
  return warnings;
}

}  // namespace volumen::dicom
