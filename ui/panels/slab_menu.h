#pragma once

#include <QMenu>

#include "ui/workspace/session.h"

class QDoubleSpinBox;

namespace volumen {

/// A slab mode as menus name it.
struct SlabModeRow {
  SlabMode mode;
  const char* name;  ///< object name of its action
  QString text;
};
/// Returns all slab modes.
std::vector<SlabModeRow> slabModes();
/// Makes a field for a slab's thickness in mm.
QDoubleSpinBox* thicknessField(const QString& name);
/// Sets the slab mode. Makes a slab of default thickness if there is none.
void setSlabMode(FlatLook& look, SlabMode mode);

/// Makes the menu for slab thickness and mode of the focused flat view.
QMenu* makeSlabMenu(Session& session, QWidget* parent);

/// Returns the name of interpolation: between pixels of frames or voxels of slices.
QString interpolationText(ViewKind kind);
/// Makes the action that switches interpolation of the focused flat view, in a group of all its planes.
QAction* makeInterpolationAction(Session& session, QObject* parent);

}  // namespace volumen
