#pragma once

#include "io/study/progress.h"

namespace volumen {

/// Returns a progress that shows the activity in percent, in one line of stderr. It shows nothing if that is
/// not a terminal.
Progress terminalProgress();

/// Ends the line of terminalProgress(), so that later output starts on a new one.
void endTerminalProgress();

}  // namespace volumen
