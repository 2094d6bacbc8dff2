#include "io/export/dicom_modules.h"

#include <algorithm>

namespace volumen {

namespace {

void addIfKnown(DicomElements& all, std::uint32_t tag, const std::string& value) {
  if (!value.empty()) all.push_back({tag, value});
}

}  // namespace

DicomElements patientModule(const SeriesIdentity& who) {
  DicomElements all = {{0x00100010, who.patientName},
                       {0x00100020, who.patientId},
                       {0x00100030, who.patientBirthDate},
                       {0x00100040, who.patientSex}};
  addIfKnown(all, 0x00100021, who.patientIdIssuer);
  return all;
}

DicomElements studyModule(const SeriesIdentity& who, const std::string& studyUid) {
  DicomElements all = {{0x0020000d, studyUid},
                       {0x00080020, who.studyDate},
                       {0x00080030, who.studyTime},
                       {0x00080050, who.accessionNumber},
                       {0x00080090, ""},
                       {0x00200010, who.studyId}};
  addIfKnown(all, 0x00081030, who.studyDescription);
  addIfKnown(all, 0x00101010, who.patientAge);
  return all;
}

DicomElements equipmentModule() {
  return {{0x00080070, "volumen"}, {0x00181020, "volumen " VOLUMEN_VERSION}};
}

DicomElements enhancedEquipmentModule() {
  DicomElements all = equipmentModule();
  append(all, {{0x00081090, "volumen"}, {0x00181000, "none"}});
  return all;
}

bool isOfStudy(std::uint32_t tag) {
  constexpr std::uint32_t ranges[][2] = {
      {0x00080020, 0x00080020}, {0x00080030, 0x00080030}, {0x00080050, 0x00080051}, {0x00080090, 0x00080096},
      {0x00081030, 0x00081032}, {0x00081048, 0x00081049}, {0x00081060, 0x00081062}, {0x00081080, 0x00081084},
      {0x00081110, 0x00081110}, {0x00081120, 0x00081120}, {0x00100010, 0x0010ffff}, {0x00120010, 0x0012ffff},
      {0x0020000d, 0x0020000d}, {0x00200010, 0x00200010}};
  return std::ranges::any_of(ranges, [&](const auto& r) { return tag >= r[0] && tag <= r[1]; });
}

DicomElements studyElements(const DicomElements& ofFile) {
  DicomElements kept;
  bool inside = false;
  for (const DicomElement& e : ofFile) {
    if (e.depth == 0) inside = isOfStudy(e.tag);
    if (inside) kept.push_back(e);
  }
  return kept;
}

bool mayBePaired(const std::string& bodyPart) {
  static const char* const paired[] = {"",    "ANKLE", "ARM",  "BREAST", "EAR",    "ELBOW", "EXTREMITY",
                                       "EYE", "FOOT",  "HAND", "HIP",    "KIDNEY", "KNEE",  "SHOULDER",
                                       "LEG", "THIGH", "LUNG", "FEMUR",  "TIBIA",  "WRIST"};
  return std::ranges::find(paired, bodyPart) != std::end(paired);
}

DicomElements bodyPart(const SeriesIdentity& who) {
  DicomElements all;
  addIfKnown(all, 0x00180015, who.bodyPart);
  if (mayBePaired(who.bodyPart)) all.push_back({0x00200060, who.laterality});
  return all;
}

DicomElements contributingEquipment(std::span<const DicomElement> before) {
  constexpr std::uint32_t contributors = 0x0018a001;
  DicomElements all = {{contributors, {}}};
  bool inside = false;
  for (const DicomElement& e : before) {
    if (e.depth == 0) inside = e.tag == contributors;
    if (inside && e.depth > 0) all.push_back(e);
  }
  all.push_back({dicomItem, {}, 0, 1});
  all.push_back({0x00080070, "volumen", 0, 1});
  all.push_back({0x00181020, "volumen " VOLUMEN_VERSION, 0, 1});
  all.push_back({0x0040a170, {}, 0, 1});
  append(all, codeItem("109103", "DCM", "Modifying Equipment", 2));
  return all;
}

DicomElements frameOfReferenceModule(const std::string& uid) { return {{0x00200052, uid}, {0x00201040, ""}}; }

DicomElements derivation(const std::string& words, std::span<const SourcePicture> sources) {
  DicomElements all = {{0x00082111, words}};
  if (!sources.empty()) all.push_back({0x00082112, {}});
  for (const SourcePicture& picture : sources) {
    all.push_back({dicomItem, {}, 0, 1});
    all.push_back({0x00081150, picture.sopClassUid, 0, 1});
    all.push_back({0x00081155, picture.sopInstanceUid, 0, 1});
    if (picture.frame > 0) all.push_back({0x00081160, std::to_string(picture.frame), 0, 1});
    all.push_back({0x0040a170, {}, 0, 1});
    append(all, codeItem("121322", "DCM", "Source image for image processing operation", 2));
  }
  return all;
}

DicomElements codeItem(const std::string& value, const std::string& scheme, const std::string& meaning,
                       int depth) {
  return {{dicomItem, {}, 0, depth},
          {0x00080100, value, 0, depth},
          {0x00080102, scheme, 0, depth},
          {0x00080104, meaning, 0, depth}};
}

bool isWhole(const Code& code) { return !code.value.empty() && !code.scheme.empty(); }

DicomElements codeSequence(std::uint32_t tag, const Code& code, int depth) {
  constexpr std::size_t longestShort = 16;  // characters of SH
  const bool isUrn = code.value.starts_with("urn:") || code.value.find("://") != std::string::npos;
  const std::string value = inOneLine(code.value);
  DicomElements all = {{tag, {}, 0, depth}};
  append(all, codeItem(value, inOneLine(code.scheme), inOneLine(code.meaning.empty() ? value : code.meaning),
                       depth + 1));
  if (isUrn)
    all[2].tag = 0x00080120;
  else if (value.size() > longestShort)
    all[2].tag = 0x00080119;
  return all;
}

}  // namespace volumen
