// Fuzzes answers of a hijacked worker about three files. Answers that pass the program's checks become
// series, images and objects, which are loaded as far as possible without their pixels.
#include "io/dicom/import.h"
#include "io/dicom/inspect_files.h"
#include "io/load.h"
#include "io/study/study.h"
#include "io/worker/dicom_fields.h"

using namespace volumen;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::vector<std::string> paths{"/no/1", "/no/2", "/no/3"};
  worker::MemoryReader answer({bytes, size});
  std::vector<dicom::Inspection> said(paths.size());
  for (dicom::Inspection& inspection : said) answer(inspection);
  if (!answer.ok()) return 0;
  for (std::size_t n = 0; n < paths.size(); ++n) dicom::checkInspection(paths[n], said[n]);
  Study study;
  dicom::SeriesFinder finder;
  for (std::size_t n = 0; n < paths.size(); ++n) finder.add(paths[n], said[n]);
  finder.finish({}, true, study);
  constexpr std::int64_t mostVoxels = 1 << 20;
  for (const Series& series : study.volumes)
    if (series.acquired.voxelCount() <= mostVoxels) (void)loadSeries(series);
  return 0;
}
