#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "ui/workspace/workspace.h"

namespace volumen::tests {

/// A workspace by chance, the same from a seed on every machine: up to five series (some missing), every
/// layout, view, look and goal, numbers of every size.
Workspace randomWorkspace(std::uint64_t seed);

}  // namespace volumen::tests
