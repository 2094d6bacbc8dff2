#pragma once

#include <optional>
#include <string>

namespace volumen {

/// Returns a date (DA) or date and time (DT) moved by a number of days, its other parts unchanged. Nothing if
/// it has no full date or the result leaves the years 1 to 9999.
std::optional<std::string> movedDate(const std::string& text, int days);

}  // namespace volumen
