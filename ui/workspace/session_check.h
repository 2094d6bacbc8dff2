#pragma once

#include "ui/workspace/session_fields.h"
#include "ui/workspace/workspace.h"

namespace volumen {

/// Refuses (JsonFields::refuse) sessions with valid fields that the window cannot show. Checks the kinds of
/// views, that the focus is on screen, and the numbers of series and measurements.
void checkViews(JsonFields& json, const Workspace& workspace);

}  // namespace volumen
