#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>

namespace volumen {

/// Makes a field for the leak guard of connected components (PartWanted::leakGuardMm), mm; 0 is off. The
/// range is that of the recipe step "connected".
QDoubleSpinBox* leakGuardField();

/// Makes a list of neighbourhoods of connected components (PartWanted::neighbours), in the words of that
/// recipe step.
QComboBox* partNeighboursField();

}  // namespace volumen
