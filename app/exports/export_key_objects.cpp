#include "app/exports/exports.h"

#include "app/exports/image_list.h"
#include "io/export/key_objects_dicom.h"
#include "io/paths/open_path.h"

namespace volumen {

namespace {

Result<Code> keyTitleOf(const ExportJob& job) {
  const auto title = keyObjectTitle(job.title);
  return title ? title : Error{"--title: " + title.message()};
}

}  // namespace

Status checkKeyObjects(const ExportJob& job) {
  if (const auto title = keyTitleOf(job); !title) return title.error();
  const auto images = imagesIn(job.images);
  return images ? Status() : images.error();
}

Result<Exported> exportKeyObjects(const ExportJob& job, const CancelToken& cancel) {
  const auto title = keyTitleOf(job);
  if (!title) return title.error();
  const auto images = imagesIn(job.images);
  if (!images) return images.error();
  const Result<Study> study = openPath(job.path, {}, cancel);
  if (!study) return study.error();
  std::vector<std::string> uids;
  for (const ReferencedPicture& picture : *images) uids.push_back(picture.sopInstanceUid);
  const auto source = readDocumentSource(*study, uids, {}, cancel);
  if (!source) return source.error();
  if (Status s = writeKeyObjects({*title, {}, *images}, *source, job.output); !s) return s.error();
  return Exported{};
}

}  // namespace volumen
