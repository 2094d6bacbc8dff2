#include "io/export/dicom_source.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdict.h>
#include <dcmtk/dcmdata/dctag.h>

#include <algorithm>
#include <charconv>
#include <map>

#include "io/dicom/data_set.h"
#include "io/dicom/diffusion.h"
#include "io/dicom/frame_scopes.h"
#include "io/dicom/header.h"
#include "io/dicom/separators.h"
#include "io/export/copied_elements.h"
#include "io/export/dicom_modules.h"
#include "io/study/series.h"
#include "io/worker/batches.h"
#include "io/worker/serve.h"

namespace volumen {

namespace worker {
inline void fields(Wire& w, DicomElement& e) { w(e.tag, e.value, e.vr, e.depth); }
inline void fields(Wire& w, DicomSourceFrame::Place& p) { w(p.position, p.right, p.down, p.mm); }
inline void fields(Wire& w, DicomSourceFrame& f) { w(f.place, f.slope, f.intercept, f.elements); }
inline void fields(Wire& w, DicomSourceFile& f) {
  w(f.problem, f.sopClassUid, f.sopInstanceUid, f.isSigned, f.frameCount, f.elements, f.ofStudy,
    f.characterSet, f.frames);
}
}  // namespace worker

namespace {

using dicom::DataSet;
using dicom::vrOf;

constexpr int deepest = 6;
constexpr std::size_t longestValue = 64 << 10, mostNumbers = 4096;
constexpr std::uint32_t characterSet = 0x00080005, imageType = 0x00080008, scanningSequenceTag = 0x00180020,
                        inversionTimeTag = 0x00180082;

std::uint16_t dictionaryVr(std::uint32_t tag) {
  const char* name = DcmTag(Uint16(tag >> 16), Uint16(tag & 0xffff)).getVRName();
  return vrOf(name[0], name[1]);
}

bool isOneOf(std::uint16_t vr, std::initializer_list<const char*> names) {
  return std::ranges::any_of(names, [&](const char* n) { return vr == vrOf(n[0], n[1]); });
}

// Collects the copied elements of one file.
class Copier {
 public:
  Copier(const DataSet& data, dicom::Bytes bytes) : data_(data), bytes_(bytes) {}

  DicomElements ofFile() const {
    DicomElements all;
    add(data_.root(), 0, all);
    addScanningSequence(all);
    addPhilipsFactors(all);
    addPrivateDirection(all);
    return all;
  }

  // Sets the elements of patient and study, including empty ones. Texts stay as stored if all are in the
  // declared character set.
  void setStudy(DicomSourceFile& file) const {
    Copier copier(data_, bytes_);
    copier.ofStudy_ = copier.asStored_ = true;
    copier.add(data_.root(), 0, file.ofStudy);
    file.characterSet = data_.text(characterSet, data_.root());
    if (copier.isAsDeclared_) return;
    copier.asStored_ = false;
    file.ofStudy.clear();
    copier.add(data_.root(), 0, file.ofStudy);
    file.characterSet = "ISO_IR 192";
  }

  // Returns elements from the functional groups of one frame, or from the shared ones.
  DicomElements ofGroups(DataSet::Scope groups) const {
    DicomElements all;
    for (std::uint32_t n = groups.begin; n < groups.end; n = data_.element(n).end)
      for (const DataSet::Scope& item : data_.items(data_.element(n).tag, groups)) {
        addRenamed(item, all);
        add(item, 0, all);
        for (const DataSet::Scope& inner : data_.items(0x00189076, item)) add(inner, 0, all);  // gradient
        break;
      }
    // Single-frame images have an inversion time only for inversion recovery.
    if (!recoversInversion(scopesOf(groups)) &&
        valueOf(all, scanningSequenceTag).find("IR") == std::string::npos)
      std::erase_if(all, [](const DicomElement& e) { return e.tag == inversionTimeTag && e.depth == 0; });
    return all;
  }

 private:
  dicom::FrameScopes scopesOf(DataSet::Scope groups) const {
    const auto shared = data_.items(dicom::FrameScopes::sharedGroups, data_.root());
    return {data_, groups, shared.empty() ? DataSet::Scope{} : shared[0]};
  }

  bool recoversInversion(const dicom::FrameScopes& scopes) const {
    constexpr std::uint32_t modifiers = 0x00189115, inversionRecovery = 0x00189009;
    return data_.text(inversionRecovery, scopes.of(modifiers)) == "YES";
  }

