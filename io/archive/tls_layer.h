#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmtls/tlslayer.h>

#include <memory>

#include "io/archive/archives.h"

namespace volumen {

/// Returns a layer for TLS as settings say, for connecting (NET_REQUESTOR) or listening (NET_ACCEPTOR). Peers
/// must show a certificate that `ca` vouches for, if there is one. The Error: a file cannot be used.
Result<std::unique_ptr<DcmTLSTransportLayer>> tlsLayer(const TlsSettings& tls, T_ASC_NetworkRole role);

}  // namespace volumen
