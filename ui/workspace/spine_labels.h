#pragma once

#include <span>
#include <string>

#include "ui/workspace/workspace.h"

namespace volumen {

/// The vertebrae in their order, from the skull down: C1 to C7, T1 to T12, L1 to L5, S1 to S5.
std::span<const std::string> vertebrae();

/// What the next label of a series says: the vertebra below the last one, or above it where the last two go
/// upwards; of another name that ends in a number the same with the next number; C7 where there is no label
/// yet. Empty: nothing follows.
std::string nextLabel(const Workspace& workspace, const SeriesKey& series);

}  // namespace volumen
