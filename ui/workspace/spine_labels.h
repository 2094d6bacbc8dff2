#pragma once

#include <span>
#include <string>

#include "ui/workspace/workspace.h"

namespace volumen {

/// Returns the vertebrae from the skull down: C1 to C7, T1 to T12, L1 to L5, S1 to S5.
std::span<const std::string> vertebrae();

/// Returns the text of the next label of a series: the vertebra below the last one, or above it if the last
/// two go upwards. Another name that ends in a number gets the next number. The first label is C7. Empty if
/// nothing follows.
std::string nextLabel(const Workspace& workspace, const SeriesKey& series);

}  // namespace volumen
