#include "io/export/segmentation_elements.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "io/dicom/cielab.h"
#include "io/export/dicom_modules.h"
#include "io/segmentation.h"
#include "viewer/segment/tissue_codes.h"

namespace volumen {

namespace {

constexpr std::uint32_t frameOfReferenceTag = 0x00200052, dimensionOrganisation = 0x00209164;

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// PS3.3 10.16 and 10.5: structures and algorithms leave as they came.
DicomElements structuresOf(const Segment& segment) {
  DicomElements all;
  for (const AnatomicStructure& structure : segment.structures) {
    if (!isWhole(structure.code)) continue;
    const DicomElements one = codeSequence(0x00082228, structure.code, 1);
    all.insert(all.end(), all.empty() ? one.begin() : one.begin() + 1, one.end());
    if (isWhole(structure.modifier)) append(all, codeSequence(0x00082230, structure.modifier, 2));
  }
  return all;
}

DicomElements algorithmsOf(const Segment& segment) {
  DicomElements all;
  for (const AlgorithmIdentity& algorithm : segment.algorithms) {
    if (all.empty()) all.push_back({0x00620007, {}, 0, 1});
    all.push_back({dicomItem, {}, 0, 2});
    if (isWhole(algorithm.family)) append(all, codeSequence(0x0066002f, algorithm.family, 2));
    if (isWhole(algorithm.nameCode)) append(all, codeSequence(0x00660030, algorithm.nameCode, 2));
    append(all, {{0x00660036, inOneLine(algorithm.name), 0, 2},
                 {0x00660031, inOneLine(algorithm.version), 0, 2},
                 {0x00660032, algorithm.parameters, 0, 2},
                 {0x00240202, inOneLine(algorithm.source), 0, 2}});
  }
  return all;
}

std::string nameOf(const Segment& segment, std::size_t n) {
  const std::string line = inOneLine(segment.label);
  const bool isBlank = line.find_first_not_of(' ') == std::string::npos;
  return isBlank ? "Segment " + std::to_string(n + 1) : line;
}

// Returns "from 150 to 3000", or "from 150" for an open range.
std::string rangeText(const ValueRange& range) {
  std::string text = std::isfinite(range.low) ? "from " + decimal(range.low) : "";
  if (std::isfinite(range.high)) text += (text.empty() ? "" : " ") + ("to " + decimal(range.high));
  return text;
}

// PS3.3 C.8.20.4: a segment that is not drawn by hand must name its algorithm.
std::string algorithmOf(const Segment& segment) {
  if (!segment.algorithm.empty()) return inOneLine(segment.algorithm);
  if (segment.range) return inOneLine("Values " + rangeText(*segment.range));
  return segment.algorithmType > SegmentAlgorithm::manual ? "Unknown" : "";
}

// An unsaid type is semiautomatic if an algorithm is named, else manual.
std::string algorithmTypeOf(const Segment& segment) {
  const bool isMade = segment.algorithmType == SegmentAlgorithm::unsaid && !algorithmOf(segment).empty();
  const SegmentAlgorithm type =
      isMade ? SegmentAlgorithm::semiautomatic : std::max(segment.algorithmType, SegmentAlgorithm::manual);
  return std::string(segmentAlgorithmTerms[std::size_t(type)]);
}

bool isUid(const std::string& text) {
  constexpr std::size_t longest = 64;
  return !text.empty() && text.size() <= longest &&
         text.find_first_not_of("0123456789.") == std::string::npos;
}

std::string colourWords(const Segment& segment, const TissueCode* tissue) {
  const glm::u8vec3 colour = segment.colour.value_or(tissue ? tissue->colour : glm::u8vec3(255));
  const auto lab = dicom::cieLabOf(colour);
  return std::to_string(lab[0]) + '\\' + std::to_string(lab[1]) + '\\' + std::to_string(lab[2]);
}

std::set<std::string> framesOfReference(const DicomSource& source) {
  std::set<std::string> uids;
  for (const DicomSourceFile& file : source.files) uids.insert(valueOf(file.elements, frameOfReferenceTag));
  return uids;
}

std::string saltOf(const SeriesIdentity& series, std::span<const Segment> segments,
                   const SegmentationTags& tags) {
  std::string salt = series.patientId + series.seriesUid + tags.description + tags.date + tags.time;
  for (const Segment& s : segments) {
    for (const AnatomicStructure& structure : s.structures)
      salt += structure.code.value + structure.modifier.value;
    for (const AlgorithmIdentity& a : s.algorithms)
      salt += a.family.value + a.name + a.version + a.parameters;
    salt += s.label + s.type.value + s.region.value + algorithmTypeOf(s) + s.algorithm + s.trackingId +
            s.trackingUid;
  }
  return salt;
}

}  // namespace

SegmentationElements::SegmentationElements(const SeriesIdentity& series, const DicomSource& source,
                                           const SegmentationFrames& frames,
                                           std::span<const Segment> segments, const SegmentationTags& tags,
                                           double sliceDistance)
    : series_(series),
      source_(source),
      frames_(frames),
      segments_(segments),
      tags_(tags),
      sliceDistance_(sliceDistance),
      uids_(frames.bits().bytes(), saltOf(series, segments, tags)) {
  for (const auto& frame : frames.frames()) used_.push_back(frame.slice);
  std::ranges::sort(used_);
  used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
}

DicomElements SegmentationElements::identity() const {
  const DicomElements& first = source_.file(0).elements;
  const std::string space = valueOf(first, frameOfReferenceTag);
  DicomElements all = patientModule(series_);
  append(all, studyModule(series_, series_.studyUid.empty() ? uids_.of("study") : series_.studyUid));
  append(all, studyElements(first));
  append(all, frameOfReferenceModule(space.empty() ? uids_.of("frame of reference") : space));
  append(all, enhancedEquipmentModule());
  append(all, {{0x00080005, "ISO_IR 192"},
               {0x00080016, UID_SegmentationStorage},
               {0x00080018, uids_.of("instance")},
               {0x00080021, tags_.date},
               {0x00080031, tags_.time},
               {0x00080060, "SEG"},
               {0x0008103e, inOneLine(tags_.description)},
               {0x0020000e, uids_.of("series")},
               {0x00200011, "1000"},  // a number above those of scanners
               {0x00201040, valueOf(first, 0x00201040)}});
  return all;
}

DicomElements SegmentationElements::sourceReferences() const {
  DicomElements all = {{0x00081115, {}}, {dicomItem, {}, 0, 1}, {0x0008114a, {}, 0, 1}};
  for (const DicomSourceFile& file : source_.files)
    append(all, {{dicomItem, {}, 0, 2},
                 {0x00081150, file.sopClassUid, 0, 2},
                 {0x00081155, file.sopInstanceUid, 0, 2}});
  all.push_back({0x0020000e, series_.seriesUid, 0, 1});
  return all;
}

DicomElements SegmentationElements::image() const {
  const DicomElements& first = source_.file(0).elements;
  DicomElements all = {{0x00080008, "DERIVED\\PRIMARY"},
                       {0x00080023, tags_.date},
                       {0x00080033, tags_.time},
                       {0x00200013, "1"},
                       {0x00700080, "SEGMENTATION"},
                       {0x00700081, inOneLine(tags_.description)},
                       {0x00700084, tags_.creator},
                       {0x00280002, "1"},
                       {0x00280004, "MONOCHROME2"},
                       {0x00280008, std::to_string(frames_.frames().size())},
                       {0x00280010, std::to_string(frames_.size().y)},
                       {0x00280011, std::to_string(frames_.size().x)},
                       {0x00280100, "1"},
                       {0x00280101, "1"},
                       {0x00280102, "0"},
                       {0x00280103, "0"},
                       {0x00620001, "BINARY"},
                       {0x00620013, frames_.overlap() ? "YES" : "NO"},
                       {0x00282110, "00"}};
  for (const std::uint32_t lossy : {0x00282110u, 0x00282112u, 0x00282114u})
    if (const std::string value = valueOf(first, lossy); !value.empty()) all.push_back({lossy, value});
  all.push_back({0x00620002, {}});
  for (std::size_t n = 0; n < segments_.size(); ++n) append(all, segmentItem(n));
  return all;
}

// PS3.3 C.8.20.2: tracking ID and UID are present together or not at all.
DicomElements SegmentationElements::trackingOf(const Segment& segment, const std::string& name) const {
  const bool hasUid = isUid(segment.trackingUid);
  if (segment.trackingId.empty() && !hasUid) return {};
  return {{0x00620020, segment.trackingId.empty() ? name : inOneLine(segment.trackingId), 0, 1},
          {0x00620021, hasUid ? segment.trackingUid : uids_.of("segment " + segment.trackingId), 0, 1}};
}

DicomElements SegmentationElements::segmentItem(std::size_t n) const {
  const Segment& segment = segments_[n];
  const TissueCode* tissue = tissueOf(segment.type);
  const bool coded = isWhole(segment.type);
  const Code& category = isWhole(segment.category) ? segment.category
                         : tissue                  ? tissue->category
                                                   : anyTissue().category;
  const std::string algorithm = algorithmOf(segment);
  DicomElements all = {{dicomItem, {}, 0, 1},
                       {0x00620004, std::to_string(n + 1), 0, 1},
                       {0x00620005, nameOf(segment, n), 0, 1},
                       {0x00620008, algorithmTypeOf(segment), 0, 1},
                       {0x0062000d, colourWords(segment, tissue), 0, 1}};
  if (!segment.description.empty()) all.push_back({0x00620006, inOneLine(segment.description), 0, 1});
  if (!algorithm.empty()) all.push_back({0x00620009, algorithm, 0, 1});
  append(all, trackingOf(segment, nameOf(segment, n)));
  if (isWhole(segment.region)) append(all, codeSequence(0x00082218, segment.region, 1));
  if (isWhole(segment.region) && isWhole(segment.regionModifier))
    append(all, codeSequence(0x00082220, segment.regionModifier, 2));
  append(all, structuresOf(segment));
  append(all, algorithmsOf(segment));
  append(all, codeSequence(0x00620003, category, 1));
  append(all, codeSequence(0x0062000f, coded ? segment.type : anyTissue().type, 1));
  if (coded && isWhole(segment.modifier)) append(all, codeSequence(0x00620011, segment.modifier, 2));
  return all;
}

DicomElements SegmentationElements::dimensions() const {
  const std::string uid = uids_.of("dimensions");
  DicomElements all = {
      {0x00209221, {}}, {dicomItem, {}, 0, 1}, {dimensionOrganisation, uid, 0, 1}, {0x00209222, {}}};
  const auto add = [&](const char* pointer, const char* group, const char* label) {
    append(all, {{dicomItem, {}, 0, 1},
                 {dimensionOrganisation, uid, 0, 1},
                 {0x00209165, pointer, 0, 1},
                 {0x00209167, group, 0, 1},
                 {0x00209421, label, 0, 1}});
  };
  add("(0062,000b)", "(0062,000a)", "Segment");
  add("(0020,0032)", "(0020,9113)", "Position");
  return all;
}

DicomElements SegmentationElements::sharedGroups() const {
  const DicomSourceFrame::Place& p = place(0);
  return {{0x52009229, {}},
          {dicomItem, {}, 0, 1},
          {0x00209116, {}, 0, 1},
          {dicomItem, {}, 0, 2},
          {0x00200037, decimals({p.right.x, p.right.y, p.right.z, p.down.x, p.down.y, p.down.z}), 0, 2},
          {0x00289110, {}, 0, 1},
          {dicomItem, {}, 0, 2},
          {0x00180050, decimal(sliceDistance_), 0, 2},
          {0x00180088, decimal(sliceDistance_), 0, 2},
          {0x00280030, decimals({p.mm.y, p.mm.x}), 0, 2}};
}

DicomElements SegmentationElements::frameGroups(const SegmentationFrames::Frame& frame) const {
  const glm::dvec3 at = place(frame.slice).position;
  const DicomSourceFile& file = source_.file(frame.slice);
  const auto position = std::ranges::lower_bound(used_, frame.slice) - used_.begin() + 1;
  const std::string number = std::to_string(frame.segment + 1);
  DicomElements all = {{dicomItem, {}, 0, 1},
                       {0x00089124, {}, 0, 1},
                       {dicomItem, {}, 0, 2},
                       {0x00082112, {}, 0, 2},
                       {dicomItem, {}, 0, 3},
                       {0x00081150, file.sopClassUid, 0, 3},
                       {0x00081155, file.sopInstanceUid, 0, 3},
                       {0x0028135a, "YES", 0, 3}};
  if (file.isMultiFrame())
    all.push_back({0x00081160, std::to_string(source_.slices[std::size_t(frame.slice)].frame + 1), 0, 3});
  all.push_back({0x0040a170, {}, 0, 3});
  append(all, codeItem("121322", "DCM", "Source image for image processing operation", 4));
  all.push_back({0x00089215, {}, 0, 2});
  append(all, codeItem("113076", "DCM", "Segmentation", 3));
  append(all, {{0x00209111, {}, 0, 1},
               {dicomItem, {}, 0, 2},
               {0x00209157, number + '\\' + std::to_string(position), 0, 2},
               {0x00209113, {}, 0, 1},
               {dicomItem, {}, 0, 2},
               {0x00200032, decimals({at.x, at.y, at.z}), 0, 2},
               {0x0062000a, {}, 0, 1},
               {dicomItem, {}, 0, 2},
               {0x0062000b, number, 0, 2}});
  return all;
}

std::vector<DicomElements> SegmentationElements::all() const {
  std::vector<DicomElements> all = {identity(), sourceReferences(), image(), dimensions(), sharedGroups()};
  DicomElements frames = {{0x52009230, {}}};
  for (const auto& frame : frames_.frames()) append(frames, frameGroups(frame));
  all.push_back(std::move(frames));
  return all;
}

std::vector<std::string> SegmentationElements::notes() const {
  std::vector<std::string> notes, withoutCode, shortened;
  for (std::size_t n = 0; n < segments_.size(); ++n) {
    const std::string name = nameOf(segments_[n], n);
    if (!isWhole(segments_[n].type)) withoutCode.push_back(name);
    if (!segments_[n].label.empty() && name != segments_[n].label) shortened.push_back(name);
  }
  const bool areOfGrid = !frames_.areOfSlices();
  if (areOfGrid && !frames_.areOnGrid())
    notes.emplace_back(
        "The segments lie on another grid than the slices as acquired: each pixel of these has what its "
        "nearest voxel has.");
  else if (const int left = areOfGrid ? frames_.slicesLeftOut() : 0; left > 0)
    notes.push_back("Slices of the segments that are interpolated and no picture of the series: " +
                    std::to_string(left) + "; they were left out.");
  if (const auto spaces = framesOfReference(source_).size(); spaces > 1)
    notes.push_back("The slices of the series are of " + std::to_string(spaces) +
                    " frames of reference; that of the first was written.");
  if (!withoutCode.empty())
    notes.push_back("Written as Tissue, for there is no code of them: " + listed(withoutCode) + ".");
  if (!shortened.empty())
    notes.push_back("Names in DICOM have one line of at most 64 characters: " + listed(shortened) + ".");
  return notes;
}

}  // namespace volumen
