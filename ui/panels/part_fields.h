#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>

namespace volumen {

/// A field for the leak guard of connected parts (PartWanted::leakGuardMm), mm, within what the step
/// "connected" allows; 0: off.
QDoubleSpinBox* leakGuardField();

/// A list of which voxels touch in connected parts (PartWanted::neighbours), in the words of that step.
QComboBox* partNeighboursField();

}  // namespace volumen
