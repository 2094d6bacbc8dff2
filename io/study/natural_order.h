#pragma once

#include <string_view>

namespace volumen {

/// The order of texts in which digits count as numbers: "1.2.9" before "1.2.10", "TI 90" before "TI 150".
/// Below 0: `a` is first; 0: they are the same; above 0: `b` is first.
int naturalOrder(std::string_view a, std::string_view b);

}  // namespace volumen
