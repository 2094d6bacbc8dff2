#pragma once

#include <string_view>

namespace volumen {

/// Compares texts with runs of digits as numbers: "1.2.9" before "1.2.10", "TI 90" before "TI 150". Returns
/// below 0 if `a` is first, 0 if they are equal, above 0 if `b` is first.
int naturalOrder(std::string_view a, std::string_view b);

}  // namespace volumen
