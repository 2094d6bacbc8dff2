#include "app/exports/exports.h"

#include <algorithm>

#include "app/measured_shapes.h"
#include "app/segment_numbers.h"
#include "io/open.h"
#include "io/export/report_dicom.h"
#include "results/numbers/report_of_segments.h"
#include "results/numbers/shapes_report.h"

namespace volumen {

namespace {

// Adds the shapes of a file to a report.
Status addShapes(const ExportJob& job, const Study& study, Report& report, Exported& exported,
                 const CancelToken& cancel) {
  const auto shapes = readShapes(job.shapes);
  if (!shapes) return shapes.error();
  auto sources = openForShapes(study, job.path, job.series, *shapes, false, {}, cancel);
  if (!sources) return sources.error();
  if (const auto& opened = sources->volume) exported = {opened->notes, opened->loaded.unread, {}};
  const ShapesVolume volume = volumeOf(*sources);
  const auto made = reportOfShapes(shapesToMeasure(*shapes, volume), study, sources->frames, cancel);
  if (!made)
    return Error{job.shapes + ": " +
                 (made.message().empty() ? "No shape in it has a number." : made.message())};
  report = made->report;
  exported.notes.insert(exported.notes.end(), made->notes.begin(), made->notes.end());
  addUnread(exported.unread, made->unread);
  return {};
}

// Returns the segmentation that a file is.
Result<DerivedObject> segmentationAt(const std::string& path) {
  const Result<Study> study = openStudy(path);
  if (!study) return study.error();
  const auto found = std::ranges::find(study->derived, DerivedKind::segmentation, &DerivedObject::kind);
  if (found != study->derived.end()) return *found;
  return Error{path +
               ": A report names segments by their DICOM segmentation, which this is not: write one first "
               "(--as seg)."};
}

// Adds the numbers of the segments of a DICOM segmentation to a report, and the segmentation to the study.
Status addSegments(const ExportJob& job, Study& study, Report& report, Exported& exported,
                   const CancelToken& cancel) {
  const auto object = segmentationAt(job.segments);
  if (!object) return object.error();
  auto opened = openVolume(study, job.path, job.series, cancel, segmenting);
  if (!opened) return opened.error();
  const auto segments = segmentsOfFile(job.segments, *opened, cancel);
  if (!segments) return segments.error();
  const auto numbers =
      numbersTold(segments->maps, *opened, PetUnit::suvBodyWeight, {.surfaces = false}, cancel);
  if (!numbers) return numbers.error();
  std::vector<ReferencedPicture> sources;
  for (const ReferencedPicture& picture : object->pictures)
    sources.push_back({picture.sopInstanceUid, {}, {}, {}});
  for (const SegmentReport& one : numbers->reports) {
    const auto group = reportedSegment(one, object->sopInstanceUid, sources, numbers->scale);
    if (group)
      report.groups.push_back(*group);
    else
      opened->notes.push_back("Segment \"" + one.segment.label +
                              "\" is left out of the report: " + group.message() + ".");
  }
  if (std::ranges::find(study.derived, object->sopInstanceUid, &DerivedObject::sopInstanceUid) ==
      study.derived.end())
    study.derived.push_back(*object);
  exported.notes.insert(exported.notes.end(), opened->notes.begin(), opened->notes.end());
  addUnread(exported.unread, opened->loaded.unread);
  return {};
}

}  // namespace

Status checkReport(const ExportJob& job) {
  if (!job.shapes.empty() || !job.segments.empty()) return {};
  return Error{"--as sr needs --roi FILE or --segments FILE."};
}

Result<Exported> exportReport(const ExportJob& job, const CancelToken& cancel) {
  Result<Study> study = openStudyAt(job.path, cancel);
  if (!study) return study.error();
  Report report;
  Exported exported;
  if (!job.shapes.empty())
    if (Status s = addShapes(job, *study, report, exported, cancel); !s) return s.error();
  if (!job.segments.empty())
    if (Status s = addSegments(job, *study, report, exported, cancel); !s) return s.error();
  if (report.groups.empty()) return Error{job.segments + ": No segment in it has a volume."};
  if (Status s = checkLosses(job.path, exported.unread); !s) return s.error();
  const auto source = readDocumentSource(*study, instancesOf(report), {}, cancel);
  if (!source) return source.error();
  const auto notes = writeReport(report, *source, job.output);
  if (!notes) return notes.error();
  exported.notes.insert(exported.notes.end(), notes->begin(), notes->end());
  return exported;
}

}  // namespace volumen
