#pragma once

#include <QKeyEvent>

namespace volumen {

/// The key of an event; where its letter is none of the Latin script (Cyrillic, Greek), the one that lies at
/// its place on a US keyboard. Of X11 and Wayland; elsewhere the key as it is.
int latinKey(const QKeyEvent& event);

}  // namespace volumen
