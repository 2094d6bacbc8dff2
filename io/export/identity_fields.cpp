#include "io/export/identity_fields.h"

namespace volumen {

IdentityFields identityFields(const SeriesIdentity& series) {
  IdentityFields fields;
  for (const auto& [keyword, value] : {std::pair("PatientID", &series.patientId),
                                       {"PatientName", &series.patientName},
                                       {"StudyDate", &series.studyDate},
                                       {"SeriesNumber", &series.seriesNumber},
                                       {"SeriesDescription", &series.description},
                                       {"SeriesInstanceUID", &series.seriesUid}}) {
    std::string line = *value;
    for (char& c : line)
      if (static_cast<unsigned char>(c) < ' ' || c == 127) c = ' ';
    if (line.find_first_not_of(' ') != std::string::npos) fields.emplace_back(keyword, line);
  }
  return fields;
}

}  // namespace volumen
