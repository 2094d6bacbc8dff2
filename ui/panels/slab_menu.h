#pragma once

#include <QMenu>

#include "ui/workspace/session.h"

namespace volumen {

/// A slab mode as menus name it.
struct SlabModeRow {
  SlabMode mode;
  const char* name;  ///< object name of its action
  QString text;
};
/// Returns all slab modes.
std::vector<SlabModeRow> slabModes();
/// Largest slab thickness, mm.
inline constexpr double thickestMm = 500;
/// Sets the slab mode in one undo step. Makes a slab of default thickness if there is none.
void chooseSlabMode(Session& session, ViewId view, SlabMode mode);
/// Sets interpolation of the focused flat view, in a group of all its planes. Makes one undo step.
void setInterpolated(Session& session, bool on);

/// Makes the menu for slab thickness and mode of the focused flat view.
QMenu* makeSlabMenu(Session& session, QWidget* parent);

/// Returns the name of interpolation: between pixels of frames or voxels of slices.
QString interpolationText(ViewKind kind);
/// Makes the action that switches interpolation of the focused flat view, in a group of all its planes.
QAction* makeInterpolationAction(Session& session, QObject* parent);

}  // namespace volumen
