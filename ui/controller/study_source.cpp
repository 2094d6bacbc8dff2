#include "ui/controller/study_source.h"

namespace volumen {

void StudySource::studiesOf(const std::string& patientId, const std::string& patientName) {
  Q_EMIT patientListed(patientId, patientName, std::vector<IndexedStudy>());
}

void StudySource::wantThumbnails(const std::vector<std::int64_t>& series) {
  for (const std::int64_t id : series) Q_EMIT thumbnailMade(id, {});
}

}  // namespace volumen
