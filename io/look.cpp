#include "io/look.h"

#include <algorithm>

#include "io/dicom/inspect_files.h"
#include "io/dicom/kept_headers.h"
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

// True if the headers of `path` can describe this series.
bool isConsistent(const Series& series, const std::string& path) {
  return series.path == path && series.files == std::vector{path} && series.format != "DICOM" &&
         series.format != "phantom" && isGrid(series.acquired) && !series.regular;
}

// Rejects a worker's result that is impossible for this path.
void check(const std::string& path, LookedAt& looked) {
  dicom::checkInspection(path, looked.dicom);
  const bool consistent =
      std::ranges::all_of(looked.volumes, [&](const Series& series) { return isConsistent(series, path); });
  if (!consistent) looked = refuse(worker::Failure::wrong);
}

}  // namespace

std::vector<LookedAt> lookAtFiles(const std::vector<std::string>& paths, const Progress& progress,
                                  const CancelToken& cancel) {
  std::vector<std::optional<FileState>> states;
  for (const std::string& path : paths) states.push_back(fileState(path));
  std::vector<LookedAt> all =
      worker::forFiles<lookAtEach>(paths, "reading headers", progress, cancel, refuse);
  for (std::size_t n = 0; n < paths.size(); ++n) {
    if (worker::isolating()) check(paths[n], all[n]);
    const dicom::Inspection& found = all[n].dicom;
    if (states[n] && found.kind == dicom::Inspection::Kind::picture)
      dicom::keepHeader(paths[n], *states[n], found.header);
  }
  return all;
}

}  // namespace volumen
