#pragma once

#include "app/exports/exports.h"
#include "io/export/slice_stack.h"

namespace volumen {

/// Writes a stack of slices of an opened series with the overlay of a job, as slicePicture() draws them, as a
/// series in colour. The Error is a sentence for the user.
Result<Exported> exportFused(const ExportJob& job, const SliceStack& stack, Opened opened, int seriesNumber,
                             const CancelToken& cancel);

}  // namespace volumen
