#include "io/deidentify/statement.h"

#include <algorithm>
#include <iterator>

namespace volumen {

namespace {

std::vector<MethodCode> methodCodes(const Rewriting& how) {
  const Retained& retained = how.retained;
  std::vector<MethodCode> codes{{"113100", "Basic Application Confidentiality Profile"}};
  const std::pair<bool, MethodCode> options[] = {
      {how.isFaceless, {"113102", "Clean Recognizable Visual Features Option"}},
      {true, {"113104", "Clean Structured Content Option"}},
      {retained.descriptors, {"113105", "Clean Descriptors Option"}},
      {retained.dates, {"113106", "Retain Longitudinal Temporal Information Full Dates Option"}},
      {retained.shiftDays != 0, {"113107", "Retain Longitudinal Temporal Information Modified Dates Option"}},
      {retained.patient, {"113108", "Retain Patient Characteristics Option"}},
      {retained.device, {"113109", "Retain Device Identity Option"}},
      {retained.uids, {"113110", "Retain UIDs Option"}},
      {retained.privates, {"113111", "Retain Safe Private Option"}},
      {retained.institution, {"113112", "Retain Institution Identity Option"}}};
  for (const auto& [isChosen, code] : options)
    if (isChosen) codes.push_back(code);
  return codes;
}

}  // namespace

std::vector<StatementElement> statementElements(const Rewriting& how) {
  const Retained& retained = how.retained;
  const char* const times = retained.dates ? "UNMODIFIED" : retained.shiftDays ? "MODIFIED" : "REMOVED";
  std::vector<StatementElement> all = {
      {0x00120062, dicom::vrOf('C', 'S'), "YES", {}},
      {0x00120063, dicom::vrOf('L', 'O'), std::string("volumen " VOLUMEN_VERSION "\\") + profileEdition, {}},
      {0x00120064, dicom::vrOf('S', 'Q'), {}, methodCodes(how)},
      {0x00280303, dicom::vrOf('C', 'S'), times, {}}};
  if (how.isFaceless) all.insert(all.end() - 1, {0x00280302, dicom::vrOf('C', 'S'), "NO", {}});
  return all;
}

void addStatement(const StatementElement& element, dicom::Encoding encoding, FileParts& parts) {
  if (element.codes.empty()) return parts.addElement(encoding, element.tag, element.vr, element.value);
  constexpr auto undefined = std::uint32_t(dicom::undefinedLength);
  parts.addHeader(encoding, element.tag, element.vr, undefined);
  for (const MethodCode& code : element.codes) {
    parts.addHeader(encoding, dicom::itemTag, 0, undefined);
    parts.addElement(encoding, 0x00080100, dicom::vrOf('S', 'H'), code.value);
    parts.addElement(encoding, 0x00080102, dicom::vrOf('S', 'H'), "DCM");
    parts.addElement(encoding, 0x00080104, dicom::vrOf('L', 'O'), code.meaning);
    parts.addHeader(encoding, dicom::itemEndTag, 0, 0);
  }
  parts.addHeader(encoding, dicom::sequenceEndTag, 0, 0);
}

bool isClassicImage(const std::string& sopClass) {
  constexpr const char* classes[] = {
      "1.2.840.10008.5.1.4.1.1.1",      // Computed Radiography
      "1.2.840.10008.5.1.4.1.1.2",      // CT
      "1.2.840.10008.5.1.4.1.1.3.1",    // Ultrasound Multi-frame
      "1.2.840.10008.5.1.4.1.1.4",      // MR
      "1.2.840.10008.5.1.4.1.1.6.1",    // Ultrasound
      "1.2.840.10008.5.1.4.1.1.7",      // Secondary Capture
      "1.2.840.10008.5.1.4.1.1.12.1",   // X-Ray Angiographic
      "1.2.840.10008.5.1.4.1.1.12.2",   // X-Ray Radiofluoroscopic
      "1.2.840.10008.5.1.4.1.1.20",     // Nuclear Medicine
      "1.2.840.10008.5.1.4.1.1.481.1",  // RT
  };
  return std::ranges::find(classes, sopClass) != std::end(classes);
}

}  // namespace volumen
