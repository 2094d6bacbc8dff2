#include "app/exports/exports.h"

#include "app/open_volume.h"
#include "app/segment_numbers.h"
#include "io/export/dicom_file.h"
#include "io/export/export_segments.h"

namespace volumen {

namespace {

// The ending of a name chooses the format of exportSegments().
Status checkEnding(const std::string& path, const std::string& ending) {
  const auto format = segmentFormatOf(path);
  if (format && (*format)->ending == ending) return {};
  return Error{path + ": the name of this file ends in " + ending + "."};
}

Status checkAllNew(const std::string& path, std::span<const Segmented> maps) {
  const auto files = filesOfExport(path, maps);
  if (!files) return files.error();
  for (const std::string& file : *files)
    if (const auto created = createNew(file); !created) return created.error();
  return {};
}

Result<Exported> exportSegmentFiles(const ExportJob& job, const char* ending, const CancelToken& cancel) {
  if (Status s = checkEnding(job.output, ending); !s) return s.error();
  auto opened = openVolume(job.path, job.series, cancel, segmenting);
  if (!opened) return opened.error();
  const auto segments = segmentsOfFile(job.segments, *opened, cancel);
  if (!segments) return segments.error();
  if (Status s = checkLosses(job.path, opened->loaded.unread); !s) return s.error();
  if (Status s = checkAllNew(job.output, segments->maps); !s) return s.error();
  const auto written = exportSegments(job.output, segments->maps, opened->series, {}, cancel);
  if (!written) return written.error();
  Exported exported{opened->notes, opened->loaded.unread, written->files};
  exported.notes.insert(exported.notes.end(), written->notes.begin(), written->notes.end());
  return exported;
}

}  // namespace

Result<Exported> exportSegmentation(const ExportJob& job, const CancelToken& cancel) {
  return exportSegmentFiles(job, ".dcm", cancel);
}

Result<Exported> exportSegmentSurfaces(const ExportJob& job, const CancelToken& cancel) {
  return exportSegmentFiles(job, ".stl", cancel);
}

}  // namespace volumen
