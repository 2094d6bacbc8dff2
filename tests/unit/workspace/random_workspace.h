#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "ui/workspace/workspace.h"

namespace volumen::tests {

/// Returns the same random workspace for a seed on every machine. It has up to five series (some missing),
/// every layout, view, look and goal, and numbers of every size.
Workspace randomWorkspace(std::uint64_t seed);

}  // namespace volumen::tests
