#pragma once

namespace volumen {

struct Study;

/// Puts what was found into the order of a Study, tells those of one id apart by "#1", "#2", ... behind it,
/// and counts what its objects refer to and it does not hold.
void arrange(Study& study);

}  // namespace volumen
