#pragma once

#include "io/dicom/header.h"
#include "io/study/progress.h"
#include "io/worker/costly_files.h"
#include "viewer/volume/cancel.h"

namespace volumen::dicom {

/// What files turned out to be, one entry each: inspect(), on all cores, in workers where there are any
/// (io/worker). Entries of an interrupted search are empty.
std::vector<Inspection> inspectFiles(const std::vector<std::string>& paths, const Progress& progress,
                                     const CancelToken& cancel);

/// That a file is refused for what became of the worker that was to read it.
Inspection refusal(worker::Failure why);

/// Makes what came from a worker a refusal where it is not what inspect(path) can give.
void checkInspection(const std::string& path, Inspection& inspection);

}  // namespace volumen::dicom
