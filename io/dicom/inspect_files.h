#pragma once

#include "io/dicom/header.h"
#include "io/study/progress.h"
#include "io/worker/costly_files.h"
#include "viewer/volume/cancel.h"

namespace volumen::dicom {

/// Returns inspect() of each file, computed on all cores and in workers if there are any (io/worker). Entries
/// after a cancellation are empty.
std::vector<Inspection> inspectFiles(const std::vector<std::string>& paths, const Progress& progress,
                                     const CancelToken& cancel);

/// Returns the refusal of a file whose worker failed.
Inspection refusal(worker::Failure why);

/// Turns an inspection from a worker into a refusal if inspect(path) cannot have returned it.
void checkInspection(const std::string& path, Inspection& inspection);

}  // namespace volumen::dicom
