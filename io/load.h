#pragma once

#include "io/study/loaded.h"
#include "io/study/progress.h"
#include "viewer/volume/cancel.h"

namespace volumen {

struct Series;

/// Reads and decodes a series. The Error names the file and the reason.
Result<Loaded> loadSeries(const Series& series, const Progress& progress = {},
                          const CancelToken& cancel = {});

}  // namespace volumen
