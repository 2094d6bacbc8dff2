#pragma once

#include <vector>

#include "ui/workspace/workspace.h"

namespace volumen {

/// Whether two series or objects are of one patient: of one name and one ID.
bool areOfOnePatient(const SeriesIdentity& a, const SeriesIdentity& b);

/// One series of each patient whose pictures the views on screen show, overlays included, in the order of the
/// views; series that name no patient and are no DICOM do not count.
std::vector<const Series*> patientsOnScreen(const Workspace& workspace);

/// With the views that show another patient than that of `series` empty, on screen or not. What was measured
/// stays.
Workspace withoutOtherPatients(Workspace workspace, const Series& series);

}  // namespace volumen
