#include "app/exports/chosen_pictures.h"
#include "app/exports/exports.h"
#include "io/export/encapsulated_pdf.h"
#include "io/paths/open_path.h"
#include "io/regular_file.h"

namespace volumen {

Result<Exported> exportPdf(const ExportJob& job, const CancelToken& cancel) {
  constexpr std::uint64_t mostBytes = 1 << 30;
  const auto pdf = wholeText(job.pdf, mostBytes, "a PDF");
  if (!pdf) return pdf.error();
  if (!isPdf(*pdf)) return Error{job.pdf + " is no PDF: name a PDF file by --pdf."};
  const Result<Study> study = openPath(job.path, {}, cancel);
  if (!study) return study.error();
  const auto chosen = choosePictures(job.path, *study, job.series, {}, {});
  if (!chosen) return chosen.error();
  PdfTags tags;
  if (!job.title.empty()) tags.title = job.title;
  tags.description = tags.title;
  tags.seriesNumber = nextSeriesNumber(*study, chosen->series.studyUid);
  if (Status s = writeEncapsulatedPdf(*pdf, chosen->series, tags, job.output, {}, cancel); !s)
    return s.error();
  return Exported{};
}

}  // namespace volumen
