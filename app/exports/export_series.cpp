#include "app/exports/exports.h"

#include <nlohmann/json.hpp>

#include "app/exports/plane_stack.h"
#include "app/open_volume.h"
#include "app/progress.h"
#include "io/export/dicom_series.h"
#include "io/export/study_object.h"

namespace volumen {

namespace {

std::string outsideNote(float outside, const Opened& opened) {
  const bool isPadding = opened.loaded.drawn->attributes().padding.has_value();
  return std::string("Pixels outside of the volume have ") +
         (isPadding ? "the padding value" : "the lowest value") + ", " + nlohmann::json(outside).dump() + ".";
}

// Returns notes for the user.
Result<std::vector<std::string>> writeStack(const Opened& opened, const SliceStack& stack, int seriesNumber,
                                            const std::string& folder, const CancelToken& cancel) {
  const Progress progress = terminalProgress();
  const auto made = resampleStack(*opened.loaded.drawn, stack, progress, cancel);
  if (!made) return made.error();
  auto tags = readDicomTags(opened.series, opened.loaded, progress, cancel);
  if (!tags) return tags.error();
  auto notes =
      writeDicomSeries(*made->volume, stackTags(*std::move(tags), opened.loaded, stack, seriesNumber), folder,
                       progress, cancel);
  if (notes && made->outside) notes->push_back(outsideNote(*made->outside, opened));
  return notes;
}

}  // namespace

Result<Exported> exportSeries(const ExportJob& job, const CancelToken& cancel) {
  const auto asked = readPlane(job.plane);
  if (!asked) return asked.error();
  if (Status s = checkDicomFolder(job.output); !s) return s.error();
  const Result<Study> study = openStudyAt(job.path, cancel);
  if (!study) return study.error();
  auto opened = openVolume(*study, job.path, job.series, cancel);
  if (!opened) return opened.error();
  if (Status s = checkLosses(job.path, opened->loaded.unread); !s) return s.error();
  noteEvenSlices(job.plane, *opened);
  const auto stack = planeStack(job, *asked, opened->loaded.drawn->geometry());
  if (!stack) return stack.error();
  const int seriesNumber = nextSeriesNumber(*study, opened->series.studyUid);
  const auto notes = writeStack(*opened, *stack, seriesNumber, job.output, cancel);
  endTerminalProgress();
  if (!notes) return notes.error();
  Exported exported{opened->notes, opened->loaded.unread, {}};
  exported.notes.insert(exported.notes.end(), notes->begin(), notes->end());
  return exported;
}

}  // namespace volumen
