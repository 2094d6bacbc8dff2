#pragma once

#include <QMenu>

#include "ui/workspace/session.h"

namespace volumen {

/// How the flat view in focus makes a pixel of voxels: thickness and mode of its slab.
QMenu* makeSlabMenu(Session& session, QWidget* parent);

/// Whether the flat view in focus interpolates between voxels, of a group all its planes.
QAction* makeInterpolationAction(Session& session, QObject* parent);

}  // namespace volumen
