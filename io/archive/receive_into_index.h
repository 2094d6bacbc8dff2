#pragma once

#include <functional>
#include <string>

#include "io/archive/receive_archive.h"
#include "io/index/index.h"

namespace volumen {

/// Receives as receiveInstances() does, into the folder of fetched studies beside an index, and adds each
/// study to the index 2 s after its last instance, and at the end; first those that a program which was
/// killed has left (importArrived()). `onImported` gets the report of each import, on this thread. The Error
/// also: the index cannot be used.
Result<ReceiveReport> receiveIntoIndex(const Listening& listening, const std::string& indexFolder,
                                       const ReceiveEvents& events,
                                       const std::function<void(const Result<ImportReport>&)>& onImported,
                                       const CancelToken& cancel);

/// Adds to the index the studies of which receiveIntoIndex() received instances, but was killed before it
/// could add them. Opens the index only if there are any.
Result<ImportReport> importArrived(const std::string& indexFolder, const CancelToken& cancel);

}  // namespace volumen
