#pragma once

#include "ui/workspace/session_fields.h"
#include "ui/workspace/workspace.h"

namespace volumen {

/// Refuses (JsonFields::refuse) what the window relies on beyond what each field of a session may be: the
/// kinds of its views, a focus that is on screen, numbers of series and measurements.
void checkViews(JsonFields& json, const Workspace& workspace);

}  // namespace volumen
