#pragma once

#include <optional>

#include "app/exports/exports.h"
#include "app/open_volume.h"
#include "app/session_view.h"
#include "io/export/dicom_series.h"

namespace volumen {

/// Replaces by air what a job takes away of the displayed volume (--remove-table, --segments), or what the 3D
/// view of its session leaves out of it, adds a note on that, and returns what it was in words; empty if it
/// is nothing. The Error: values are not HU, the segments cannot be read or hold no voxel, cancelled, or too
/// little memory.
Result<std::optional<TakenAway>> takePartsAway(const ExportJob& job,
                                               const std::optional<SessionView>& session, Opened& opened,
                                               const CancelToken& cancel);

}  // namespace volumen
