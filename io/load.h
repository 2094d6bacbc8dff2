#pragma once

#include <cstdint>
#include <string>

#include "io/study/loaded.h"
#include "io/study/progress.h"
#include "viewer/volume/cancel.h"

namespace volumen {

struct Series;

/// Returns the largest number of bytes that reading a series takes, estimated from its headers.
std::uint64_t bytesToLoad(const Series& series);

/// Returns an Error with needed and available memory if the series and `besides` bytes do not fit. `what` is
/// the verb of the sentence, such as "segmenting".
Status checkMemoryFor(const Series& series, const std::string& what, std::uint64_t besides = 0);

/// Reads and decodes a series, if there is memory enough. The Error names the file and the reason.
Result<Loaded> loadSeries(const Series& series, const Progress& progress = {},
                          const CancelToken& cancel = {});

}  // namespace volumen
