#include <algorithm>

#include "app/exports/exports.h"
#include "io/export/encapsulated_pdf.h"
#include "io/paths/open_path.h"
#include "io/regular_file.h"
#include "io/study/choose.h"
#include "io/study/frame_series.h"

namespace volumen {

namespace {

// Returns a series of the study that a document belongs to: a volume, or pictures.
Result<Series> seriesOfDocument(const Study& study, const ExportJob& job) {
  const std::vector<Series> pictures = frameSeries(study);
  const auto named = std::ranges::find_if(
      pictures, [&](const Series& one) { return one.id == job.series || one.seriesUid == job.series; });
  if (named != pictures.end()) return *named;
  if (study.volumes.empty() && pictures.empty()) return nothingToShow(job.path, study);
  if (study.volumes.empty() && job.series.empty()) return pictures.front();
  const auto chosen = chooseSeries(study, job.series);
  if (!chosen) return chosen.error();
  return study.volumes[*chosen];
}

}  // namespace

Result<Exported> exportPdf(const ExportJob& job, const CancelToken& cancel) {
  constexpr std::uint64_t mostBytes = 1 << 30;
  const auto pdf = wholeText(job.pdf, mostBytes, "a PDF");
  if (!pdf) return pdf.error();
  const Result<Study> study = openPath(job.path, {}, cancel);
  if (!study) return study.error();
  const auto series = seriesOfDocument(*study, job);
  if (!series) return series.error();
  PdfTags tags;
  if (!job.title.empty()) tags.title = job.title;
  tags.description = tags.title;
  tags.seriesNumber = nextSeriesNumber(*study, series->studyUid);
  if (Status s = writeEncapsulatedPdf(*pdf, *series, tags, job.output, {}, cancel); !s) return s.error();
  return Exported{};
}

}  // namespace volumen
