#pragma once

#include <functional>
#include <optional>

#include "ui/document/derivation.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Series with a mask applied that are needed and not in the session's pool. They are kept there once made.
using MaskedVolumes = Derivation<PoolKey, LoadedSeries>;

/// Returns the rule for the volume that `next` names, if any, then for those that views on screen lack, as
/// after undo. The unmasked series is in memory for all of them. Nothing begins while `isPaused` returns
/// true.
MaskedVolumes::Rule maskedVolumesRule(
    const Session& session, std::function<std::optional<PoolKey>()> next,
    std::function<bool()> isPaused = [] { return false; });

}  // namespace volumen
