#pragma once

#include <string>
#include <vector>

#include "io/files/image_header.h"
#include "io/study/loaded.h"
#include "io/study/progress.h"
#include "viewer/volume/cancel.h"

namespace volumen {

struct Series;

/// Whether `path` claims to be an image file that is no DICOM (resources/docs/import.md lists them, also
/// those that are refused by name): by its first bytes, or by its name.
bool looksLikeImageFile(const std::string& path);

/// Whether that is a DICOM file in gzip, which is refused by name.
bool isGzippedDicom(const std::string& path);

/// The volumes that an image file holds; headers only. Several where it has more than three axes: their ids
/// end in "#1", "#2" ..., and they are named by what varies: timePoint, bValue, label. The Error names the
/// file and why there are none: damaged, cut off, a colour picture, data files outside its folder.
Result<std::vector<Series>> readImageFileHeaders(const std::string& path);

/// What the header of an image file says, read in a worker where there are any. The Error is that of
/// readImageFileHeaders(), or says what became of the worker.
Result<ImageHeader> readImageHeader(const std::string& path, const CancelToken& cancel = {});

/// Reads the volume `series`, one of readImageFileHeaders(series.path).
Result<Loaded> loadImageFile(const Series& series, const Progress& progress = {},
                             const CancelToken& cancel = {});

}  // namespace volumen
