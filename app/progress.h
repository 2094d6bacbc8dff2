#pragma once

#include "io/study/progress.h"

namespace volumen {

/// Shows what is being done, in percent, in one line of stderr where that is a terminal; else shows nothing.
Progress terminalProgress();

/// Ends the line that terminalProgress() writes, so that what follows stands alone.
void endTerminalProgress();

}  // namespace volumen
