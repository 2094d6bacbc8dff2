#pragma once

#include <QDoubleSpinBox>

namespace volumen {

/// A field for the leak guard of connected parts (PartWanted::leakGuardMm), mm, within what the step
/// "connected" allows; 0: off.
QDoubleSpinBox* leakGuardField();

}  // namespace volumen
