#pragma once

#include <cstdint>
#include <string>

#include "io/study/loaded.h"
#include "io/study/progress.h"
#include "viewer/volume/cancel.h"

namespace volumen {

struct Series;

/// The most bytes that a series takes while it is read, as its header has it.
std::uint64_t bytesToLoad(const Series& series);

/// An Error with both figures if there is less memory than a series and `besides` bytes take; "WHAT it" is
/// done: "segmenting".
Status checkMemoryFor(const Series& series, const std::string& what, std::uint64_t besides = 0);

/// Reads and decodes a series, if there is memory enough. The Error names the file and the reason.
Result<Loaded> loadSeries(const Series& series, const Progress& progress = {},
                          const CancelToken& cancel = {});

}  // namespace volumen
