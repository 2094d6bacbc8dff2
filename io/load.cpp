#include "io/load.h"

#include <algorithm>
#include <new>

#include "io/curved.h"
#include "io/dicom/import.h"
#include "io/files/image_file.h"
#include "io/phantom.h"
#include "viewer/volume/available_memory.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

std::uint64_t bytesOf(const std::string& valueType) {
  return valueType == "uint8" ? 1 : valueType == "float32" ? 4 : 2;
}

// Frames on their way from workers: as sent, as received and as stored.
std::uint64_t bytesOnTheWay(const Series& series) {
  if (series.format != "DICOM") return 0;
  const glm::ivec3 size = series.acquired.size;
  const std::uint64_t frame = 4 * std::uint64_t(size.x) * std::uint64_t(size.y);
  return 3 * frame * std::uint64_t(std::min(allowedThreads(), size.z));
}

Result<Loaded> load(const Series& series, const Progress& progress, const CancelToken& cancel) {
  if (series.curved) return loadCurved(series, {}, progress, cancel);
  if (series.format == "DICOM") return dicom::loadSeries(series, progress, cancel);
  if (series.format == "phantom") return loadPhantom(series, progress);
  return loadImageFile(series, progress, cancel);
}

}  // namespace

std::uint64_t bytesToLoad(const Series& series) {
  std::uint64_t voxels = std::uint64_t(series.acquired.voxelCount());
  if (series.regular) voxels += std::uint64_t(series.regular->geometry.voxelCount());
  const std::uint64_t own = voxels * bytesOf(series.valueType) + bytesOnTheWay(series);
  return series.curved ? own + bytesToLoad(*series.curved->source) : own;
}

Status checkMemoryFor(const Series& series, const std::string& what, std::uint64_t besides) {
  return checkAvailable(series.path + ": " + what + " it", bytesToLoad(series) + besides);
}

Result<Loaded> loadSeries(const Series& series, const Progress& progress, const CancelToken& cancel) {
  if (Status s = checkMemoryFor(series, "reading"); !s) return s.error();
  try {
    return load(series, progress, cancel);
  } catch (const std::bad_alloc&) {
    return tooLittleMemory(series.path + ": reading it", bytesToLoad(series));
  }
}

}  // namespace volumen
