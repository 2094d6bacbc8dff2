#pragma once

#include <optional>

#include "app/exports/exports.h"
#include "app/open_volume.h"
#include "app/session_view.h"
#include "io/export/dicom_series.h"

namespace volumen {

/// Replaces parts of the displayed volume by air: those of --remove-table and --segments, or those that the
/// 3D view of the session leaves out. Adds a note, and returns the parts in words; empty if there are none.
/// The Error: values are not HU, the segments cannot be read or hold no voxel, cancelled, or too little
/// memory.
Result<std::optional<TakenAway>> takePartsAway(const ExportJob& job,
                                               const std::optional<SessionView>& session, Opened& opened,
                                               const CancelToken& cancel);

}  // namespace volumen
