#pragma once

#include "io/study/loaded.h"
#include "io/study/progress.h"
#include "io/study/series.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Returns a series with the values of `source` resampled along a curve; `name` is the curve's name. Its
/// frame of reference is its own and depends on the recipe. The Error: CurvedGrid rejects the curve, or the
/// source is itself curved.
Result<Series> curvedSeries(const Series& source, const CurvedRecipe& recipe, const std::string& name);

/// Returns the series to load and look up in place of this one: its source, or itself.
const Series& sourceOf(const Series& series);

/// Returns the series made from `source` as `model` was from its own: `source` itself, or resampled along the
/// same curve. The Error is that of curvedSeries().
Result<Series> madeLike(const Series& model, const Series& source);

/// Returns the volume of a curved series. `source` is the displayed volume of its source; if null, it is
/// read. The Error names the file and the reason, or the problem of the curve.
Result<Loaded> loadCurved(const Series& series, VolumePtr source, const Progress& progress = {},
                          const CancelToken& cancel = {});

}  // namespace volumen
