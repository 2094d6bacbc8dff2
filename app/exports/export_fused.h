#pragma once

#include "app/exports/exports.h"
#include "io/export/dicom_series.h"
#include "io/export/slice_stack.h"

namespace volumen {

/// A series to write, and what becomes of it.
struct SeriesSource {
  Opened opened;
  int seriesNumber;
  std::optional<TakenAway> without{};
};

/// Writes a stack of slices of a series with the overlay of a job, as slicePicture() draws them, as a series
/// in colour. The Error is a sentence for the user.
Result<Exported> exportFused(const ExportJob& job, const SliceStack& stack, SeriesSource source,
                             const CancelToken& cancel);

}  // namespace volumen
