#pragma once

#include <string>
#include <vector>

#include "ui/workspace/hanging_protocol.h"

namespace volumen {

/// All known hanging protocols.
struct KnownProtocols {
  std::vector<HangingProtocol> protocols;  ///< the user's own first; only the first of equal names
  std::size_t own = 0;                     ///< how many of them are the user's
  std::vector<std::string> problems;       ///< a sentence for each file that is no protocol
};
/// Returns the user's protocols from files and the built-in ones.
KnownProtocols knownProtocols();

/// Saves a protocol under its name and replaces the user's protocol of that name. Returns an Error if the
/// name is a built-in one or the file cannot be written.
Status saveOwnProtocol(const HangingProtocol& protocol);

}  // namespace volumen
