#pragma once

#include <string>
#include <vector>

#include "ui/workspace/hanging_protocol.h"

namespace volumen {

/// The hanging protocols that there are.
struct KnownProtocols {
  std::vector<HangingProtocol> protocols;  ///< the user's own first; of one name the first alone
  std::size_t own = 0;                     ///< how many of them are
  std::vector<std::string> problems;       ///< a sentence for each file that is none
};
/// Those in files of the user's and those compiled in.
KnownProtocols knownProtocols();

/// Keeps one under its name, in place of one of the user's own of that name. An Error where the name is one
/// of the program's own, or the file cannot be written.
Status saveOwnProtocol(const HangingProtocol& protocol);

}  // namespace volumen