  void add(DataSet::Scope scope, int depth, DicomElements& out) const {
    for (std::uint32_t n = scope.begin; n < scope.end; n = data_.element(n).end) {
      const dicom::Element& e = data_.element(n);
      const bool isPrivate = e.tag >> 16 & 1;
      if (e.tag == characterSet && depth > 0) isAsDeclared_ = false;  // this item has its own character set
      const bool isWanted = depth > 0 || (ofStudy_ ? isOfStudy(e.tag) : isCopied(e.tag));
      if (isPrivate || e.tag == characterSet || !isWanted) continue;
      const std::uint16_t vr = e.vr && e.vr != vrOf('U', 'N') ? e.vr : dictionaryVr(e.tag);
      if (vr != vrOf('S', 'Q')) {
        if (auto value = text(e, vr, scope)) addValue({e.tag, std::move(*value), vr, depth}, out);
        continue;
      }
      const std::vector<DataSet::Scope> items = data_.items(e.tag, scope);
      if (depth == deepest || (depth == 0 && items.empty() && !ofStudy_)) continue;
      out.push_back({e.tag, {}, vr, depth});
      for (const DataSet::Scope& item : items) {
        out.push_back({dicomItem, {}, 0, depth + 1});
        add(item, depth + 1, out);
      }
    }
  }

  // Converts a value to its form in single-frame images.
  void addValue(DicomElement e, DicomElements& out) const {
    constexpr std::uint32_t phaseEncodingDirection = 0x00181312;
    // Image writers add required empty elements themselves.
    if (e.depth == 0 && e.value.empty() && !ofStudy_) return;
    if (e.tag == phaseEncodingDirection && e.value == "COLUMN") e.value = "COL";
    out.push_back(std::move(e));
  }

  // Joins the three attributes into which enhanced MR splits ScanningSequence.
  void addScanningSequence(DicomElements& out) const {
    const auto says = [&](std::uint32_t tag, const char* what) {
      return data_.text(tag, data_.root()) == what;
    };
    constexpr std::uint32_t pulses = 0x00189008, echoPlanar = 0x00189018;
    std::string value;
    const auto addIf = [&](bool does, const char* term) {
      if (does) value += (value.empty() ? "" : "\\") + std::string(term);
    };
    addIf(says(pulses, "SPIN") || says(pulses, "BOTH"), "SE");
    addIf(says(pulses, "GRADIENT") || says(pulses, "BOTH"), "GR");
    addIf(recoversInversion(dicom::FrameScopes(data_, 0)), "IR");
    addIf(says(echoPlanar, "YES"), "EP");
    if (!value.empty()) out.insert(out.begin(), DicomElement{scanningSequenceTag, value, vrOf('C', 'S'), 0});
  }

  void addRenamed(DataSet::Scope scope, DicomElements& out) const {
    for (const RenamedElement& name : renamedElements()) {
      const dicom::Element* e = data_.find(name.from, scope);
      if (!e) continue;
      auto value = text(*e, e->vr ? e->vr : dictionaryVr(e->tag), scope);
      if (!value || value->empty()) continue;
      const std::uint16_t vr = dictionaryVr(name.to);
      const auto number = vr == vrOf('D', 'S') ? dicom::parseNumber(*value) : std::nullopt;
      out.push_back({name.to, number ? decimal(*number) : *value, vr, 0});
    }
  }

  // Adds the factors to SUV and Bq/ml, without which counts of Philips PET have no unit.
  void addPhilipsFactors(DicomElements& out) const {
    constexpr std::uint32_t creator = 0x70530010;
    const std::string name = data_.text(creator, data_.root());
    if (name != "Philips PET Private Group") return;
    out.push_back({creator, name, vrOf('L', 'O'), 0});
    for (const std::uint32_t factor : {0x70531000u, 0x70531009u})
      if (const auto number = data_.number(factor, data_.root()))
        out.push_back({factor, decimal(*number), vrOf('D', 'S'), 0});
  }

  // Adds the gradient direction, which older Siemens, Philips and GE files hold only in private elements.
  void addPrivateDirection(DicomElements& out) const {
    constexpr std::uint32_t direction = 0x00189089;
    if (data_.has(direction, data_.root())) return;
    std::string value;
    for (const double x : dicom::privateDirection(data_))
      value += (value.empty() ? "" : "\\") + dicom::realText(x);
    if (value.empty()) return;
    out.push_back({direction, value, vrOf('F', 'D'), 0});
    for (DicomElement& e : out)
      if (e.tag == 0x00189087 && e.depth == 0)
        e.value = dicom::readBValue(data_, dicom::FrameScopes(data_.root()));
  }

  // Returns an element's value as text; empty if it is binary or too long.
  std::optional<std::string> text(const dicom::Element& e, std::uint16_t vr, DataSet::Scope scope) const {
    if (e.length == dicom::undefinedLength || e.length > longestValue) return {};
    if (isOneOf(vr, {"LO", "LT", "PN", "SH", "ST", "UC", "UT"})) return letters(e.tag, scope);
    if (isOneOf(vr, {"DA", "TM"})) return dicom::dateOrTime(data_.text(e.tag, scope));
    if (isOneOf(vr, {"AE", "AS", "CS", "DT", "IS", "UI", "UR"})) return data_.text(e.tag, scope);
    if (vr == vrOf('D', 'S')) {
      std::string decimals = data_.text(e.tag, scope);
      std::ranges::replace(decimals, ',', '.');
      return decimals;
    }
    if (vr == vrOf('U', 'S')) return numbers<std::uint16_t>(e);
    if (vr == vrOf('S', 'S')) return numbers<std::int16_t>(e);
    if (vr == vrOf('U', 'L')) return numbers<std::uint32_t>(e);
    if (vr == vrOf('S', 'L')) return numbers<std::int32_t>(e);
    if (vr == vrOf('F', 'L')) return numbers<float>(e);
    if (vr == vrOf('F', 'D')) return numbers<double>(e);
    return {};
  }

