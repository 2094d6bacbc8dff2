#pragma once

#include "app/exports/exports.h"
#include "app/open_volume.h"
#include "io/export/dicom_series.h"

namespace volumen {

/// Replaces by air what a job takes away of the displayed volume (--remove-table, --segments), adds notes on
/// that, and returns what it was in words. The Error: values are not HU, the segments cannot be read or hold
/// no voxel, cancelled, or too little memory.
Result<TakenAway> takePartsAway(const ExportJob& job, Opened& opened, const CancelToken& cancel);

}  // namespace volumen
