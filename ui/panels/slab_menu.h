#pragma once

#include <QMenu>

#include "ui/workspace/session.h"

namespace volumen {

/// A mode of slabs, as menus name it.
struct SlabModeRow {
  SlabMode mode;
  const char* name;  ///< of its action
  QString text;
};
/// All of them.
std::vector<SlabModeRow> slabModes();
/// The thickest slab, mm.
inline constexpr double thickestMm = 500;
/// Chosen where there is no slab yet, a mode makes one. One step.
void chooseSlabMode(Session& session, ViewId view, SlabMode mode);
/// Of the flat view in focus, of a group all its planes. One step.
void setInterpolated(Session& session, bool on);

/// How the flat view in focus makes a pixel of voxels: thickness and mode of its slab.
QMenu* makeSlabMenu(Session& session, QWidget* parent);

/// What that is called: of frames between pixels, of slices between voxels.
QString interpolationText(ViewKind kind);
/// Whether the flat view in focus interpolates between voxels, of a group all its planes.
QAction* makeInterpolationAction(Session& session, QObject* parent);

}  // namespace volumen
