#pragma once

#include "io/archive/protocol.h"
#include "io/archive/web_exchange.h"

namespace volumen {

/// Sends instances by STOW-RS (PS3.18 10.5), several in a request (ArchiveProtocol::send()). What the answer
/// names counts, not its status. Archives that refuse large requests get smaller ones.
Status sendByWeb(WebExchange& exchange, const std::vector<SentInstance>& instances, const OnSent& onSent);

}  // namespace volumen
