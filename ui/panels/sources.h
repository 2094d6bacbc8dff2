#pragma once

#include "ui/controller/segment_editing.h"
#include "ui/widgets/bind.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Returns the scene of the 3D view in focus, edited in undo steps.
Source<Scene> sceneSource(Session& session);
/// Returns the user's preferences.
Source<Preferences> preferencesSource(Session& session);
/// Returns the options of segment editing.
Source<SegmentOptions> optionsSource(SegmentEditing& editing);

}  // namespace volumen
