#pragma once

#include <vector>

#include "ui/workspace/workspace.h"

namespace volumen {

/// Returns one series of each patient on screen, overlays included, in the order of the views. Series that
/// name no patient and are not DICOM do not count.
std::vector<const Series*> patientsOnScreen(const Workspace& workspace);

/// Empties the views that show another patient than that of `series`, on screen or not. Measurements stay.
Workspace withoutOtherPatients(Workspace workspace, const Series& series);

}  // namespace volumen
