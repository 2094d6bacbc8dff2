#include "io/dicom/derived_object.h"

#include <algorithm>
#include <unordered_map>

namespace volumen::dicom {
namespace {

constexpr std::uint32_t instanceUid = 0x00081155;
constexpr int mostFrames = 1'000'000;

/// Tracks the items around an element and the series they name; the innermost wins.
class SeriesAround {
 public:
  explicit SeriesAround(const DataSet& data) : data_(data) {}

  void leave(std::uint32_t n) {
    while (!open_.empty() && open_.back().end <= n) open_.pop_back();
  }
  void enter(DataSet::Scope item) {
    std::string uid = data_.text(0x0020000e, item);
    if (uid.empty() && !open_.empty()) uid = open_.back().uid;
    open_.push_back({item.end, item, std::move(uid)});
  }
  bool isInside() const { return !open_.empty(); }
  DataSet::Scope item() const { return open_.back().item; }
  const std::string& uid() const { return open_.back().uid; }

 private:
  struct Item {
    std::uint32_t end;
    DataSet::Scope item;
    std::string uid;
  };
  const DataSet& data_;
  std::vector<Item> open_;
};

/// Returns whether a class is a procedure (study management, procedure steps, work lists) without pixels or
/// content.
bool isProcedure(const std::string& sopClassUid) {
  constexpr const char* roots[] = {"1.2.840.10008.3.1.", "1.2.840.10008.5.1.4.31", "1.2.840.10008.5.1.4.34"};
  return std::any_of(std::begin(roots), std::end(roots),
                     [&](const char* root) { return sopClassUid.starts_with(root); });
}

std::vector<int> readFrames(const DataSet& data, DataSet::Scope item) {
  std::vector<int> frames;
  for (const double number : data.numbers(0x00081160, item).value_or(std::vector<double>()))
    if (number >= 1 && number <= mostFrames) frames.push_back(int(number) - 1);
  return frames;
}

/// Merges the numbers of two references. An empty list means all, so it wins.
void mergeNumbers(std::vector<int>& known, const std::vector<int>& more) {
  if (known.empty() || more.empty()) return known.clear();
  known.insert(known.end(), more.begin(), more.end());
}

void merge(ReferencedPicture& known, const ReferencedPicture& more) {
  if (known.seriesUid.empty()) known.seriesUid = more.seriesUid;
  mergeNumbers(known.frames, more.frames);
  mergeNumbers(known.segments, more.segments);
}

void sortNumbers(std::vector<int>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// Returns the code meaning of a document's title.
std::string titleOf(const DataSet& data) {
  const auto codes = data.items(0x0040a043, data.root());
  return codes.empty() ? std::string() : data.utf8(0x00080104, codes[0]);
}

/// Returns the remark of a key object document on its pictures: Key Object Description (113012, DCM).
std::string keyText(const DataSet& data) {
  for (const DataSet::Scope item : data.items(0x0040a730, data.root())) {
    const auto names = data.items(0x0040a043, item);
    if (!names.empty() && data.text(0x00080100, names[0]) == "113012") return data.utf8(0x0040a160, item);
  }
  return {};
}

void readLabel(const DataSet& data, DerivedObject& object) {
  const auto text = [&](std::uint32_t tag) { return data.utf8(tag, data.root()); };
  switch (object.kind) {
    case DerivedKind::presentation:
    case DerivedKind::segmentation:
      object.label = text(0x00700080);
      object.text = text(0x00700081);
      break;
    case DerivedKind::keyObjects:
      object.label = titleOf(data);
      object.text = keyText(data);
      break;
    case DerivedKind::report:
      object.label = titleOf(data);
      break;
    case DerivedKind::contours:
      object.label = text(0x30060002);
      object.text = data.has(0x30060006, data.root()) ? text(0x30060006) : text(0x30060004);
      break;
  }
  for (const std::uint32_t date : {0x00080023u, 0x00700082u, 0x30060008u})
    if (object.date.empty()) object.date = dateOrTime(text(date));
}

/// Reads the names of segments and regions for remarks on their letters alone.
void readNames(const DataSet& data, DerivedKind kind) {
  const bool isContours = kind == DerivedKind::contours;
  if (!isContours && kind != DerivedKind::segmentation) return;
  for (const DataSet::Scope item : data.items(isContours ? 0x30060020 : 0x00620002, data.root()))
    (void)data.utf8(isContours ? 0x30060026 : 0x00620005, item);
}

}  // namespace

std::optional<DerivedKind> derivedKind(const std::string& sopClassUid) {
  constexpr std::string_view storage = "1.2.840.10008.5.1.4.1.1.";
  if (!sopClassUid.starts_with(storage)) return {};
  const std::string_view name = std::string_view(sopClassUid).substr(storage.size());
  if (name.starts_with("11.")) return DerivedKind::presentation;
  if (name == "88.59") return DerivedKind::keyObjects;
  if (name.starts_with("88.")) return DerivedKind::report;
  if (name == "481.3") return DerivedKind::contours;
  if (name == "66.4" || name == "66.7") return DerivedKind::segmentation;
  return {};
}

std::vector<ReferencedPicture> readPictures(const DataSet& data, DataSet::Scope scope) {
  std::vector<ReferencedPicture> pictures;
  std::unordered_map<std::string, std::size_t> known;
  SeriesAround around(data);
  for (std::uint32_t n = scope.begin; n < scope.end; ++n) {
    const Element& e = data.element(n);
    around.leave(n);
    if (e.tag == itemTag) around.enter({n + 1, e.end});
    if (e.tag != instanceUid || !around.isInside()) continue;
    const DataSet::Scope item = around.item();
    const auto segments = data.words(0x0062000b, item);
    ReferencedPicture picture{data.text(instanceUid, item),
                              around.uid(),
                              readFrames(data, item),
                              {segments.begin(), segments.end()}};
    if (picture.sopInstanceUid.empty() || isProcedure(data.text(0x00081150, item))) continue;
    const auto [at, isNew] = known.emplace(picture.sopInstanceUid, pictures.size());
    isNew ? pictures.push_back(std::move(picture)) : merge(pictures[at->second], picture);
  }
  for (ReferencedPicture& p : pictures) sortNumbers(p.frames), sortNumbers(p.segments);
  return pictures;
}

DerivedObject readDerivedObject(const DataSet& data, const FileHeader& header, DerivedKind kind) {
  DerivedObject object;
  static_cast<SeriesIdentity&>(object) = header;
  object.kind = kind;
  object.id = instanceId(header);
  object.path = header.path;
  object.sopInstanceUid = header.sopInstanceUid;
  // Only the list of a presentation state counts, as its annotations name some of its pictures again.
  const bool listed = kind == DerivedKind::presentation;
  object.pictures = readPictures(data, listed ? data.contents(0x00081115, data.root()) : data.root());
  readLabel(data, object);
  readNames(data, kind);
  for (const std::string& remark : data.remarks()) object.warnings.push_back(sentenceOf(remark));
  return object;
}

Code codeIn(const DataSet& data, DataSet::Scope item) {
  Code code{{}, data.utf8(0x00080102, item), data.utf8(0x00080104, item)};
  for (const std::uint32_t value : {0x00080100u, 0x00080119u, 0x00080120u})
    if (code.value.empty()) code.value = data.utf8(value, item);
  return code;
}

Code codeAt(const DataSet& data, std::uint32_t sequence, DataSet::Scope scope) {
  const auto codes = data.items(sequence, scope);
  return codes.empty() ? Code() : codeIn(data, codes[0]);
}

Result<InspectedFile> openObject(const std::string& path, DerivedKind kind) {
  InspectedFile file = inspectFile(path);
  if (file.found.derivedObject && file.found.derivedObject->kind == kind) return file;
  if (file.found.kind == Inspection::Kind::refused) return Error{path + ": " + file.found.text};
  return Error{path + ": it holds no " + kindName(kind) + "."};
}

}  // namespace volumen::dicom
