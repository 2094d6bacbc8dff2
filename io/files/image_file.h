#pragma once

#include <string>
#include <vector>

#include "io/files/image_header.h"
#include "io/study/loaded.h"
#include "io/study/progress.h"
#include "viewer/volume/cancel.h"

namespace volumen {

struct Series;

/// True if `path` claims to be a non-DICOM image file by its first bytes or its name. This includes formats
/// that are refused by name (resources/docs/import.md lists all).
bool looksLikeImageFile(const std::string& path);

/// True for a gzipped DICOM file, which is refused by name.
bool isGzippedDicom(const std::string& path);

/// Reads the headers of the volumes in an image file. A file of more than three axes has several: their ids
/// end in "#1", "#2" ..., and what varies names them: timePoint, bValue, label. The Error names the file and
/// the reason: damaged, cut off, a colour image, data files outside its folder.
Result<std::vector<Series>> readImageFileHeaders(const std::string& path);

/// Reads the header of an image file, in a worker if there are any. The Error is that of
/// readImageFileHeaders() or of the worker.
Result<ImageHeader> readImageHeader(const std::string& path, const CancelToken& cancel = {});

/// Reads the volume `series`, which comes from readImageFileHeaders(series.path).
Result<Loaded> loadImageFile(const Series& series, const Progress& progress = {},
                             const CancelToken& cancel = {});

}  // namespace volumen
