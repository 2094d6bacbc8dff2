#pragma once

#include "ui/controller/draw.h"

namespace volumen::tests {

/// For views whose pictures do not matter: every draw fails.
inline MakeDraw drawsNothing() {
  return [](const VoxelsPtr&) {
    return Draw{
        [](const Scene&, const RenderOptions&, const CancelToken&) -> Result<Planned> {
          return Error{"Nothing is drawn here."};
        },
        [](const Planned&, const CancelToken&) -> Result<Drawn> { return Error{"Nothing is drawn here."}; }};
  };
}

}  // namespace volumen::tests