  std::string letters(std::uint32_t tag, DataSet::Scope scope) const {
    if (!asStored_) return data_.utf8(tag, scope);
    std::string stored = data_.text(tag, scope);
    if (!dicom::characterRemark(stored, data_.text(characterSet, data_.root())).empty())
      isAsDeclared_ = false;
    return stored;
  }

  template <class T>
  std::string numbers(const dicom::Element& e) const {
    std::string text;
    const std::size_t count = std::min<std::size_t>(e.length / sizeof(T), mostNumbers);
    for (std::size_t n = 0; n < count; ++n) {
      char digits[32];
      const T value = dicom::numberAt<T>(bytes_, e.offset + n * sizeof(T), e.bigEndian);
      if (n) text += '\\';
      text.append(digits, std::to_chars(digits, std::end(digits), value).ptr);
    }
    return text;
  }

  const DataSet& data_;
  dicom::Bytes bytes_;
  bool ofStudy_ = false;   // only elements of patient and study, empty ones included
  bool asStored_ = false;  // texts are not converted to UTF-8
  mutable bool isAsDeclared_ = true;
};

DicomSourceFile sourceOf(const dicom::InspectedFile& file) {
  DicomSourceFile source;
  if (file.found.kind != dicom::Inspection::Kind::picture) {
    source.problem = file.found.text.empty() ? "it is no DICOM picture any more." : file.found.text;
    return source;
  }
  const dicom::FileHeader& header = file.found.header;
  const DataSet data(file.scanned.head, file.scanned.dataSet.elements);
  const Copier copier(data, file.scanned.head);
  source.sopClassUid = header.sopClassUid;
  source.sopInstanceUid = header.sopInstanceUid;
  source.isSigned = header.format.isSigned;
  source.frameCount = header.mosaic ? 1 : int(header.format.frames);
  source.elements = copier.ofFile();
  for (const DataSet::Scope& shared : data.items(dicom::FrameScopes::sharedGroups, data.root()))
    std::ranges::move(copier.ofGroups(shared), std::back_inserter(source.elements));
  copier.setStudy(source);
  const auto ofFrames = data.items(dicom::FrameScopes::perFrameGroups, data.root());
  for (std::size_t n = 0; n < header.slices.size(); ++n) {
    const dicom::Slice& slice = header.slices[n];
    source.frames.push_back({{}, slice.slope, slice.intercept, {}});
    if (isPlaced(slice))
      source.frames.back().place = {*slice.position, slice.orientation->row, slice.orientation->column,
                                    *slice.spacing};
    if (n < ofFrames.size()) source.frames.back().elements = copier.ofGroups(ofFrames[n]);
  }
  return source;
}

std::vector<DicomSourceFile> readEach(const std::vector<std::string>& paths) {
  worker::needAll();
  std::vector<DicomSourceFile> all;
  for (const std::string& path : paths) {
    all.push_back(sourceOf(dicom::inspectFile(path)));
    worker::finishStep();
  }
  return all;
}

DicomSourceFile refused(worker::Failure why) {
  DicomSourceFile file;
  file.problem = std::string(worker::reasonOf(why)) + ".";
  return file;
}

}  // namespace

Result<DicomSource> readDicomSource(const Series& series, const Progress& progress,
                                    const CancelToken& cancel) {
  std::map<std::string, std::size_t> index;
  std::vector<std::string> paths;
  for (const std::string& path : series.files)
    if (index.emplace(path, paths.size()).second) paths.push_back(path);
  DicomSource source;
  source.files = worker::forFiles<readEach>(paths, "reading headers", progress, cancel, refused);
  if (cancel.cancelled()) return Error{series.path + ": interrupted."};
  for (std::size_t n = 0; n < series.files.size(); ++n) {
    const DicomSource::Slice slice{index.at(series.files[n]), std::size_t(series.frames[n])};
    const DicomSourceFile& file = source.files[slice.file];
    if (!file.problem.empty()) return Error{series.files[n] + ": " + file.problem};
    if (slice.frame >= std::max(file.frames.size(), std::size_t(file.frameCount)))
      return Error{series.files[n] + ": it has fewer frames than it had."};
    source.slices.push_back(slice);
  }
  return source;
}

}  // namespace volumen
