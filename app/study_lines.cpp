#include "app/study_lines.h"

#include "app/printable.h"
#include "io/study/iso_date.h"

namespace volumen {

namespace {

std::string dateOf(const std::string& dicom) { return printable(isoDate(dicom)); }

std::string marks(int warnings, bool offline) {
  std::string text = warnings == 0   ? ""
                     : warnings == 1 ? "1 warning"
                                     : std::to_string(warnings) + " warnings";
  if (offline) text += text.empty() ? "offline" : ", offline";
  return text;
}

// A number that is not known is no 0.
nlohmann::ordered_json countJson(int count) {
  return count < 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(count);
}
std::string countText(int count) { return count < 0 ? "" : std::to_string(count); }

}  // namespace

nlohmann::ordered_json seriesJson(const IndexedSeries& s) {
  return {{"seriesUid", s.seriesUid},
          {"number", s.number},
          {"modality", s.modality},
          {"description", s.description},
          {"date", isoDate(s.date)},
          {"time", s.time},
          {"label", s.label},
          {"images", countJson(s.images)},
          {"frames", countJson(s.frames)},
          {"isVolume", s.isVolume},
          {"offline", s.offline},
          {"warnings", s.warnings}};
}

nlohmann::ordered_json studyJson(const IndexedStudy& s) {
  return {
      {"number", s.id},
      {"patient",
       {{"name", s.patientName}, {"id", s.patientId}, {"birthDate", isoDate(s.birthDate)}, {"sex", s.sex}}},
      {"studyUid", s.studyUid},
      {"date", isoDate(s.date)},
      {"time", s.time},
      {"description", s.description},
      {"accessionNumber", s.accessionNumber},
      {"institution", s.institution},
      {"modalities", s.modalities},
      {"seriesCount", countJson(s.series)},
      {"images", countJson(s.images)},
      {"warningCount", s.warnings},
      {"offline", s.offline},
      {"importedAt", s.importedAt},
      {"openedAt", s.openedAt}};
}

TextTable studyTable() {
  return TextTable({"No.", "Patient", "ID", "Date", "Modality", "Description", "Series", "Images", ""});
}

void addTo(TextTable& table, const IndexedStudy& s) {
  table.add({std::to_string(s.id), printable(s.patientName), printable(s.patientId), dateOf(s.date),
             printable(s.modalities), printable(s.description), countText(s.series), countText(s.images),
             marks(s.warnings, s.offline)});
}

TextTable seriesTable() {
  return TextTable({"No.", "Patient", "Date", "Series", "Modality", "Description", "Images", "Frames", ""});
}

void addTo(TextTable& table, const IndexedStudy& study, const IndexedSeries& s) {
  const std::string label = s.label.empty() ? "" : " (" + printable(s.label) + ")";
  table.add({std::to_string(study.id), printable(study.patientName), dateOf(study.date), printable(s.number),
             printable(s.modality), printable(s.description) + label, countText(s.images),
             countText(s.frames), marks(int(s.warnings.size()), s.offline)});
}

}  // namespace volumen
