#pragma once

namespace volumen {

/// Names a view of the window; no number is given twice.
using ViewId = int;

}  // namespace volumen
