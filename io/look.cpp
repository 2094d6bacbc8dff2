#include "io/look.h"

#include <algorithm>

#include "io/dicom/inspect_files.h"
#include "io/files/image_file.h"
#include "io/worker/batches.h"
#include "io/worker/dicom_fields.h"

namespace volumen {
namespace worker {

void fields(Wire& w, LookedAt& l) { w(l.isImageFile, l.volumes, l.problem, l.gzippedDicom, l.dicom); }

}  // namespace worker

namespace {

LookedAt look(const std::string& path) {
  LookedAt looked;
  looked.isImageFile = looksLikeImageFile(path);
  if (!looked.isImageFile) {
    looked.dicom = dicom::inspect(path);
    return looked;
  }
  Result<std::vector<Series>> volumes = readImageFileHeaders(path);
  if (volumes)
    looked.volumes = std::move(*volumes);
  else
    looked.problem = volumes.message(), looked.gzippedDicom = isGzippedDicom(path);
  return looked;
}

std::vector<LookedAt> lookAtEach(const std::vector<std::string>& paths) {
  std::vector<LookedAt> all;
  for (const std::string& path : paths) {
    all.push_back(look(path));
    worker::finishStep();
  }
  return all;
}

LookedAt refuse(worker::Failure why) {
  LookedAt looked;
  looked.dicom = dicom::refusal(why);
  return looked;
}

bool isGrid(const VoxelGeometry& g) {
  constexpr double mostVoxels = 1e13;
  return std::min({g.size.x, g.size.y, g.size.z}) >= 1 && double(g.size.x) * g.size.y * g.size.z < mostVoxels;
}

/// Whether a volume is one that the headers of `path` can give.
bool isConsistent(const Series& series, const std::string& path) {
  return series.path == path && series.files == std::vector{path} && series.format != "DICOM" &&
         series.format != "phantom" && isGrid(series.acquired) && !series.regular;
}

}  // namespace

std::vector<LookedAt> lookAtFiles(const std::vector<std::string>& paths, const Progress& progress,
                                  const CancelToken& cancel) {
  std::vector<LookedAt> all =
      worker::forFiles<lookAtEach>(paths, "reading headers", progress, cancel, refuse);
  if (!worker::isolating()) return all;
  for (std::size_t n = 0; n < paths.size(); ++n) {
    dicom::checkInspection(paths[n], all[n].dicom);
    const bool consistent = std::ranges::all_of(
        all[n].volumes, [&](const Series& series) { return isConsistent(series, paths[n]); });
    if (!consistent) all[n] = refuse(worker::Failure::wrong);
  }
  return all;
}

}  // namespace volumen
