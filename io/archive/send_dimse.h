#pragma once

#include "io/archive/protocol.h"

namespace volumen {

/// Sends instances by C-STORE, many over several associations at once (ArchiveProtocol::send()). Each is
/// offered in its transfer syntax and without compression.
Status sendByDimse(const Archive& archive, const std::vector<SentInstance>& instances, const OnSent& onSent,
                   const CancelToken& cancel);

}  // namespace volumen
