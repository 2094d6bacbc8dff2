#include "app/exports/exports.h"

#include "app/open_volume.h"
#include "app/segment_numbers.h"
#include "io/export/rtstruct.h"

namespace volumen {

Result<Exported> exportStructureSet(const ExportJob& job, const CancelToken& cancel) {
  const Result<Study> study = openStudyAt(job.path, cancel);
  if (!study) return study.error();
  auto opened = openVolume(*study, job.path, job.series, cancel, segmenting);
  if (!opened) return opened.error();
  const auto segments = segmentsOfFile(job.segments, *opened, cancel);
  if (!segments) return segments.error();
  if (Status s = checkLosses(job.path, opened->loaded.unread); !s) return s.error();
  StructureSetTags tags;
  tags.description = "Segments";
  tags.seriesNumber = nextSeriesNumber(*study, opened->series.studyUid);
  const auto notes = writeStructureSet(segments->maps, opened->series, tags, job.output, {}, cancel);
  if (!notes) return notes.error();
  Exported exported{opened->notes, opened->loaded.unread};
  exported.notes.insert(exported.notes.end(), notes->begin(), notes->end());
  return exported;
}

}  // namespace volumen
