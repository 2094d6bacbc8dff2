#pragma once

#include "io/study.h"

namespace volumen {

/// What the values of a PET series are multiplied by to give SUVbw, g/ml (slices.md 4): from
/// Units BQML with weight, dose and times, from CNTS with a factor in the file, 1 for GML. An Error is the
/// sentence that says why there is no SUV, with the attribute that is missing. Reads the headers of all
/// files: the scan begins with the earliest.
Result<double> suvFactor(const Series& series);

}  // namespace volumen
