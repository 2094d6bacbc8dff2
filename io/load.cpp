#include "io/load.h"

#include "io/curved.h"
#include "io/dicom/import.h"
#include "io/files/image_file.h"
#include "io/phantom.h"

namespace volumen {

Result<Loaded> loadSeries(const Series& series, const Progress& progress, const CancelToken& cancel) {
  if (series.curved) return loadCurved(series, {}, progress, cancel);
  if (series.format == "DICOM") return dicom::loadSeries(series, progress, cancel);
  if (series.format == "phantom") return loadPhantom(series, progress);
  return loadImageFile(series, progress, cancel);
}

}  // namespace volumen
