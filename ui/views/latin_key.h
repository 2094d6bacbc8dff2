#pragma once

#include <QKeyEvent>

namespace volumen {

/// Returns the key of an event. For letters of other scripts (Cyrillic, Greek) returns the key at the same
/// position of a US keyboard. This works on X11 and Wayland; other systems return the key unchanged.
int latinKey(const QKeyEvent& event);

}  // namespace volumen
