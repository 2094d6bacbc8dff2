#include "io/export/dicom_slice.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <map>

#include "io/export/dicom_modules.h"
#include "io/export/study_object.h"
#include "viewer/slice/plane.h"

namespace volumen {

namespace {

constexpr std::uint32_t imageTypeTag = 0x00080008, units = 0x00541001, rescaleType = 0x00281054,
                        frameOfReference = 0x00200052, spacingBetweenSlices = 0x00180088,
                        sliceLocation = 0x00201041;

void appendValue(std::string& values, const std::string& value) {
  if (!values.empty()) values += '\\';
  values += value;
}

// Returns the elements of one slice of the source by tag. Elements of its frame replace those of its file.
std::map<std::uint32_t, DicomElements> byTag(const DicomSource& source, int slice) {
  std::map<std::uint32_t, DicomElements> all;
  for (const DicomElements* elements : {&source.file(slice).elements, &source.frame(slice).elements}) {
    std::uint32_t top = 0;
    for (const DicomElement& e : *elements) {
      if (e.depth == 0) top = e.tag, all[top].clear();
      all[top].push_back(e);
    }
  }
  return all;
}

// Removes the elements that differ in another slice. Times and windows stay.
void keepCommon(std::map<std::uint32_t, DicomElements>& all,
                const std::map<std::uint32_t, DicomElements>& others) {
  constexpr std::uint32_t ofTheFirst[] = {0x00080022, 0x00080023, 0x00080032, 0x00080033,
                                          0x00181242, 0x00281050, 0x00281051, 0x00281055,
                                          0x00281056, 0x00541300, 0x00541321};
  std::erase_if(all, [&](const auto& one) {
    const auto other = others.find(one.first);
    const bool alike = other != others.end() && other->second == one.second;
    return !alike && std::ranges::find(ofTheFirst, one.first) == std::end(ofTheFirst);
  });
}

DicomElements flat(const std::map<std::uint32_t, DicomElements>& byTags) {
  DicomElements all;
  for (const auto& [tag, elements] : byTags) append(all, elements);
  return all;
}

// Returns the slice that was acquired first, because SUV may be computed for its time.
int firstInTime(const DicomSource& source) {
  const auto time = [&](int n) {
    const DicomElements& elements = source.file(n).elements;
    return std::pair(valueOf(elements, 0x00080022), valueOf(elements, 0x00080032));
  };
  int first = 0;
  for (int n = 1; n < int(source.slices.size()); ++n)
    if (time(n) < time(first)) first = n;
  return first;
}

DicomElements windows(const Volume& volume, const DicomSeriesTags& tags) {
  std::string centres, widths, names;
  for (const Window& w : volume.attributes().windows) {
    appendValue(centres, decimal(w.centre));
    appendValue(widths, decimal(w.width));
  }
  if (centres.empty()) return {};
  DicomElements all = {{0x00281050, centres}, {0x00281051, widths}};
  for (const std::string& name : tags.windowNames) appendValue(names, name);
  if (tags.windowNames.size() == volume.attributes().windows.size()) all.push_back({0x00281055, names});
  return all;
}

// Returns required image attributes that the source may lack (PS3.3 A.3, A.4, A.8, A.21).
DicomElements modalityDefaults(const std::string& sopClass, const DicomSeriesTags& tags,
                               const std::string& scanningSequence) {
  if (sopClass == UID_CTImageStorage) return {{0x00180060, tags.kvp}};
  if (sopClass == UID_MRImageStorage) {
    DicomElements all = {{0x00180020, "RM"}, {0x00180021, "NONE"}, {0x00180022, ""}, {0x00180023, ""},
                         {0x00180080, ""},   {0x00180081, ""},     {0x00180091, ""}};
    if (scanningSequence.find("IR") != std::string::npos) all.push_back({0x00180082, ""});
    return all;
  }
  if (sopClass == UID_PositronEmissionTomographyImageStorage)
    return {{0x00080022, ""}, {0x00080032, ""}, {0x00181181, ""}, {0x00181242, ""},
            {0x00280051, ""}, {0x00540016, {}}, {0x00540414, {}}};
  return {{0x00080064, "WSD"}, {0x00200020, ""}};
}

// Returns the padding in stored values. The result is empty if the volume has none or stored values cannot
// hold it.
DicomElements padding(const Volume& volume, const StoredSlice& pixels) {
  const auto& range = volume.attributes().padding;
  if (!range) return {};
  const auto vr = std::uint16_t(pixels.isSigned ? 'S' << 8 | 'S' : 'U' << 8 | 'S');
  if (pixels.padding) return {{0x00280120, std::to_string(*pixels.padding), vr}};
  if (std::holds_alternative<std::vector<float>>(volume.stored())) return {};
  const auto stored = [&](double value) {
    return long(std::lround((value - volume.intercept()) / volume.slope()));
  };
  const auto [low, high] = std::minmax({stored(range->low), stored(range->high)});
  const bool fits = pixels.isSigned ? low >= -32768 && high <= 32767 : low >= 0 && high <= 65535;
  if (!fits) return {};
  DicomElements all = {{0x00280120, std::to_string(low), vr}};
  if (high != low) all.push_back({0x00280121, std::to_string(high), vr});
  return all;
}

// The file is one volume of a DYNAMIC or GATED series, so their counts are 1.
DicomElements petCounts(int k, int slices, const std::string& seriesType) {
  DicomElements all = {{0x00540081, std::to_string(slices)}, {0x00541330, std::to_string(k + 1)}};
  if (seriesType.starts_with("DYNAMIC")) all.push_back({0x00540101, "1"});
  if (seriesType.starts_with("GATED"))
    for (const std::uint32_t count : {0x00540061u, 0x00540071u}) all.push_back({count, "1"});
  return all;
}

const char* sopClassOf(const std::string& modality, bool isPet) {
  if (modality == "CT") return UID_CTImageStorage;
  if (modality == "MR") return UID_MRImageStorage;
  return isPet ? UID_PositronEmissionTomographyImageStorage : UID_SecondaryCaptureImageStorage;
}

}  // namespace

std::string commonFrameOfReference(const DicomSource& source) {
  std::string uid;
  for (std::size_t n = 0; n < source.slices.size(); ++n) {
    std::string own = valueOf(source.file(int(n)).elements, frameOfReference);
    if (n > 0 && own != uid) return {};
    uid = std::move(own);
  }
  return uid;
}

DicomElements placeElements(const VoxelGeometry& g, int k) {
  const glm::dvec3 spacing = g.spacing(), p = g.patientFromVoxel({0, 0, k});
  const glm::dvec3 row = g.patientFromVoxelStep[0] / spacing.x,
                   column = g.patientFromVoxelStep[1] / spacing.y;
  return {{0x00200032, decimals({p.x, p.y, p.z})},
          {0x00200037, decimals({row.x, row.y, row.z, column.x, column.y, column.z})},
          {sliceLocation, decimal(glm::dot(p, glm::normalize(glm::cross(row, column))))},
          {0x00280030, decimals({spacing.y, spacing.x})},
          {spacingBetweenSlices, decimal(sliceDistance(g))}};
}

DicomSliceWriter::DicomSliceWriter(const Volume& volume, const DicomSeriesTags& tags)
    : volume_(volume),
      tags_(tags),
      uids_(volume, tags.patientId + tags.description + tags.seriesUid + tags.bValue +
                        (tags.resampling || !tags.takenAway.empty() ? randomUid() : "")) {
  if (!tags.source.slices.empty()) first_ = tags.source.file(0).elements;
  isPet_ = volume.attributes().modality == "PT" && !valueOf(first_, units).empty();
  identity_ = identityElements();
  series_ = seriesElements();
  if (!tags.resampling) return;
  ofAll_ = commonOfAll();
  if (isPet_ || !std::holds_alternative<std::vector<float>>(volume.stored())) return;
  std::optional<StoredAs> source;
  if (!tags.source.slices.empty())
    source = {tags.source.frame(0).slope, tags.source.frame(0).intercept, tags.source.file(0).isSigned};
  storedAsOne_ = volumen::storedAsOne(volume, source);
}

std::string DicomSliceWriter::withoutClass() const {
  const std::string& modality = volume_.attributes().modality;
  const bool isCapture = modality.empty() || modality == "OT" || modality == "CT" || modality == "MR";
  return isCapture || isPet_ ? std::string() : modality;
}

// Returns the source slices that slice `k` is made of.
std::vector<int> DicomSliceWriter::sourcesOf(int k) const {
  if (tags_.source.slices.empty()) return {};
  if (tags_.resampling) return tags_.resampling->sources[std::size_t(k)];
  const SliceOrigin& origin = tags_.origins[std::size_t(k)];
  return origin.isInterpolated() ? std::vector{origin.below, origin.above} : std::vector{origin.below};
}

// Returns how slice `k` is stored in its source; empty if it has no source or several.
std::optional<StoredAs> DicomSliceWriter::storedAs(int k) const {
  const std::vector<int> sources = sourcesOf(k);
  if (sources.size() != 1) return {};
  const DicomSourceFrame& frame = tags_.source.frame(sources[0]);
  return StoredAs{frame.slope, frame.intercept, tags_.source.file(sources[0]).isSigned};
}

// Each PET slice has its own rescale. Its values may be rounded.
std::optional<StoredSlice> DicomSliceWriter::pixels(int k) const {
  if (storedAsOne_) return roundedSlice(volume_, k, *storedAsOne_);
  return storedSlice(volume_, k, storedAs(k), isPet_);
}

// Identity and frame of reference are the same for all slices, even if single source files differ from the
// others.
DicomElements DicomSliceWriter::identityElements() const {
  DicomElements all = patientModule(tags_);
  append(all, studyModule(tags_, tags_.studyUid.empty() ? uids_.of("study") : tags_.studyUid));
  const bool isMoved = tags_.resampling && !tags_.resampling->frameOfReferenceUid.empty();
  const std::string space =
      isMoved ? tags_.resampling->frameOfReferenceUid : commonFrameOfReference(tags_.source);
  append(all, frameOfReferenceModule(space.empty() ? uids_.of("frame of reference") : space));
  return all;
}

// Returns the elements that all slices share. Elements of the source take precedence.
DicomElements DicomSliceWriter::seriesElements() const {
  const std::string modality = volume_.attributes().modality;
  const char* sopClass = sopClassOf(modality, isPet_);
  DicomElements all = {
      {0x0008103e, tags_.description},
      {0x00200011, tags_.seriesNumber.empty() ? "1" : tags_.seriesNumber},
      {0x00200012, ""},
      {0x00185100, tags_.patientPosition},
      {0x00180050, tags_.synthetic ? decimal(sliceDistance(volume_.geometry())) : std::string()}};
  const bool hasLaterality = !valueOf(first_, 0x00200062).empty();  // of the image
  if (mayBePaired(tags_.bodyPart) && !hasLaterality) all.push_back({0x00200060, ""});
  append(all, first_.empty() ? equipmentModule() : DicomElements{{0x00080070, ""}});
  append(all, modalityDefaults(sopClass, tags_, valueOf(first_, 0x00180020)));
  append(all, windows(volume_, tags_));
  if (!tags_.bodyPart.empty()) all.push_back({0x00180015, tags_.bodyPart});
  if (modality == "MR" && !tags_.bValue.empty()) all.push_back({0x00189087, tags_.bValue});
  if (tags_.synthetic)
    append(all, {{0x00120062, "YES"},
                 {0x00120063, "Synthetic: computed, of no patient"},
                 {0x00081090, "Synthetic phantom"},
                 {0x00204000, "Synthetic data, computed. Not a patient. Not for clinical use."}});
  return all;
}

DicomElements DicomSliceWriter::sourceElements(int k) const {
  const std::vector<int> sources = sourcesOf(k);
  if (tags_.resampling || sources.empty()) return ofAll_;
  auto elements = byTag(tags_.source, sources.front());
  if (sources.size() > 1) keepCommon(elements, byTag(tags_.source, sources.back()));
  return withoutIdentity(flat(elements));
}

DicomElements DicomSliceWriter::withoutIdentity(DicomElements all) const {
  std::erase_if(all, [this](const DicomElement& e) {
    return e.depth == 0 && (e.tag == rescaleType || !valueOf(identity_, e.tag).empty());
  });
  return all;
}

// Returns the elements that are equal in all source slices and hold on any plane.
DicomElements DicomSliceWriter::commonOfAll() const {
  constexpr std::uint32_t ofTheirSpace = 0x00201040;      // PositionReferenceIndicator
  constexpr std::uint32_t ofTheirPlane[] = {0x0008103f,   // SeriesDescriptionCodeSequence
                                            0x00181100,   // ReconstructionDiameter
                                            0x00181120,   // GantryDetectorTilt
                                            0x00181310,   // AcquisitionMatrix
                                            0x00181312};  // InPlanePhaseEncodingDirection
  if (tags_.source.slices.empty()) return {};
  auto all = byTag(tags_.source, firstInTime(tags_.source));
  for (int n = 0; n < int(tags_.source.slices.size()); ++n) keepCommon(all, byTag(tags_.source, n));
  for (const std::uint32_t tag : ofTheirPlane) all.erase(tag);
  if (!tags_.resampling->frameOfReferenceUid.empty()) all.erase(ofTheirSpace);
  if (!tags_.resampling->places.empty()) all.erase(spacingBetweenSlices);
  return withoutIdentity(flat(all));
}

// Returns DERIVED\SECONDARY, followed by the source's values from the third on.
std::string DicomSliceWriter::imageType(const std::string& ofSource) const {
  const std::string& modality = volume_.attributes().modality;
  // PS3.3 C.8.9.4.1.1 has no SECONDARY for PET.
  std::string type = isPet_ ? "DERIVED\\PRIMARY" : "DERIVED\\SECONDARY";
  std::vector<std::string> more;
  std::size_t at = 0;
  for (int n = 0; at != std::string::npos; ++n) {
    const std::size_t begin = n ? at + 1 : 0;
    at = ofSource.find('\\', begin);
    if (n >= 2) more.push_back(ofSource.substr(begin, at == std::string::npos ? at : at - begin));
  }
  std::erase(more, "MOSAIC");
  if (modality == "CT" && (more.empty() || (more[0] != "AXIAL" && more[0] != "LOCALIZER")))
    more.insert(more.begin(), "AXIAL");
  if (modality == "MR" && more.empty()) more.emplace_back("OTHER");
  if (tags_.resampling) more.push_back(tags_.resampling->imageType);
  for (const std::string& value : more) appendValue(type, value);
  return type;
}

// Returns the position of slice `k`. Slices across a curve are located by their distance along it, as they
// have none along a common normal.
DicomElements DicomSliceWriter::placeOf(int k) const {
  if (!tags_.resampling || tags_.resampling->places.empty()) return placeElements(volume_.geometry(), k);
  DicomElements all = placeElements(tags_.resampling->places[std::size_t(k)], 0);
  std::erase_if(
      all, [](const DicomElement& e) { return e.tag == spacingBetweenSlices || e.tag == sliceLocation; });
  all.push_back({sliceLocation, decimal(k * sliceDistance(volume_.geometry()))});
  return all;
}

DicomElements DicomSliceWriter::derivationOf(int k, const StoredSlice& pixels) const {
  const std::vector<int> sources = sourcesOf(k);
  if (sources.empty() && !tags_.resampling && tags_.takenAway.empty()) return {};
  std::string words = sources.size() > 1 ? "Interpolated between the source images"
                                         : "Values and place as in the source image";
  if (tags_.resampling) words = tags_.resampling->words;
  if (!tags_.takenAway.empty()) words += ", with air in place of " + tags_.takenAway;
  char off[96] = "";
  if (pixels.largestError > 0)
    std::snprintf(off, sizeof off, ", rounded to 16 bits (at most %.3g off)", pixels.largestError);
  words += off;
  words += "; written by volumen " VOLUMEN_VERSION;
  DicomElements all = derivation(words, picturesOf(tags_.source, sources));
  if (tags_.resampling) append(all, codeSequence(0x00089215, tags_.resampling->code, 0));
  return all;
}

// Returns the elements that replace those of the source.
DicomElements DicomSliceWriter::derivedElements(int k, const StoredSlice& pixels,
                                                std::span<const DicomElement> source) const {
  const std::string& modality = volume_.attributes().modality;
  DicomElements all = {{0x00080005, "ISO_IR 192"},
                       {0x00080016, sopClassOf(modality, isPet_)},
                       {0x00080018, uids_.of(std::to_string(k + 1))},
                       {0x00080060, modality.empty() ? "OT" : modality},
                       {imageTypeTag, imageType(valueOf(source, imageTypeTag))},
                       {0x0020000e, uids_.of("series")},
                       {0x00200013, std::to_string(k + 1)},
                       {0x00280004, "MONOCHROME2"}};
  if (!source.empty()) append(all, contributingEquipment(source));
  append(all, placeOf(k));
  append(all, derivationOf(k, pixels));
  append(all, padding(volume_, pixels));
  if (tags_.resampling || !tags_.takenAway.empty())
    append(all, {{0x0008103e, tags_.description}, {0x00200011, tags_.seriesNumber}});
  if (tags_.resampling) all.push_back({0x00180050, decimal(tags_.resampling->thicknessMm)});
  if (tags_.isDefaced) all.push_back({0x00280302, "NO"});
  if (isPet_) append(all, petCounts(k, volume_.size().z, valueOf(source, 0x00541000)));
  // MR Image Storage has no rescale. It is still written if it changes values.
  if (modality == "MR" && pixels.slope == 1 && pixels.intercept == 0) return all;
  append(all, {{0x00281053, decimal(pixels.slope)}, {0x00281052, decimal(pixels.intercept)}});
  if (isPet_) return all;
  const std::string type = valueOf(first_, rescaleType);
  all.push_back({rescaleType, !type.empty() ? type : modality == "CT" && !tags_.hasNoUnit ? "HU" : "US"});
  return all;
}

void DicomSliceWriter::put(int k, const StoredSlice& pixels, DcmItem& into) const {
  const DicomElements source = sourceElements(k);
  volumen::put(identity_, into);
  volumen::put(series_, into);
  volumen::put(source, into);
  volumen::put(derivedElements(k, pixels, source), into);
}

}  // namespace volumen
