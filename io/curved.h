#pragma once

#include "io/study/loaded.h"
#include "io/study/progress.h"
#include "io/study/series.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// A series of the values of `source`, resampled along a curve: in a frame of reference of its own, by what
/// names it told from others that are made otherwise. `name`: of the curve. An Error where CurvedGrid has
/// one, or the source is along a curve itself.
Result<Series> curvedSeries(const Series& source, const CurvedRecipe& recipe, const std::string& name);

/// The series that is to be loaded, and looked for, to have this one: its source, or itself.
const Series& sourceOf(const Series& series);

/// The series that is made of `source` as `model` was made of its own: itself, or laid out along the same
/// curve. An Error as of curvedSeries().
Result<Series> madeLike(const Series& model, const Series& source);

/// The volume of a series along a curve. `source`: the drawn volume of its source; null: it is read. An Error
/// names the file and why, or says what is wrong with the curve.
Result<Loaded> loadCurved(const Series& series, VolumePtr source, const Progress& progress = {},
                          const CancelToken& cancel = {});

}  // namespace volumen
