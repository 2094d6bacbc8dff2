#pragma once

#include "io/archive/protocol.h"

namespace volumen {

/// Has an archive send instances to the address where this program listens (C-MOVE, Archive::listen). The
/// Error: volumen cannot listen there, the archive's, or why not all came.
Status moveFromArchive(const Archive& archive, const WantedInstances& wanted, InstanceSink& sink,
                       const CancelToken& cancel);

}  // namespace volumen
